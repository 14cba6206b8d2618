"""Correct files that resemble a defect: no finding; and the defect next to each: a finding."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

LINKS = '<link name="base"/><link name="tip"/>'
JOINT = '<joint name="j" type="fixed"><parent link="base"/><child link="tip"/>{}</joint>'
PREFIX = ' xmlns:xacro="http://www.ros.org/wiki/xacro"'
TENSOR = '<mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'


def robot(content: str, attributes: str = "") -> str:
    return f'<robot name="arm"{attributes}>{content}</robot>'


def codes(folder: Path, files: dict[str, str], **options: object) -> list[str]:
    """Write the files of a package and return severity and code of each finding in the first one."""
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return [f"{found.severity} {found.code}" for found in lint(folder / next(iter(files)), **options)]


def launch(command: str) -> str:
    return f'<launch><param name="robot_description" command="{command} $(find arm)/arm.urdf"/></launch>'


@pytest.mark.parametrize(
    ("content", "attributes", "is_reported"),
    [
        (LINKS + JOINT.format('<controller_gains kp="3"/>'), PREFIX, False),
        ('<link name="base"><traits a="1"/></link>', PREFIX, False),
        ('<link name="base"><visual><geometry><torus r="1"/></geometry></visual></link>', PREFIX, False),
        (f'<link name="base"><inertial>{TENSOR}<visual/></link>', PREFIX, False),  # a deleted end tag
        (f'<link name="base"><inertial>{TENSOR}<disc m="1"/></inertial></link>', PREFIX, True),
        (f'<link name="base"><inertial>{TENSOR}<disc m="1"/></inertial></link>', "", False),
        ('<material name="a"><color rgba="${1} 0 0 1"/></material>', PREFIX, False),  # a file to be included
        ('<link name="base"/><material name="a"><color rgba="${1} 0 0 1"/></material>', PREFIX, True),
    ],
)
def test_plain_urdf_without_xacro(content: str, attributes: str, is_reported: bool, tmp_path: Path) -> None:
    found = codes(tmp_path, {"arm.urdf": robot(content, attributes)})
    assert ("warning X123" in found) is is_reported


@pytest.mark.parametrize(
    ("file", "text", "found"),
    [
        ("arm.urdf", robot(""), ["error T211"]),
        ("arm.URDF", robot(""), ["error T211"]),
        ("arm.xml", robot(""), []),  # a fragment
        ("arm.urdf", '<robot name="arm"><link name="base"</robot>', ["error E001"]),
    ],
)
def test_robots_without_links(file: str, text: str, found: list[str], tmp_path: Path) -> None:
    assert codes(tmp_path, {file: text}) == found


@pytest.mark.parametrize(("command", "is_reported"), [("xacro", False), ("cat", True)])
def test_urdf_on_which_a_launch_file_runs_xacro(command: str, is_reported: bool, tmp_path: Path) -> None:
    text = robot('<xacro:property name="a" value="1"/><link name="base"/>', PREFIX)
    package = "<package><name>arm</name></package>"
    found = codes(tmp_path, {"arm.urdf": text, "package.xml": package, "launch/arm.launch": launch(command)})
    assert ("warning X123" in found) is is_reported


@pytest.mark.parametrize(
    ("include", "is_reported"),
    [
        ('<!-- <xacro:include filename="tool.xacro"/> -->', False),
        ("", True),
    ],
)
def test_fragment_with_a_commented_include(include: str, is_reported: bool, tmp_path: Path) -> None:
    (tmp_path / "arm.xacro").write_text(robot(f'<link name="base"/>{include}', PREFIX))
    visual = '<visual><geometry><sphere radius="1"/></geometry><material name="red"/></visual>'
    tool = f'<link name="tip">{visual}</link>{JOINT.format("")}'
    (tmp_path / "tool.xacro").write_text(robot(tool, PREFIX))
    found = {finding.code for finding in lint(tmp_path)}
    assert found == ({"T201", "G612"} if is_reported else set())


@pytest.mark.parametrize(
    ("declaration", "launch_arguments", "expected"),
    [
        ("", None, "error X106"),
        ("", "", "error X106"),
        ("", " prefix:=a_", "note X106"),
        ('<xacro:arg name="prefix"/>', None, None),  # X125
        ('<xacro:arg name="prefix"/>', "", None),
        ('<xacro:arg name="prefx" default=""/>', None, "error X106"),
        ('<xacro:arg name="prefix" default=""/>', None, None),
    ],
)
def test_arguments_that_users_pass(
    declaration: str, launch_arguments: str | None, expected: str | None, tmp_path: Path
) -> None:
    text = robot(f'{declaration}<link name="$(arg prefix)base"/>', PREFIX)
    files = {"arm.urdf.xacro": text, "package.xml": "<package><name>arm</name><depend>xacro</depend></package>"}
    if launch_arguments is not None:
        command = f"xacro $(find arm)/arm.urdf.xacro{launch_arguments}"
        files["launch/arm.launch"] = f'<launch><param name="robot_description" command="{command}"/></launch>'
    found = [each for each in codes(tmp_path, files) if each.endswith("X106")]
    assert found == ([expected] if expected else [])


@pytest.mark.parametrize(("default", "expected"), [("small", []), ("nothing", ["note X125"])])
def test_default_of_an_argument_that_selects_no_file(default: str, expected: list[str], tmp_path: Path) -> None:
    argument = f'<xacro:arg name="size" default="{default}"/><xacro:property name="s" value="$(arg size)"/>'
    content = '<xacro:property name="c" value="${xacro.load_yaml(\'config/\' + s + \'/c.yaml\')}"/><link name="base"/>'
    text = robot(f'{argument}{content}<material name="${{c[\'a\']}}"><color rgba="1 1 1 1"/></material>', PREFIX)
    found = codes(tmp_path, {"arm.urdf.xacro": text, "config/small/c.yaml": "a: red"})
    assert [each for each in found if each.endswith("X125")] == expected


@pytest.mark.parametrize(("dependency", "expected"), [("<depend>lidar</depend>", "warning X113"), ("", "error X113")])
def test_packages_that_are_not_installed(dependency: str, expected: str, tmp_path: Path) -> None:
    text = robot('<xacro:include filename="$(find lidar)/lidar.xacro"/><link name="base"/>', PREFIX)
    manifest = f"<package><name>arm</name>{dependency}<depend>xacro</depend></package>"
    assert expected in codes(tmp_path, {"arm.urdf.xacro": text, "package.xml": manifest})


YAML = """controller_manager:
  ros__parameters:
    arm_controller:
      type: {kind}
