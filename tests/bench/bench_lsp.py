"""From a key to the diagnostics: ``urdfkit lsp`` over pipes, on a robot of a hundred links.

Run it as ``python tests/bench/bench_lsp.py [LINKS] [EDITS] [MESHES]``. The first MESHES links show a mesh of 2.4 MB.
Each edit changes a number of one link; timed is from the change sent to the diagnostics received. CPU is that of the
server, where the system tells (Linux).
"""

from __future__ import annotations

import re
import sys
import tempfile
import time
from pathlib import Path

import trimesh

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.lsp.conftest import connected

HEAD = (
    '<robot name="chain" xmlns:xacro="http://www.ros.org/wiki/xacro">\n  <xacro:property name="size" value="0.05"/>\n'
)
SEGMENT = """  <link name="{link}">
    <inertial>
      <origin xyz="0 0 0.1"/>
      <mass value="1.0"/>
      <inertia ixx="0.0035" ixy="0" ixz="0" iyy="0.0035" iyz="0" izz="0.0005"/>
    </inertial>
    <visual><origin xyz="0 0 0.1"/><geometry><box size="${{size}} ${{size}} 0.2"/></geometry></visual>
    <collision><origin xyz="0 0 0.1"/><geometry><box size="${{size}} ${{size}} 0.2"/></geometry></collision>
  </link>
"""
JOINT = """  <joint name="{joint}" type="revolute">
    <parent link="{parent}"/>
    <child link="{link}"/>
    <origin xyz="0 0 0.2"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/>
  </joint>
"""


def robot(links: int, mass: str, *, form: str, meshes: int = 0) -> str:
    """Return a chain: links written out (``plain``, or ``written`` with expressions) or made by a ``macro``."""
    if form == "macro":
        body = SEGMENT.replace("{{", "{").replace("}}", "}").replace("{link}", "link_${i}")
        joint = JOINT.format(joint="joint_${i}", parent="${parent}", link="link_${i}")
        macro = f'  <xacro:macro name="segment" params="i parent">\n{body}{joint}  </xacro:macro>\n'
        calls = [f'  <xacro:segment i="{i}" parent="link_{i - 1}"/>\n' for i in range(1, links)]
        first = SEGMENT.format(link="link_0")
        return "".join([HEAD, macro, first, *calls, "</robot>\n"]).replace("1.0", mass, 1)
    parts = [HEAD]
    for index in range(links):
        segment = SEGMENT.format(link=f"link_{index}")
        if index < meshes:
            mesh = f'<visual><origin xyz="0 0 0.1"/><geometry><mesh filename="meshes/{index}.stl"/></geometry></visual>'
            segment = re.sub("<visual>.*</visual>", mesh, segment)
        parts.append(segment)
        if index:
            parts.append(JOINT.format(joint=f"joint_{index}", parent=f"link_{index - 1}", link=f"link_{index}"))
    text = "".join([*parts, "</robot>\n"])
    if form == "plain":
        text = text.replace("${size}", "0.05").replace(HEAD, '<robot name="chain">\n')
    return text.replace("1.0", mass, 1)


def main() -> int:
    links = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    edits = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    meshes = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    for form in ("plain", "written") if meshes else ("plain", "written", "macro"):
        name = "chain.urdf" if form == "plain" else "chain.urdf.xacro"
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder).resolve()
            (place / name).write_text(robot(links, "1.0", form=form, meshes=meshes))
            write_meshes(place / "meshes", meshes)
            with connected(place) as client:
                client.open(name)
                client.published(name)
                walls, cpus = [], []
                for edit in range(edits):
                    mass = f"{1.0 + edit / 1000:.3f}" if edit % 5 else "-1.0"
                    text = robot(links, mass, form=form, meshes=meshes)
                    before, start = cpu_of(client.process.pid), time.perf_counter()
                    client.change(name, text)
                    diagnostics = client.published(name)
                    walls.append(time.perf_counter() - start)
                    cpus.append(cpu_of(client.process.pid) - before)
                    assert bool(diagnostics) is (mass == "-1.0"), diagnostics[:2]
        print(f"{form:8s} {links} links  wall {spread(walls)}   cpu {spread(cpus)}")
    return 0


def write_meshes(folder: Path, count: int) -> None:
    """Write binary STL files of boxes with 49,152 triangles each."""
    folder.mkdir()
    box = trimesh.creation.box((0.05, 0.05, 0.2))
    for _ in range(6):
        box = box.subdivide()
    for index in range(count):
        box.export(folder / f"{index}.stl")
    time.sleep(2.5 * bool(count))  # files that have just changed are read again at each key, old ones are not


def spread(times: list[float]) -> str:
    ordered = sorted(times)
    return f"median {ordered[len(ordered) // 2] * 1e3:5.1f} ms  p95 {ordered[int(0.95 * len(ordered))] * 1e3:5.1f} ms"


def cpu_of(pid: int) -> float:
    """Return the CPU seconds of a process; 0 where the system does not tell."""
    try:
        tasks = Path(f"/proc/{pid}/task").iterdir()
        return sum(int((task / "schedstat").read_text().split()[0]) for task in tasks) / 1e9
    except OSError:
        return 0.0


if __name__ == "__main__":
    sys.exit(main())
