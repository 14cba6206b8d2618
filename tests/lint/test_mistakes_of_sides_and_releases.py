"""Mistakes in places, sides and releases of a robot: each has one finding, at the line to edit."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>{}</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license></package>"""
INERTIAL = (
    '<inertial><mass value="1"/><inertia ixx="0.003" iyy="0.005" izz="0.003" ixy="0" ixz="0" iyz="0"/></inertial>'
)


def found(folder, files, *codes):
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return [(each.code, each.file.rpartition("/")[2], each.line) for each in lint(folder) if each.code in codes]


def wheel(name, place):
    return f"""<link name="{name}_wheel"><collision><origin rpy="1.570796327 0 0"/><geometry>
<cylinder radius="0.1" length="0.04"/></geometry></collision>{INERTIAL}</link>
<joint name="{name}_wheel_joint" type="continuous"><parent link="base_link"/><child link="{name}_wheel"/>
<axis xyz="0 1 0"/><origin xyz="{place}"/></joint>
"""


def cart(front, parent="base_footprint", child="base_link"):
    wheels = wheel("left", "0 0.2 0") + wheel("right", "0 -0.2 0") + wheel("front", f"0.5 0 {front}")
    return f"""<robot name="cart"><link name="base_footprint"/>
<joint name="base_joint" type="fixed"><origin xyz="0 0 0.1"/>
<parent link="{parent}"/>
<child link="{child}"/></joint>
<link name="base_link">{INERTIAL}</link>
{wheels}</robot>"""


@pytest.mark.parametrize(("front", "lines"), [(0, []), (0.02, []), (0.2, [17])])
def test_an_undriven_wheel_above_the_ground(tmp_path, front, lines):
    assert [line for _, _, line in found(tmp_path, {"cart.urdf": cart(front)}, "S908")] == lines


def test_a_footprint_whose_joint_is_swapped_is_reported_at_its_parent(tmp_path):
    assert found(tmp_path, {"cart.urdf": cart(0, "base_link", "base_footprint")}, "S911") == [("S911", "cart.urdf", 3)]


def test_a_footprint_with_the_wrong_sign_is_reported_at_its_place(tmp_path):
    robot = cart(0).replace("0 0 0.1", "0 0 -0.1")
    assert found(tmp_path, {"cart.urdf": robot}, "S911") == [("S911", "cart.urdf", 2)]


BODY = (
    '<link name="{0}"><collision><geometry><box size="{1}"/></geometry></collision><inertial><mass value="1"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
)


@pytest.mark.parametrize(
    ("hitch", "side", "lines"), [("revolute", 0.26, []), ("fixed", 0.26, [2]), ("revolute", 0.1, [2])]
)
def test_a_footprint_does_not_cover_the_trailer(tmp_path, hitch, side, lines):
    wheels = wheel("left", "0 0.2 0") + wheel("right", "0 -0.2 0")
    towed = wheel("near", "-0.6 0.4 0") + wheel("far", "-0.6 -0.4 0")
    joint = (
        f'<joint name="hitch" type="{hitch}"><origin xyz="-0.3 0 0"/><axis xyz="0 0 1"/><parent link="base_link"/>'
        '<child link="trailer"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>'
    )
    bodies = BODY.format("base_link", "0.6 0.3 0.1") + BODY.format("trailer", "0.1 0.1 0.1")
    robot = f"<robot name='tug'>{bodies}{joint}{wheels}{towed.replace('base_link', 'trailer')}</robot>"
    footprint = f"costmap:\n  footprint: [[0.3, {side}], [0.3, -{side}], [-0.3, -{side}], [-0.3, {side}]]\n"
    files = {"tug.urdf": robot, "costmap.yaml": footprint, "package.xml": MANIFEST.format("A tug.")}
    assert [line for _, _, line in found(tmp_path, files, "K979")] == lines


TUBE = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="m" value="2.0"/>
<link name="tube"><collision><origin rpy="0 1.570796327 0"/><geometry><cylinder radius="0.03" length="0.4"/></geometry>
</collision><inertial>
<origin rpy="{}"/>
<mass value="${{m}}"/>
<inertia ixx="{}" iyy="{}" izz="{}" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
FORMULAS = ("${m*(3*0.03**2 + 0.4**2)/12}", "${m*(3*0.03**2 + 0.4**2)/12}", "${m*0.03**2/2}")


