"""Joints at slender links, slides on rails and lidars: places that a person mistakes, next to correct ones."""

import pytest

from urdfkit.lint import lint

INERTIAL = (
    """<inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>"""
)


def box(name, size, xyz="0 0 0"):
    shape = f'<origin xyz="{xyz}"/><geometry><box size="{size}"/></geometry>'
    return f'<link name="{name}"><visual>{shape}</visual><collision>{shape}</collision>{INERTIAL}</link>\n'


def joint(parent, child, xyz, kind="revolute", limits="-1 1", axis="0 1 0", rpy="0 0 0"):
    low, high = limits.split()
    return f"""<joint name="{child}_joint" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
  <origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>
  <limit lower="{low}" upper="{high}" effort="50" velocity="1"/></joint>
"""


def found(folder, text, code):
    file = folder / "robot.urdf"
    file.write_text(f'<robot name="r">\n{text}</robot>\n')
    return [each.message for each in lint(file) if each.code == code]


LEG = (
    box("thigh", "0.04 0.04 0.3", "0 0 -0.15") + box("shank", "0.03 0.03 0.2", "0 0 -0.1") + box("foot", ".04 .04 .04")
)


@pytest.mark.parametrize(
    ("knee", "foot", "message"),
    [
        ("0 0 -0.3", "0 0 -0.2", ""),
        ("0 0.04 -0.3", "0 0.01 -0.2", ""),
        ("0 0 -0.3", "0 0 0.2", "joint `foot_joint` is at -0.2 m along `shank`, not at the end of the link, 0.2 m"),
        ("0 0.04 -0.2", "0 0 -0.2", "joint `shank_joint` is at 0.2 m along `thigh`, not at the end of the link, 0.3 m"),
        ("0 0.2 -0.2", "0 0 -0.2", ""),  # far from the axis of the thigh
        ("0 0 -0.3", "0 0 0", ""),  # at the knee
    ],
)
def test_joints_at_the_ends_of_tubes(tmp_path, knee, foot, message):
    text = LEG + joint("thigh", "shank", knee) + joint("shank", "foot", foot, "fixed")
    assert found(tmp_path, text, "J427") == ([message] if message else [])


def test_an_arm_halfway_up_a_mast(tmp_path):
    """The mast is twice as long as the arm, and no link tells whether joints are at the ends of tubes."""
    links = (
        box("mast", "0.06 0.06 1.0", "0 0 0.5") + box("arm", "0.5 0.05 0.05", "0.25 0 0") + box("eye", ".04 .04 .04")
    )
    text = links + joint("mast", "arm", "0.03 0 0.5") + joint("mast", "eye", "0 0 1.02", "fixed")
    assert found(tmp_path, text, "J427") == []


@pytest.mark.parametrize(("counter_boom", "count"), [("-0.5 0 0", 0), ("0.5 0 0", 1)])
def test_a_weight_at_the_other_end_of_a_boom(tmp_path, counter_boom, count):
    links = box("boom", "1 0.06 0.06", "0.5 0 0") + box("weight", "0.2 0.2 0.2")
    other = box("counter_boom", "1 0.05 0.05", counter_boom) + joint("boom", "counter_boom", "0 0 0", "fixed")
    assert len(found(tmp_path, links + other + joint("boom", "weight", "-1 0 0", "fixed"), "J427")) == count


@pytest.mark.parametrize(("upper", "count"), [(0.7, 0), (0.82, 0), (0.9, 1)])
def test_a_slide_that_leaves_its_mast_by_a_little(tmp_path, upper, count):
    links = box("mast", "0.14 0.14 0.9", "0 0 0.45") + box("carriage", "0.08 0.16 0.14")
    slide = joint("mast", "carriage", "0.11 0 0.15", "prismatic", f"0 {upper}", "0 0 1")
    assert len(found(tmp_path, links + slide, "J424")) == count


SENSOR = """<gazebo reference="lidar"><sensor type="ray" name="rear"><ray><scan><horizontal><samples>90</samples>
<min_angle>-1.57</min_angle><max_angle>1.57</max_angle></horizontal></scan></ray></sensor></gazebo>
"""


@pytest.mark.parametrize(
    ("visual", "yaw", "count"), [("mesh", 0, 1), ("mesh", 3.1416, 0), ("box", 0, 1), ("box", 3.1416, 0)]
)
def test_a_rear_lidar_that_looks_at_a_chassis_with_a_mesh(tmp_path, visual, yaw, count):
    base = box("base", "0.8 0.5 0.3")
    if visual == "mesh":
        base = base.replace('<box size="0.8 0.5 0.3"/>', '<mesh filename="base.stl"/>', 1)
    lidar = box("lidar", "0.05 0.05 0.05") + joint("base", "lidar", "-0.45 0 0", "fixed", rpy=f"0 0 {yaw}")
    assert len(found(tmp_path, base + lidar + SENSOR, "S915")) == count


@pytest.mark.parametrize(("depth", "count"), [(0.04, 0), (0.3, 1)])
def test_a_lidar_that_looks_through_an_arch(tmp_path, depth, count):
    """A thin collision box around a mesh may stand for a frame."""
    arch = box("arch", f"{depth} 0.6 0.5").replace(f'<box size="{depth} 0.6 0.5"/>', '<mesh filename="arch.stl"/>', 1)
    lidar = box("lidar", "0.05 0.05 0.05") + joint("arch", "lidar", "-0.25 0 0", "fixed")
    assert len(found(tmp_path, arch + lidar + SENSOR, "S915")) == count