arm_controller:
  ros__parameters:
    joints: [{joints}]
"""
TRAJECTORY = "joint_trajectory_controller/JointTrajectoryController"
ELBOW = robot(LINKS + '<joint name="elbow" type="fixed"><parent link="base"/><child link="tip"/></joint>')


def near(folder: Path, files: dict[str, str]) -> list[str]:
    """Return the codes of the findings in a package `arm` with these files, in a workspace with `lib`."""
    manifests = {name: f"<package><name>{name}</name></package>" for name in ("arm", "lib")}
    written = {"arm/arm.urdf": ELBOW, **{f"{name}/package.xml": text for name, text in manifests.items()}, **files}
    return sorted({each.partition(" ")[2] for each in codes(folder, written) if " K9" in each})


@pytest.mark.parametrize(
    ("joints", "is_reported"),
    [
        ("elbow", False),
        ("elbo", True),
        ("finger_1, finger_2", False),  # another robot
        ("elbow, finger_1", True),
    ],
)
def test_controller_joints_of_another_robot(joints: str, is_reported: bool, tmp_path: Path) -> None:
    yaml = YAML.format(kind=TRAJECTORY, joints=joints)
    assert near(tmp_path, {"arm/config/a.yaml": yaml}) == (["K959"] if is_reported else [])


def test_controller_joints_that_a_missing_package_may_define(tmp_path: Path) -> None:
    hand = robot('<xacro:include filename="$(find hand)/hand.xacro"/><link name="base"/>', PREFIX)
    files = {"arm/config/a.yaml": YAML.format(kind=TRAJECTORY, joints="elbow, finger_1"), "arm/with_hand.xacro": hand}
    assert near(tmp_path, files) == []


@pytest.mark.parametrize(
    ("source", "is_reported"),
    [
        ("PLUGINLIB_EXPORT_CLASS(joint_trajectory_controllers::JointTrajectoryController, X)", False),
        ("PLUGINLIB_EXPORT_CLASS(other::JointTrajectoryController, X)", True),
    ],
)
def test_controller_types_that_a_package_exports(source: str, is_reported: bool, tmp_path: Path) -> None:
    yaml = YAML.format(kind="joint_trajectory_controllers/JointTrajectoryController", joints="elbow")
    found = near(tmp_path, {"arm/config/a.yaml": yaml, "lib/src/controller.cpp": source})
    assert found == (["K962"] if is_reported else [])


@pytest.mark.parametrize(
    ("path", "is_reported"),
    [
        ("maps/office.yaml", False),
        ("data/run.bag", False),
        ("secret/calibration.yaml", False),  # ignored by git
        ("config/pid.yaml", True),
        ("config/rvizz.rviz", True),
    ],
)
def test_files_that_are_created_at_run_time(path: str, is_reported: bool, tmp_path: Path) -> None:
    text = f'<launch><arg name="file" default="$(find arm)/{path}"/></launch>'
    files = {"arm/launch/a.launch": text, "arm/config/rviz.rviz": "", "arm/.gitignore": "secret/\n"}
    assert near(tmp_path, files) == (["K958"] if is_reported else [])


def shape(kind: str, geometry: str) -> str:
    return f"<{kind}><geometry>{geometry}</geometry></{kind}>"


BOX, SPHERE = '<box size="0.1 0.1 0.1"/>', '<sphere radius="{}"/>'
SMALL = '<mass value="1"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/>'


@pytest.mark.parametrize(
    ("visual", "collision", "is_reported"),
    [
        (BOX, SPHERE.format(1.5), False),
        (BOX, SPHERE.format(50), True),  # millimetres
        (BOX, '<box size="3 3 3"/>', True),
        (SPHERE.format(0.05), SPHERE.format(1.5), True),
    ],
)
def test_collision_spheres_around_a_link(visual: str, collision: str, is_reported: bool, tmp_path: Path) -> None:
    content = f"<inertial>{SMALL}</inertial>{shape('visual', visual)}{shape('collision', collision)}"
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base">{content}</link>')})
    assert ("warning G617" in found) is is_reported


@pytest.mark.parametrize(("products", "is_reported"), [(("0.0001", "-0.0001"), False), (("0", "0"), True)])
def test_tensors_of_mirrored_parts(products: tuple[str, str], is_reported: bool, tmp_path: Path) -> None:
    rest = 'ixz="0" iyy="0.05" iyz="0" izz="0.0052"/></inertial>' + shape("visual", '<box size="0.32 0.31 0.3"/>')
    links = "".join(
        f'<link name="{name}"><inertial><mass value="3"/><inertia ixx="0.05" ixy="{product}" {rest}</link>'
        for name, product in zip(("base", "tip"), products, strict=True)
    )
    found = codes(tmp_path, {"arm.urdf": robot(links + JOINT.format(""))})
    assert ("warning I506" in found) is is_reported


LIMIT = '<limit lower="-1" upper="1" effort="{}" velocity="2"/>'
MOVING = '<joint name="{0}" type="revolute"><parent link="base"/><child link="{0}_link"/><axis xyz="0 0 1"/>{1}</joint>'


@pytest.mark.parametrize(
    ("efforts", "expected"),
    [((-1, -1), {"note"}), ((-1, 5), {"error"}), ((-5, -5), {"error"}), ((-1,), {"error"}), ((5, 5), set())],
)
def test_limits_of_minus_one_at_every_joint(efforts: tuple[int, ...], expected: set[str], tmp_path: Path) -> None:
    content = "".join(
        f'<link name="j{i}_link"/>{MOVING.format(f"j{i}", LIMIT.format(effort))}' for i, effort in enumerate(efforts)
    )
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base"/>{content}')})
    assert {each.partition(" ")[0] for each in found if each.endswith("J410")} == expected


@pytest.mark.parametrize(
    ("kind", "geometry", "target", "severity"),
    [
        ("collision", '<sphere radius="0"/>', None, "note"),  # a contact point
        ("collision", '<sphere radius="-1"/>', None, "error"),
        ("visual", '<sphere radius="0"/>', None, "warning"),
        ("collision", '<box size="1 1 0"/>', None, "warning"),
        ("collision", '<sphere radius="0"/>', "mujoco", "error"),
    ],
)
def test_sizes_that_readers_reject(kind: str, geometry: str, target: str | None, severity: str, tmp_path: Path) -> None:
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base">{shape(kind, geometry)}</link>')}, target=target)
    assert [each for each in found if each.endswith("G611")] == [f"{severity} G611"]


@pytest.mark.parametrize(
    ("reference", "content", "severity"),
    [
        ("stick", "<mu1>1</mu1>", "warning"),
        ("bse", "<mu1>1</mu1>", "error"),
        ("stick", '<sensor name="s" type="imu"/>', "error"),
    ],
)
def test_leftover_gazebo_blocks(reference: str, content: str, severity: str, tmp_path: Path) -> None:
    block = f'<gazebo reference="{reference}">{content}</gazebo>'
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base"/>{block}')})
    assert [each for each in found if each.endswith("Z801")] == [f"{severity} Z801"]


IMPOSSIBLE = '<mass value="{0}"/><inertia ixx="{1}" ixy="0" ixz="0" iyy="{1}" iyz="0" izz="{2}"/>'


@pytest.mark.parametrize(
    ("mass", "moment", "joint", "severity"),
    [
        (0.001, 1e-5, "fixed", "note"),
        (0.001, 1e-5, "floating", "error"),
        (1.0, 1e-5, "fixed", "warning"),  # a tenth of the mass of the base
        (0.001, 1.0, "fixed", "warning"),
        (1.0, 1e-5, "floating", "error"),
    ],
)
def test_impossible_tensors_of_small_parts(
    mass: float, moment: float, joint: str, severity: str, tmp_path: Path
) -> None:
    base = '<link name="base"><inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1.5"/>'
    part = f'<link name="tip"><inertial>{IMPOSSIBLE.format(mass, moment, 3 * moment)}</inertial></link>'
    content = f"{base}</inertial></link>{part}{JOINT.format('').replace('fixed', joint)}"
    found = codes(tmp_path, {"arm.urdf": robot(content)})
    assert [each for each in found if each.endswith("I503")] == [f"{severity} I503"]


@pytest.mark.parametrize(
    ("tensor", "severity"),
    [("ixx=0 iyy=1 izz=1", "warning"), ("ixx=0 iyy=0 izz=1", "error"), ("ixx=-1 iyy=1 izz=1", "error")],
)
def test_tensor_of_a_thin_rod(tensor: str, severity: str, tmp_path: Path) -> None:
    moments = " ".join(f'{name}="{value}"' for name, value in (word.split("=") for word in tensor.split()))
    inertial = f'<inertial><mass value="1"/><inertia {moments} ixy="0" ixz="0" iyz="0"/></inertial>'
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base">{inertial}</link>')})
    assert f"{severity} I502" in found


@pytest.mark.parametrize(("size", "is_reported"), [("0.001", False), ("0.005", True)])
def test_visuals_that_stand_in_for_a_shape(size: str, is_reported: bool, tmp_path: Path) -> None:
    shapes = shape("visual", SPHERE.format(size)) + shape("collision", SPHERE.format(0.3))
    small = SMALL.replace("0.002", "0.00001")
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base"><inertial>{small}</inertial>{shapes}</link>')})
    assert ("warning G617" in found) is is_reported
    alone = f"<inertial>{SMALL}</inertial>{shape('visual', SPHERE.format(size))}"
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base">{alone}</link>')})
    assert ("warning I514" in found) is is_reported


@pytest.mark.parametrize(
    ("name", "is_reported"), [("HalfDifferentialTransmission", False), ("SimpleTransmision", True)]
)
def test_transmissions_of_other_packages(name: str, is_reported: bool, tmp_path: Path) -> None:
    content = f'<transmission name="t"><type>transmission_interface/{name}</type></transmission>'
    found = codes(tmp_path, {"arm.urdf": robot(f'<link name="base"/>{content}')})
    assert ("error C715" in found) is is_reported


def test_mesh_uri_without_package(tmp_path: Path) -> None:
    mesh = '<mesh filename="package:///arm/a.stl"/>'
    (tmp_path / "arm.urdf").write_text(robot(f'<link name="base">{shape("visual", mesh)}</link>'))
    (found,) = (finding for finding in lint(tmp_path / "arm.urdf") if finding.code == "G602")
    assert "three slashes" in found.message
