"""`urdfkit import`: a bare URDF becomes packages with its meshes; the file itself is only read."""

import os
import re
import struct
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.scaffold.wrap.mesh_assets import Meshes
from urdfkit.sim import Simulator

CAD = """<?xml version="1.0" encoding="utf-8"?>
<!-- written by a CAD program -->
<robot
  name="My Arm.SLDASM">
  <link
    name="base_link">
    <inertial>
      <origin xyz="0 0 0.05" rpy="0 0 0" />
      <mass value="2" />
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01" />
    </inertial>
    <visual>
      <geometry>
        <mesh
          filename="package://my_arm/meshes/base_link.STL" />
      </geometry>
    </visual>
    <collision>
      <geometry><mesh filename="package://my_arm/meshes/base_link.STL" /></geometry>
    </collision>
  </link>
  <link name="link1">
    <inertial>
      <mass value="1" />
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01" />
    </inertial>
    <visual><geometry><mesh filename='{link1}' /></geometry></visual>
  </link>
  <joint name="joint1" type="revolute">
    <origin xyz="0 0 0.1" rpy="0 0 3.1416" />
    <parent link="base_link" />
    <child link="link1" />
    <axis xyz="0 0 1" />
    <limit lower="-1" upper="1" effort="10" velocity="1" />
  </joint>
</robot>
"""


