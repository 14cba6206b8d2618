"""Workspaces without defects: two written out next to this file, and four that ``urdfkit new robot`` creates.

The text files hold one workspace each: a line ``=== PATH`` begins a file, ``=== PATH box X Y Z`` is an STL box [mm].
"""

from __future__ import annotations

import contextlib
import io
from itertools import product
from pathlib import Path

from urdfkit.cli import main as urdfkit

WRITTEN = ("ros1_arm", "ros2_rover_arm")
CREATED = {
    "noetic_mobile_arm": "scout --ros noetic --arm 5 --gripper --sensor lidar,camera,imu",
    "noetic_fixed_arm": "picker --ros noetic --drive none --arm 6 --gripper",
    "humble_skid": "rover --ros humble --sim classic --drive skid --sensor lidar,depth,gps,imu",
    "jazzy_mobile_arm": "mover --ros jazzy --arm 6 --gripper --sensor lidar,camera",
}
NAMES = (*WRITTEN, *CREATED)
_QUIET = ["--yes", "--no-preview", "--no-picture", "--no-repository", "--quiet"]


def write(name: str, folder: Path) -> None:
    """Write the packages of a workspace into a new folder."""
    if name in CREATED:
        with contextlib.redirect_stdout(io.StringIO()):
            status = urdfkit(["new", "robot", *CREATED[name].split(), *_QUIET, "--into", str(folder)])
        assert status == 0, f"urdfkit new failed for {name}"
        return
    text = (Path(__file__).parent / f"{name}.txt").read_text("utf-8")
    for part in text.split("=== ")[1:]:
        head, _, content = part.partition("\n")
        path, *box = head.split()
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        if box:
            target.write_bytes(_box([float(size) for size in box[1:]]))
        else:
            target.write_text(content, "utf-8")


def _box(size: list[float]) -> bytes:
    """Return a binary STL box with its centre at the origin."""
    import struct

    facets = []
    for axis, side in product(range(3), (-0.5, 0.5)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for a, b in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            point = [0.0, 0.0, 0.0]
            point[axis], point[u], point[v] = side * size[axis], a * size[u], b * size[v]
            corners.append(point)
        if side < 0:
            corners.reverse()
        normal = [0.0, 0.0, 0.0]
        normal[axis] = 2.0 * side
        for triangle in ((0, 1, 2), (0, 2, 3)):
            points = [value for corner in triangle for value in corners[corner]]
            facets.append(struct.pack("<12fH", *normal, *points, 0))
    return bytes(80) + struct.pack("<I", len(facets)) + b"".join(facets)
