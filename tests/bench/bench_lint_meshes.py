"""``urdfkit lint`` beside ``xacro | check_urdf`` on robots with mesh files: CPU time of whole processes.

Run it as ``python -m tests.bench.bench_lint_meshes [COUNT] [RUNS]``. It takes the COUNT (12) entries of the corpus
beside the checkout with the most bytes of meshes, one per folder of meshes, writes a mesh of the original's format and
size in the place of each file that the corpus lacks, and two chains of 40 meshes with 100 MB in total, binary STL
and COLLADA. Each robot is linted cold (without any cache), cached (unchanged) and by the peers, in turns. check_urdf is
in Debian's liburdfdom-tools. Prints the medians and the ratios to the peers. Exits with status 1 above 1.5 (cold) or
0.5 (cached).
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from urdfkit import load
from urdfkit.description.urdf.robot import Link
from urdfkit.errors import UrdfkitError
from urdfkit.lint.model.mesh_files import meshes

CORPUS = Path(__file__).parents[2].parent / "shared" / "corpus"
COLD, CACHED = 1.5, 0.5
"""Largest ratios of CPU time to that of the peers."""


class Ball(NamedTuple):
    """A ball [m]."""

    centre: tuple[float, ...] = (0.0, 0.0, 0.0)
    radius: float = 0.05


def stl(size: int, ball: Ball) -> bytes:
    """Return a binary STL file of about `size` bytes: triangles on a ball."""
    count = max(size // 50, 4)
    records = np.zeros(count, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    records["corners"] = _on(ball, 3 * count).reshape(count, 3, 3)
    return b"urdfkit".ljust(80, b"\0") + count.to_bytes(4, "little") + records.tobytes()


def dae(size: int, ball: Ball) -> bytes:
    """Return a COLLADA file of about `size` bytes with positions, normals and texture coordinates."""
    count = max(size // 120, 4)
    points = _on(ball, count)
    index = np.repeat(np.random.default_rng(1).integers(0, count, (2 * count, 3)), 2, axis=1).ravel()
    arrays = {"positions": (points, "XYZ"), "normals": (_on(Ball(), count), "XYZ")}
    sources = "".join(
        f'<source id="{name}"><float_array id="{name}-array" count="{values.size}">{_text(values)}</float_array>'
        f'<technique_common><accessor source="#{name}-array" count="{len(values)}" stride="{len(axes)}">'
        + "".join(f'<param name="{axis}" type="float"/>' for axis in axes)
        + "</accessor></technique_common></source>"
        for name, (values, axes) in arrays.items()
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
        'version="1.4.1"><asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset><library_geometries>'
        f'<geometry id="part"><mesh>{sources}<vertices id="vertices"><input semantic="POSITION" source="#positions"/>'
        f'</vertices><triangles count="{2 * count}"><input semantic="VERTEX" source="#vertices" offset="0"/>'
        '<input semantic="NORMAL" source="#normals" offset="1"/>'
        f"<p>{' '.join(map(str, index.tolist()))}</p></triangles></mesh></geometry></library_geometries>"
        '<library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#part"/></node>'
        '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>'
    ).encode()


def obj(size: int, ball: Ball) -> bytes:
    """Return an OBJ file of about `size` bytes with vertices, normals and triangles."""
    count = max(size // 110, 4)
    points = _on(ball, count)
    faces = np.random.default_rng(1).integers(1, count + 1, (2 * count, 3)).tolist()
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points.tolist()]
    lines += [f"vn {x:.4f} {y:.4f} {z:.4f}" for x, y, z in _on(Ball(), count).tolist()]
    lines += [f"f {a}//{a} {b}//{b} {c}//{c}" for a, b, c in faces]
    return "\n".join(lines).encode()


WRITERS = {".stl": stl, ".dae": dae, ".obj": obj}


def _on(ball: Ball, count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    points = np.random.default_rng(0).normal(size=(count, 3))
    return np.asarray(ball.centre + ball.radius * points / np.linalg.norm(points, axis=1, keepdims=True))


def _text(values: np.ndarray[Any, np.dtype[np.float64]]) -> str:
    return " ".join(f"{value:.6f}" for value in values.ravel().tolist())


def heaviest(corpus: Path, count: int) -> list[tuple[Path, dict[str, str]]]:
    """Return the entries with the most bytes of meshes, with their arguments, and write their meshes."""
    listed = json.loads((CORPUS / "meshes.json").read_text())["meshes"]
    sizes = {(corpus / mesh["path"]).resolve(): mesh["bytes"] or 200_000 for mesh in listed}
    found: dict[frozenset[Path], tuple[int, Path, dict[str, str]]] = {}
    balls: dict[Path, Ball] = {}
    for entry in json.loads((CORPUS / "expected.json").read_text())["models"]:
        path, arguments = corpus / entry["entry"], dict(entry.get("args", {}))
        if "install_layout" in entry:
            continue
        try:
            robot = load(path, arguments=arguments)
        except UrdfkitError:
            continue
        used: set[Path] = set()
        for mesh, _, link in meshes(robot):
            name, _, end = mesh.uri.strip().rpartition("//")[2].partition("/")
            for file in sizes:
                if name in file.parts and str(file).endswith("/" + end):
                    used.add(file)
                    balls.setdefault(file, _ball(link, mesh.scale[0]))
        total = sum(sizes[file] for file in used)
        folders = frozenset(file.parent for file in used)
        if used and total > found.get(folders, (0,))[0]:
            found[folders] = total, path, arguments
    for file, size in sizes.items():
        writer = WRITERS.get(file.suffix.lower())
        if writer is not None:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(writer(size, balls.get(file, Ball())))
    chosen = sorted(found.values(), reverse=True, key=lambda each: each[0])[:count]
    return [(path, arguments) for _, path, arguments in chosen]


def _ball(link: Link, scale: float) -> Ball:
    """Return a ball around the centre of mass that has about the inertia of the link, in units of the mesh."""
    inertial, item = link.inertial, (*link.visuals, *link.collisions)[0]
    if inertial is None or not inertial.mass or inertial.inertia is None:
        return Ball(radius=0.05 / scale)
    centre = [(a - b) / scale for a, b in zip(inertial.origin.xyz, item.origin.xyz, strict=True)]
    largest = max(inertial.inertia.ixx, inertial.inertia.iyy, inertial.inertia.izz)
    return Ball(tuple(centre), 1.6 * (max(largest, 1e-9) / inertial.mass) ** 0.5 / scale)


def chain(folder: Path, suffix: str, count: int = 40, total: int = 100_000_000) -> Path:
    """Write a chain of links with one mesh each."""
    folder.mkdir(parents=True)
    parts = []
    for n in range(count):
        (folder / f"part_{n}{suffix}").write_bytes(WRITERS[suffix](total // count, Ball()))
        parts.append(
            f"""<link name="link_{n}">
              <inertial><mass value="1"/>
                <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
              <visual><geometry><mesh filename="part_{n}{suffix}"/></geometry></visual>
            </link>"""
        )
        if n:
            parts.append(
                f"""<joint name="joint_{n}" type="revolute"><parent link="link_{n - 1}"/><child link="link_{n}"/>
                <origin xyz="0 0 0.1"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="2"/>
                </joint>"""
            )
    path = folder / "chain.urdf"
    path.write_text(f'<robot name="chain">{"".join(parts)}</robot>')
    return path


def cpu(command: str) -> float:
    """Run a shell command; return the CPU seconds of its processes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, shell=True, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> int:
    """Write the robots, run the programs in turns, and print the table."""
    count, runs = (int(word) for word in (*sys.argv[1:], *("12", "5")[len(sys.argv) - 1 :]))
    bin_folder = Path(sys.executable).parent
    check_urdf = shutil.which("check_urdf") or "/usr/bin/check_urdf"
    passed = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["URDFKIT_CACHE_DIR"] = str(folder / "cache")
        robots = [(chain(folder / kind[1:], kind), dict[str, str]()) for kind in (".stl", ".dae")]
        if CORPUS.is_dir() and count:
            shutil.copytree(CORPUS, folder / "corpus")
            os.environ["ROS_PACKAGE_PATH"] = str(folder / "corpus")
            robots += heaviest(folder / "corpus", count)
        for path, arguments in robots:
            words = " ".join(f"{key}:='{value}'" for key, value in arguments.items())
            ours = f"'{bin_folder}/urdfkit' lint --quiet '{path}' {words}"
            peers_command = f"'{bin_folder}/xacro' '{path}' {words} | '{check_urdf}' /dev/stdin"
            cpu(ours)
            commands = {"cold": ours.replace(" lint ", " lint --no-cache "), "cached": ours, "peers": peers_command}
            times: dict[str, list[float]] = {kind: [] for kind in commands}
            for _ in range(runs):
                for kind, command in commands.items():
                    times[kind].append(cpu(command))
            cold, cached, peers = (statistics.median(times[kind]) for kind in commands)
            passed &= cold <= COLD * peers and cached <= CACHED * peers
            seconds = f"cold {cold:.3f} s, cached {cached:.3f} s, peers {peers:.3f} s"
            print(f"{path.relative_to(folder)}: {seconds}: {cold / peers:.2f}, {cached / peers:.2f}", flush=True)
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