def stl(size=0.05):
    """Return a tetrahedron."""
    corners = [(0, 0, 0), (size, 0, 0), (0, size, 0), (0, 0, size)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    records = (struct.pack("<12fH", 0, 0, 0, *(v for i in face for v in corners[i]), 0) for face in faces)
    return b"\0" * 80 + struct.pack("<I", len(faces)) + b"".join(records)


@pytest.fixture
def export(tmp_path, monkeypatch):
    """A folder as CAD programs write it: urdf, meshes next to it, no package of that name to be found."""
    folder = tmp_path / "export"
    for sub in ("urdf", "meshes/fine", "other"):
        (folder / sub).mkdir(parents=True)
    (folder / "meshes/base_link.STL").write_bytes(stl())
    (folder / "meshes/fine/link1.stl").write_bytes(stl(0.04))
    (folder / "urdf/arm.urdf").write_bytes(CAD.format(link1="../meshes/fine/link1.stl").replace("\n", "\r\n").encode())
    monkeypatch.chdir(tmp_path)
    return folder


def everything(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_it_becomes_packages(export, capsys, ros):
    before = everything(export)
    assert main(["import", "export/urdf/arm.urdf", "--ros", ros, "--into", "src"]) == 0
    assert everything(export) == before
    src = export.parent / "src"
    packages = ["my_arm_bringup", "my_arm_description", "my_arm_gazebo"]
    beside = [".devcontainer", ".github", ".gitignore", ".pre-commit-config.yaml", "LICENSE", "README.md", "pytest.ini"]
    assert sorted(path.name for path in src.iterdir()) == sorted([*beside, *packages])
    reported = capsys.readouterr().out
    assert f"next to them: {', '.join(beside)}" in reported
    assert "2 meshes copied" in reported
    package = src / "my_arm_description"
    assert (package / "meshes/base_link.STL").read_bytes() == stl()
    assert (package / "meshes/fine/link1.stl").is_file()
    assert (
        "launch meshes rviz urdf" in (package / "CMakeLists.txt").read_text()
        or "meshes" in (package / "CMakeLists.txt").read_text()
    )
    text = (package / "urdf/my_arm.urdf.xacro").read_bytes().decode()
    assert 'filename="package://my_arm_description/meshes/base_link.STL"' in text
    assert "filename='package://my_arm_description/meshes/fine/link1.stl'" in text
    assert "\r\n" in text
    assert "\n" not in text.replace("\r\n", "")
    assert "<!-- written by a CAD program -->" in text
    assert "my_arm.urdf.xacro" in (package / f"launch/display.launch{'' if ros == 'noetic' else '.py'}").read_text()
    assert "Fixed Frame: base_link" in (package / "rviz/my_arm.rviz").read_text()
    errors = [finding for finding in lint([package], package_path=[src]) if finding.severity == "error"]
    assert errors == []
    robot = load(package / "urdf/my_arm.urdf.xacro", package_path=[src])
    simulator = Simulator(robot, note=lambda _: None)
    simulator.run(0.05)


def test_what_is_mended_and_left_is_reported(export, capsys):
    file = export / "urdf/arm.urdf"
    file.write_text(file.read_text().replace('<axis xyz="0 0 1" />', '<axis xyz="0 0 2" />'))
    code = main(["import", "export/urdf/arm.urdf"])
    reported = capsys.readouterr()
    assert (code, reported.err) == (0, "")
    assert "fixed: " in reported.out


@pytest.mark.parametrize(
    "uri",
    [
        "package://gone/meshes/fine/link1.stl",
        "meshes/fine/link1.stl",
        "file:///C:/Users/me/export/meshes/fine/link1.stl",
        "C:\\cad\\LINK1.STL",
        "package://export/meshes/fine/link1.stl",
    ],
)
def test_meshes_are_found_wherever_they_were_said_to_be(export, uri):
    meshes = Meshes(export / "urdf/arm.urdf")
    assert meshes.uri(uri, "arm").lower().endswith("link1.stl")
    assert list(meshes.copies) == [(export / "meshes/fine/link1.stl").resolve()]


@pytest.mark.parametrize(
    ("file", "uri"),
    [
        ("Grün Arm.stl", "package://gone/meshes/Grün Arm.stl"),
        ("Grün Arm.stl", "package://gone/meshes/Gr%C3%BCn%20Arm.stl"),
        ("Gru\u0308n Arm.stl", "meshes/Grün Arm.stl"),  # as a Mac packs it
        ("100%.stl", "meshes/100%.stl"),
    ],
)
def test_names_of_meshes_that_are_written_in_more_than_one_way(export, file, uri):
    (export / "meshes" / file).write_bytes(stl())
    meshes = Meshes(export / "urdf/arm.urdf")
    place = "100_.stl" if "100" in file else "Grun_Arm.stl"
    assert meshes.uri(uri, "arm") == f"package://arm/meshes/{place}"
    assert list(meshes.copies) == [(export / "meshes" / file).resolve()]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1"])
def test_names_that_not_every_tool_takes(export, capsys, encoding):
    (export / "meshes/Grün Arm.STL").write_bytes(stl())
    text = CAD.format(link1="package://x/meshes/Grün Arm.STL").replace("link1", "Grün Arm").replace("joint1", "Joint 1")
    text = text.replace("base_link.STL", "B").replace("base_link", "base link").replace("B", "base_link.STL")
    plugin = '<gazebo><plugin name="p" filename="libgazebo_ros_p3d.so"><bodyName>base link</bodyName></plugin></gazebo>'
    text = text.replace("</robot>", f'<gazebo reference="Grün Arm"><mu1>1</mu1></gazebo>{plugin}</robot>')
    file = export / "urdf/arm.urdf"
    file.write_bytes(text.replace("utf-8", encoding.removesuffix("-sig")).encode(encoding))
    assert main(["import", "export/urdf/arm.urdf", "--ros", "noetic"]) == 0
    reported = "`My Arm.SLDASM` → `my_arm`, `base link` → `base_link`, `Grün Arm` → `Grun_Arm`, `Joint 1` → `Joint_1`"
    assert f"\nrenamed: {reported}\n" in capsys.readouterr().out
    package = export.parent / "my_arm_description"
    robot = load(package / "urdf/my_arm.urdf.xacro", package_path=[export.parent])
    assert (robot.name, [link.name for link in robot.links]) == ("my_arm", ["base_link", "Grun_Arm"])
    joint = robot.joint_by_name["Joint_1"]
    assert (joint.parent, joint.child) == ("base_link", "Grun_Arm")
    assert [block.reference for block in robot.gazebo] == ["Grun_Arm", None]
    assert robot.gazebo[1].plugins[0].element.find("bodyName").text == "base_link"
    assert (package / "meshes/Grun_Arm.STL").is_file()
    assert not [finding for finding in lint([package], package_path=[export.parent]) if finding.code == "N302"]


def test_files_of_one_name_are_kept_apart(export):
    (export / "other/link1.stl").write_bytes(stl(0.03))
    meshes = Meshes(export / "urdf/arm.urdf")
    assert meshes.uri("../meshes/fine/link1.stl", "arm") == "package://arm/meshes/fine/link1.stl"
    assert meshes.uri("../other/link1.stl", "arm") == "package://arm/meshes/link1.stl"
    (export / "urdf/link1.stl").write_bytes(stl(0.02))
    assert meshes.uri("link1.stl", "arm") == "package://arm/meshes/link1_2.stl"
    assert meshes.uri("link1.stl", "arm") == "package://arm/meshes/link1_2.stl"


def test_what_a_mesh_needs_comes_along(export):
    (export / "meshes/a.obj").write_text("mtllib a.mtl\nv 0 0 0\n")
    (export / "meshes/a.mtl").write_text("newmtl m\nmap_Kd tex/a.png\n")
    (export / "meshes/tex").mkdir()
    (export / "meshes/tex/a.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    meshes = Meshes(export / "urdf/arm.urdf")
    meshes.uri("../meshes/a.obj", "arm")
    assert sorted(meshes.copies.values()) == ["meshes/a.mtl", "meshes/a.obj", "meshes/tex/a.png"]


def test_a_missing_mesh_is_refused(export, capsys):
    (export / "meshes/fine/link1.stl").unlink()
    assert main(["import", "export/urdf/arm.urdf", "--into", "src"]) == 2
    reported = capsys.readouterr().err
    assert "no file for `../meshes/fine/link1.stl`; nothing was written" in reported
    assert not (export.parent / "src").exists()
    (export.parent / "elsewhere").mkdir()
    (export.parent / "elsewhere/link1.stl").write_bytes(stl())
    assert main(["import", "export/urdf/arm.urdf", "--meshes", "elsewhere"]) == 0


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["export/urdf/arn.urdf"], "did you mean `export/urdf/arm.urdf`?"),
        (["export/urdf/arm.urdf", "--ros", "noetik"], "did you mean `noetic`?"),
        (["export/urdf/arm.urdf", "--name", "My Arm"], "did you mean `my_arm`?"),
        (["export/urdf/arm.urdf", "--meshs", "a"], "did you mean `--meshes`?"),
        (["export/urdf/arm.urdf", "--meshes", "a"], "--meshes: no such folder: a"),
        (["export/urdf/two.urdf"], "urdfkit: export/urdf/two.urdf:1:"),
        (["x.xacro"], "is a xacro file"),
        (["export/urdf/arm.urdf", "--out", "a"], "did you mean `--into`?"),
        (["export/urdf/arm.urdf", "src"], "did you mean `--into src`?"),
        (["export/urdf/room.sdf"], "room.sdf is SDF"),
        (["export/meshes/base_link.STL"], "base_link.STL is a mesh: import the URDF that names it"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_written(export, capsys, words, says):
    (export / "urdf/two.urdf").write_text('<robot name="t"><link name="a"/><link name="b"/></robot>')
    (export.parent / "x.xacro").write_text("<robot/>")
    (export / "urdf/room.sdf").write_text("<sdf/>")
    before = everything(export.parent)
    assert main(["import", *words]) == 2
    reported = capsys.readouterr().err
    assert says in reported
    assert reported.count("\n") == 1
    assert everything(export.parent) == before


def test_nothing_is_overwritten(export, capsys):
    (export.parent / "my_arm_gazebo").mkdir()
    assert main(["import", "export/urdf/arm.urdf"]) == 2
    assert "my_arm_gazebo already exists" in capsys.readouterr().err
    assert not (export.parent / "my_arm_description").exists()


@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_what_was_wrapped_can_be_added_to(export, ros):
    assert main(["import", "export/urdf/arm.urdf", "--ros", ros]) == 0
    assert main(["new", "controllers", "--into", "my_arm_description"]) == 0
    assert main(["new", "sensor", "camera", "--into", "my_arm_description", "--parent", "link1"]) == 0
    here = export.parent
    robot = load(here / "my_arm_description/urdf/my_arm.urdf.xacro", package_path=[here])
    names = {status.name for status in Simulator(robot, note=lambda _: None).controllers.list()}
    assert any(name.endswith("controller") for name in names)
    assert "camera_optical_frame" in robot.link_by_name


@pytest.mark.catkin
def test_the_packages_build(export, debian):
    assert main(["import", "export/urdf/arm.urdf", "--ros", "noetic", "--into", "src"]) == 0
    assert "found 0 problems" in debian("catkin_lint -W2 --strict --offline src")
    debian("catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    assert (export.parent / "install/share/my_arm_description/meshes/fine/link1.stl").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_it_has_what_new_robots_have(export, ros):
    """The same tests, CI and settings, from the same files."""
    file = export / "urdf/arm.urdf"
    file.write_text(file.read_text().replace("My Arm.SLDASM", "My-Arm"))
    assert main(["import", "export/urdf/arm.urdf", "--ros", ros, "--into", "src"]) == 0
    assert main(["new", "robot", "my_arm", "--drive", "none", "--ros", ros, "--into", "new", "--yes", "-q"]) == 0
    ours, new = export.parent / "src", export.parent / "new"
    same = [
        path.relative_to(new)
        for pattern in (
            ".github/**/*",
            ".devcontainer/*",
            ".gitignore",
            ".pre-commit-config.yaml",
            "*/test/*",
            "*/.gitignore",
        )
        for path in new.glob(pattern)
        if path.is_file()
    ]
    assert len(same) >= 9
    for path in same:
        text = (new / path).read_text().replace('== "my_arm"', '== "My-Arm"')
        assert (ours / path).read_text() == text, path
    assert "The robot my_arm: imported from `arm.urdf`." in (ours / "README.md").read_text()
    for path in ours.rglob("*"):
        if path.is_file() and b"\0" not in path.read_bytes():
            assert not re.search(r"@[a-z_]+@", path.read_text()), path
    for kind in ("description", "gazebo", "bringup"):
        package = ours / f"my_arm_{kind}"
        needed = {element.text for element in ET.parse(package / "package.xml").getroot().iter("test_depend")}
        assert needed & {"roslaunch", "ament_cmake_pytest"}
        assert "TESTING)" in (package / "CMakeLists.txt").read_text()


def test_import_keeps_the_other_files_of_its_output_folder(export, capsys):
    src = export.parent / "src"
    src.mkdir()
    (src / "README.md").write_text("mine")
    assert main(["import", "export/urdf/arm.urdf", "--into", "src"]) == 0
    assert "next to them" not in capsys.readouterr().out
    assert not (src / ".github").exists()
    assert main(["import", "export/urdf/arm.urdf", "--into", "src", "--name", "other", "--repository"]) == 0
    assert (src / "README.md").read_text() == "mine"
    assert (src / ".github/workflows/ci.yml").is_file()


@pytest.mark.slow
def test_a_robot_of_plain_shapes_is_drawn(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.urdf").write_text(
        '<robot name="box"><link name="a"><inertial><mass value="1"/>'
        '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>'
        '<visual><geometry><box size="0.3 0.3 0.3"/></geometry></visual>'
        '<collision><geometry><box size="0.3 0.3 0.3"/></geometry></collision></link></robot>'
    )
    assert main(["import", "box.urdf", "--into", "src"]) == 0
    assert "![box](box_description/docs/box.svg)" in (tmp_path / "src/README.md").read_text()
    assert (tmp_path / "src/box_description/docs/box.svg").read_text().startswith("<svg")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "."],
        cwd=tmp_path / "src", capture_output=True, text=True, check=False,
        env={**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout


def test_without_ros_it_is_the_description_alone(export, monkeypatch):
    assert main(["import", "export/urdf/arm.urdf", "--ros", "none", "--into", "src"]) == 0
    src = export.parent / "src"
    assert [path.name for path in src.iterdir() if path.is_dir() and path.name[0] != "."] == ["my_arm_description"]
    package = src / "my_arm_description"
    assert {path.name for path in package.iterdir()} == {
        "meshes", "urdf", "test", "README.md", "LICENSE", ".gitignore"
    }  # fmt: skip
    monkeypatch.chdir("/")
    robot = load(package / "urdf/my_arm.urdf.xacro")
    assert [finding for finding in lint([src]) if finding.severity == "error"] == []
    Simulator(robot, note=lambda _: None).run(0.05)
    assert main(["view", str(package), "--html", str(export / "page.html"), "-q"]) == 0


@pytest.mark.parametrize("ros", ["jazzy", "noetic", "none"])
def test_names_that_a_uri_would_have_to_escape(export, ros):
    """Exporters take the names of parts as they are; who reads URIs does not agree on blanks, ``#`` and ``%``."""
    (export / "meshes/Arm, v2 & #1 100%.STL").write_bytes(stl())
    uri = "package://my_arm/meshes/Arm, v2 &amp; #1 100%.STL"
    file = export / "urdf/arm.urdf"
    file.write_text(file.read_text().replace("../meshes/fine/link1.stl", uri))
    assert main(["import", "export/urdf/arm.urdf", "--ros", ros, "--into", "src"]) == 0
    package = export.parent / "src/my_arm_description"
    assert sorted(path.name for path in (package / "meshes").iterdir()) == ["Arm_v2_1_100_.STL", "base_link.STL"]
    robot = load(package / "urdf/my_arm.urdf.xacro", package_path=[package.parent])
    Simulator(robot, note=lambda _: None).run(0.01)


def test_what_its_own_test_will_say_is_reported(export, capsys):
    assert main(["import", "export/urdf/arm.urdf", "--into", "src"]) == 0
    reported = capsys.readouterr().out
    assert "remaining: 1 × I507" in reported
    assert "the package's lint test fails until these findings are fixed" in reported