@pytest.mark.parametrize(
    ("turn", "moments", "lines"),
    [
        ("0 1.570796327 0", FORMULAS, []),
        ("0 0 0", FORMULAS, [4]),
        ("0 0 0", ("0.0271", "0.0271", "0.0009"), [6]),
    ],
)
def test_an_inertial_without_the_rotation_of_its_shape(tmp_path, turn, moments, lines):
    findings = found(tmp_path, {"arm.urdf.xacro": TUBE.format(turn, *moments)}, "I519")
    assert [line for _, _, line in findings] == lines


def arms(tip="right_tcp", parent="right_hand"):
    text = '<link name="torso"/>'
    for side in ("left", "right"):
        text += f"""<link name="{side}_hand"/><link name="{side}_tcp"/>
<joint name="{side}_elbow" type="revolute"><parent link="torso"/><child link="{side}_hand"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
<joint name="{side}_tcp_joint" type="fixed">
<parent link="{parent if side == "right" else "left_hand"}"/><child link="{side}_tcp"/></joint>
<link name="{side}_finger"/><joint name="{side}_finger_joint" type="prismatic"><parent link="{side}_hand"/>
<child link="{side}_finger"/><limit lower="0" upper="0.1" effort="5" velocity="1"/></joint>
"""
    groups = "".join(
        f"""<group name="{side}_arm">
<chain base_link="torso" tip_link="{tip if side == "right" else "left_tcp"}"/></group>
<group name="{side}_gripper">
<joint name="{side}_finger_joint"/></group>
<group_state name="bent" group="{side}_arm"><joint name="{side}_elbow" value="0.5"/></group_state>
<group_state name="open" group="{side}_gripper"><joint name="{side}_finger_joint" value="0.05"/></group_state>
<end_effector name="{side}" parent_link="{side}_hand" group="{side}_gripper" parent_group="{side}_arm"/>
"""
        for side in ("left", "right")
    )
    return {
        "package.xml": MANIFEST.format("Two arms."),
        "arm.urdf": f'<robot name="arm">{text}</robot>',
        "config/arm.srdf": f'<robot name="arm">\n{groups}</robot>',
        "config/ompl_planning.yaml": "right_arm:\n  projection_evaluator: joints(right_elbow)\n",
    }


CODES = ("M104", "M105", "M106", "M107", "M109", "S909")


def test_the_chains_of_two_sides_have_no_finding(tmp_path):
    assert found(tmp_path, arms(), *CODES) == []


def test_a_chain_to_the_other_side_is_one_finding(tmp_path):
    assert found(tmp_path, arms("left_tcp"), *CODES) == [("M105", "arm.srdf", 10)]


def test_a_frame_on_the_other_side_is_one_finding(tmp_path):
    assert found(tmp_path, arms(parent="left_hand"), *CODES) == [("S909", "arm.urdf", 12)]


def test_a_group_with_the_name_of_the_other_side_is_one_finding(tmp_path):
    files = arms()
    files["config/arm.srdf"] = files["config/arm.srdf"].replace(
        '<group name="right_gripper">', '<group name="left_gripper">'
    )
    assert found(tmp_path, files, *CODES) == [("M106", "arm.srdf", 11)]


FRAME = """<robot name="arm"><link name="eye"/>
<gazebo reference="eye"><sensor name="eye" type="gpu_lidar"><topic>scan</topic>
<{0}>eye</{0}></sensor></gazebo>
<gazebo><plugin filename="{1}" name="{2}"/></gazebo></robot>"""
FORTRESS = ("ignition-gazebo-imu-system", "ignition::gazebo::systems::Imu")
HARMONIC = ("gz-sim-imu-system", "gz::sim::systems::Imu")


@pytest.mark.parametrize("plugin", [FORTRESS, HARMONIC])
@pytest.mark.parametrize("tag", ["gz_frame_id", "ignition_frame_id"])
def test_the_frame_of_a_sensor_has_either_tag_in_every_release(tmp_path, tag, plugin):
    """Gazebo Fortress reads both (gz-sensors, issue 306)."""
    assert found(tmp_path, {"arm.urdf": FRAME.format(tag, *plugin)}, "Z806") == []


MIMIC = """<robot name="arm"><link name="hand"/><link name="a"/><link name="b"/>
<joint name="a" type="continuous"><parent link="hand"/><child link="a"/><axis xyz="0 0 1"/></joint>
<joint name="b" type="continuous"><parent link="hand"/><child link="b"/><axis xyz="0 0 1"/><mimic joint="a"/></joint>
<ros2_control name="arm" type="system"><hardware><plugin>mock_components/GenericSystem</plugin></hardware>
<joint name="a"><command_interface name="position"/><state_interface name="position"/></joint>
<joint name="b">
<command_interface name="position"/>
<state_interface name="position"/></joint></ros2_control></robot>"""


@pytest.mark.parametrize(
    ("words", "lines"),
    [
        ("An arm in Gazebo Harmonic.", [7]),
        ("Uses default_planning_request_adapters/CheckStartStateBounds.", [7]),
        ("Uses default_planner_request_adapters/FixStartStateBounds.", []),
        ("An arm for ROS 2 Humble and Jazzy.", []),
        ("An arm.", []),
    ],
)
def test_a_command_of_a_mimic_joint_in_the_release_that_the_package_names(tmp_path, words, lines):
    findings = found(tmp_path, {"package.xml": MANIFEST.format(words), "arm.urdf": MIMIC}, "C720")
    assert [line for _, _, line in findings] == lines


CALLED = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="moved" params="name">
<joint name="${name}"><command_interface name="position"/><state_interface name="position"/></joint></xacro:macro>"""


def test_a_command_of_a_mimic_joint_is_at_the_call_of_a_macro_that_is_right_for_others(tmp_path):
    head, _, _ = MIMIC.partition('<joint name="a"><command')
    text = head.replace('<robot name="arm">', CALLED) + '<xacro:moved name="a"/>\n<xacro:moved name="b"/>'
    files = {"package.xml": MANIFEST.format("Gazebo Harmonic."), "arm.urdf.xacro": f"{text}</ros2_control></robot>"}
    findings = found(tmp_path, files, "C720")
    assert findings == [("C720", "arm.urdf.xacro", text.count("\n") + 1)]


LIMITS = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="limits" value="${{xacro.load_yaml('{}')}}"/><link name="hand"/><link name="left_arm"/>
<joint name="arm" type="revolute"><parent link="hand"/><child link="left_arm"/><axis xyz="0 0 1"/>
<limit lower="${{radians(limits['arm']['lower'])}}" upper="${{radians(limits['arm']['upper'])}}"
effort="5" velocity="1"/></joint></robot>"""


def test_reversed_limits_in_a_file_of_values_are_one_finding(tmp_path):
    files = {
        "package.xml": MANIFEST.format("An arm."),
        "urdf/arm.urdf.xacro": LIMITS.format(tmp_path / "config" / "limits.yaml"),
        "config/limits.yaml": "arm: {lower: 95, upper: -30}\n",
    }
    assert found(tmp_path, files, "J405", "K992") == [("K992", "limits.yaml", 1)]


TRANSMISSION = """<transmission name="{0}"><type>transmission_interface/SimpleTransmission</type>
<joint name="{0}"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="{0}_motor"/></transmission>
"""
MACRO = TRANSMISSION.replace("{0}", "${joint}")


def driven(interface="Effort", joints="abcd"):
    text = '<link name="base"/>\n'
    for name in "abcd":
        text += f"""<link name="l{name}"/><joint name="{name}" type="revolute"><parent link="base"/>
<child link="l{name}"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
"""
    calls = "".join(f'<xacro:drive joint="{name}"/>\n' for name in joints)
    macro = MACRO.replace("Effort", interface)
    plugin = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>'
    controllers = "".join(
        f"{name}_controller:\n  type: effort_controllers/JointGroupEffortController\n  joints: [{', '.join(pair)}]\n"
        for name, pair in (("first", "ab"), ("second", "cd"))
    )
    return {
        "package.xml": MANIFEST.format("An arm."),
        "urdf/arm.urdf.xacro": f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="drive" params="joint">{macro}</xacro:macro>
{text}{calls}{plugin}</robot>""",
        "config/controllers.yaml": controllers,
    }


def test_one_interface_that_two_controllers_contradict_is_one_finding(tmp_path):
    assert found(tmp_path, driven(), "K963") == []
    assert found(tmp_path, driven("Position"), "K963") == [("K963", "arm.urdf.xacro", 3)]


def test_a_missing_transmission_is_reported_after_that_of_another_joint(tmp_path):
    assert found(tmp_path, driven(joints="acd"), "K963") == [("K963", "arm.urdf.xacro", 15)]
