"""`urdfkit new controllers`: joints that nothing drives get a controller, those that something drives no second one."""

import re
import shutil
from xml.etree import ElementTree

import pytest
import yaml

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.resources import robots_dir
from urdfkit.scaffold.additions.controller_gains import gains
from urdfkit.scaffold.additions.joint_controllers import controllers
from urdfkit.scaffold.additions.joint_roles import Roles, roles
from urdfkit.sim import Simulator

INERTIAL = '<inertial><mass value="{0}"/><inertia ixx="{1}" ixy="0" ixz="0" iyy="{1}" iyz="0" izz="{1}"/></inertial>'
BOX = "<{0}><geometry><box size='{1}'/></geometry></{0}>"
WHEEL = """
  <link name="{name}">
    <inertial><mass value="0.5"/><inertia ixx="0.0009" ixy="0" ixz="0" iyy="0.0016" iyz="0" izz="0.0009"/></inertial>
    <visual><origin rpy="${{pi/2}} 0 0"/><geometry><cylinder radius="{r}" length="0.04"/></geometry></visual>
    <collision><origin rpy="${{pi/2}} 0 0"/><geometry><cylinder radius="{r}" length="0.04"/></geometry></collision>
  </link>
  <joint name="{name}_joint" type="continuous">
    <parent link="base"/><child link="{name}"/><origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/>
    <limit effort="5" velocity="20"/>
  </joint>"""
LINK = """
  <link name="{name}">
    {inertial}
    <visual><origin xyz="0 0 0.1"/><geometry><box size="0.04 0.04 0.2"/></geometry></visual>
  </link>
  <joint name="{name}_joint" type="{type}">
    <parent link="{parent}"/><child link="{name}"/><origin xyz="0 0 {z}"/><axis xyz="{axis}"/>
    <limit lower="{low}" upper="1.5" effort="30" velocity="2"/>{more}
  </joint>"""


def part(name, parent, *, type="revolute", z=0.2, axis="0 1 0", low=-1.5, more=""):
    inertial = INERTIAL.format(0.3, 0.002)
    return LINK.format(**locals())


ARM = (
    part("shoulder", "base", z=0.05, axis="0 0 1")
    + part("elbow", "shoulder")
    + part("finger", "elbow", type="prismatic", low=0)
    + part("other", "elbow", type="prismatic", low=0, more='<mimic joint="finger_joint"/>')
)
ROVER = WHEEL.format(name="left", x=0, y=0.16, r=0.08) + WHEEL.format(name="right", x=0, y=-0.16, r=0.08)


def robot(place, body, build="ament_cmake", needs=""):
    """Write a package with a robot that nothing drives."""
    folder = place / "rover_description"
    (folder / "urdf").mkdir(parents=True)
    base = (
        '<link name="base_footprint"/><joint name="base_joint" type="fixed"><parent link="base_footprint"/>'
        f'<child link="base"/></joint>\n  <link name="base">{INERTIAL.format(5, 0.05)}'
        f"{BOX.format('visual', '0.3 0.25 0.1')}{BOX.format('collision', '0.3 0.25 0.1')}</link>"
    )
    (folder / "urdf/rover.urdf.xacro").write_text(
        '<?xml version="1.0"?>\n<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f"  {base}{body}\n</robot>\n"
    )
    (folder / "package.xml").write_text(
        '<?xml version="1.0"?>\n<package format="3">\n  <name>rover_description</name>\n  <version>0.1.0</version>\n'
        '  <description>a rover</description>\n  <maintainer email="a@example.com">a</maintainer>\n'
        "  <license>MIT</license>\n\n"
        f"  <buildtool_depend>{build}</buildtool_depend>\n{needs}</package>\n"
    )
    return folder


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def new(*options):
    return main(["new", "controllers", "--into", "rover_description", *options])


def clean(folder):
    return [str(finding) for finding in lint([folder], package_path=[folder.parent]) if finding.severity != "note"]


FLAVOURS = {
    "gz": ("ament_cmake", "", []),
    "classic": ("catkin", "", []),
    "classic-ros2": ("ament_cmake", "  <exec_depend>gazebo_ros</exec_depend>\n", ["--sim", "classic"]),
}


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_wheels_drive(place, flavour):
    build, needs, options = FLAVOURS[flavour]
    folder = robot(place, ROVER, build, needs)
    before = (folder / "urdf/rover.urdf.xacro").read_text()
    assert new(*options) == 0
    after = (folder / "urdf/rover.urdf.xacro").read_text()
    assert after == before.replace("</robot>", '  <xacro:include filename="control.xacro"/>\n</robot>')
    assert clean(folder) == []
    simulator = Simulator(load(folder / "urdf/rover.urdf.xacro", package_path=[place]), note=lambda _: None)
    reached = []
    for _ in range(2):
        for _ in range(5):
            simulator.command((0.3, 0, 0), (0, 0, 0))
            simulator.run(0.2)
        reached.append(simulator.link_poses()[0, 0])
    assert reached[1] - reached[0] == pytest.approx(0.3, rel=0.01)


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_arms_reach_their_targets(place, flavour):
    build, needs, options = FLAVOURS[flavour]
    folder = robot(place, ARM, build, needs)
    assert new(*options) == 0
    assert clean(folder) == []
    simulator = Simulator(
        load(folder / "urdf/rover.urdf.xacro", package_path=[place]), note=lambda _: None, fixed_base=True
    )
    names = {status.name.rsplit("/", 1)[-1]: status.name for status in simulator.controllers.list()}
    assert {"arm_controller", "gripper_controller"} <= set(names)
    topics = ("/rover/arm_controller/command", "/arm_controller/joint_trajectory")
    topic = next(topic.name for topic in simulator.bus.topics if topic.name in topics)
    point = {"positions": [0.7, -0.5], "time_from_start": {"sec": 1, "nanosec": 0}}
    joints = ["shoulder_joint", "elbow_joint"]
    simulator.bus.publish(topic, TRAJECTORY, from_fields(TRAJECTORY, {"joint_names": joints, "points": [point]}))
    simulator.run(2.0)
    assert [simulator.state.position(joint) for joint in joints] == pytest.approx([0.7, -0.5], abs=1e-2)


def test_two_drivers_on_one_joint_are_never_written(place, capsys):
    for name in ("mybot", "seven_dof_arm", "rrbot", "gem_e2", "simpleton"):
        shutil.copytree(robots_dir() / name, place / name)
        model = place / name / f"{name}_description/urdf/{name}.urdf.xacro"
        before = model.read_bytes()
        assert main(["new", "controllers", "--into", str(model)]) == 2
        reported = capsys.readouterr().err
        assert "is already driven by" in reported
        assert "no joint without a controller; nothing was changed" in reported
        assert model.read_bytes() == before


def test_what_is_driven_stays_and_the_rest_is_added(place, capsys):
    drive = """
  <gazebo><plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
    <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
    <wheel_separation>0.32</wheel_separation><wheel_radius>0.08</wheel_radius>
  </plugin></gazebo>"""
    folder = robot(place, ROVER + ARM + drive)
    assert new() == 0
    reported = capsys.readouterr().err
    assert "`left_joint` is already driven by plugin `gz::sim::systems::DiffDrive`" in reported
    assert "`other_joint` mimics `finger_joint`" in reported
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())
    assert set(settings) == {"controller_manager", "arm_controller", "gripper_controller"}
    assert settings["arm_controller"]["ros__parameters"]["joints"] == ["shoulder_joint", "elbow_joint"]
    assert settings["gripper_controller"]["ros__parameters"]["joints"] == ["finger_joint"]
    assert clean(folder) == []
    assert new("--name", "another_control") == 2  # everything is driven now


def test_wheels_that_are_no_pair_are_told_of(place):
    odd = ROVER + WHEEL.format(name="third", x=0.2, y=0, r=0.08)
    crooked = ROVER.replace('xyz="0 -0.16 0"', 'xyz="0.02 -0.16 0"')
    unequal = WHEEL.format(name="left", x=0, y=0.16, r=0.08) + WHEEL.format(name="right", x=0, y=-0.16, r=0.07)
    for number, body in enumerate((odd, crooked, unequal)):
        folder = robot(place / str(number), body)
        found = roles(load(folder / "urdf/rover.urdf.xacro"))
        assert found.wheels is None
        assert found.arms == ()
        assert any("has the shape of a wheel, but no mirrored counterpart" in note for note in found.notes)


def test_sizes_are_the_models(place):
    front = (WHEEL.format(name=f"front_{side}", x=0.2, y=y, r=0.08) for side, y in (("left", 0.16), ("right", -0.16)))
    four = "".join(front) + ROVER
    found = roles(load(robot(place, four + WHEEL.format(name="caster", x=-0.2, y=0, r=0.05)) / "urdf/rover.urdf.xacro"))
    assert found.wheels is not None
    assert (found.wheels.left, found.wheels.right) == (
        ("left_joint", "front_left_joint"),
        ("right_joint", "front_right_joint"),
    )
    assert (found.wheels.separation, found.wheels.radius) == (0.32, 0.08)
    assert "`caster_joint` turns freely because it belongs to a caster" in found.notes


def test_chains_are_called_by_what_their_joints_have_in_common():
    chains = (
        ("front_left_hip", "front_left_knee"),
        ("shoulder_joint", "elbow_joint"),
        ("joint_1", "joint_2"),
        ("pan",),
    )
    made = controllers(Roles(None, chains, (), ()))
    assert [each.name for each in made] == [
        "front_left_controller",
        "arm_controller",
        "arm_2_controller",
        "pan_controller",
    ]


def test_diff_changes_nothing(place, capsys):
    folder = robot(place, ROVER)
    before = {path: path.read_bytes() for path in place.rglob("*") if path.is_file()}
    assert new("--diff") == 0
    reported = capsys.readouterr().out
    assert "+  base_controller" in reported or "+base_controller:" in reported
    assert {path: path.read_bytes() for path in place.rglob("*") if path.is_file()} == before
    assert folder.is_dir()


def test_nothing_is_overwritten(place, capsys):
    folder = robot(place, ROVER)
    (place / "rover_control").mkdir()
    assert new() == 2
    assert "rover_control already exists; choose another --name" in capsys.readouterr().err
    (place / "rover_control").rmdir()
    (folder / "urdf/control.xacro").write_text("<robot/>")
    assert new() == 2
    assert "control.xacro already exists" in capsys.readouterr().err
    assert not (place / "rover_control").exists()


@pytest.mark.catkin
def test_the_package_builds(place, debian):
    robot(place / "src", ROVER + ARM, "catkin")
    (place / "src/rover_description/CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.0.2)\nproject(rover_description)\n\nfind_package(catkin REQUIRED)\n"
        "catkin_package()\n"
    )
    assert main(["new", "controllers", "--into", "src/rover_description"]) == 0
    assert "found 0 problems" in debian("catkin_lint -W2 --strict --offline src/rover_control")
    debian("catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    assert (place / "install/share/rover_control/config/controllers.yaml").is_file()


def transmissions(kind, joints, plugin=""):
    """Return the hardware of ROS 1 without a controller, as many a description has it."""
    each = "".join(
        f'<transmission name="{joint}_t"><type>transmission_interface/SimpleTransmission</type><joint name="{joint}">'
        f"<hardwareInterface>hardware_interface/{kind}JointInterface</hardwareInterface></joint>"
        f'<actuator name="{joint}_m"/></transmission>\n'
        for joint in joints
    )
    loop = '<gazebo><plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">{}</plugin></gazebo>'
    return each + (loop.format(plugin) if plugin is not None else "")


def ros2_control(kind, joints, more=""):
    """Return the hardware of ROS 2 without a controller."""
    each = "".join(
        f'<joint name="{joint}"><command_interface name="{kind}"/><state_interface name="position"/>'
        '<state_interface name="velocity"/></joint>'
        for joint in joints
    )
    hardware = "<hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>"
    return f'<ros2_control name="hand_made" type="system">{hardware}{each}</ros2_control>{more}'


CHAIN = part("shoulder", "base", z=0.05, axis="0 0 1") + part("elbow", "shoulder")


def follows(model, place, **options):
    """Whether the arm goes where it is told, within 1e-2 rad."""
    simulator = Simulator(load(model, package_path=[place]), note=lambda _: None, fixed_base=True)
    topic = next(topic.name for topic in simulator.bus.topics if topic.name.endswith(tuple(options["topics"])))
    point = {"positions": [0.7, -0.5], "time_from_start": {"sec": 1, "nanosec": 0}}
    joints = ["shoulder_joint", "elbow_joint"]
    simulator.bus.publish(topic, TRAJECTORY, from_fields(TRAJECTORY, {"joint_names": joints, "points": [point]}))
    simulator.run(3.0)
    return [simulator.state.position(joint) for joint in joints] == pytest.approx([0.7, -0.5], abs=1e-2)


@pytest.mark.parametrize("kind", ["Position", "Velocity", "Effort"])
def test_transmissions_without_controllers_get_some(place, kind):
    body = CHAIN + transmissions(
        kind, ["shoulder_joint", "elbow_joint"], "<robotNamespace>/cell/rover</robotNamespace>"
    )
    folder = robot(place, body, "catkin")
    before = (folder / "urdf/rover.urdf.xacro").read_bytes()
    assert new() == 0
    assert (folder / "urdf/rover.urdf.xacro").read_bytes() == before  # it has what it needs
    (settings,) = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text()).values()
    assert settings["arm_controller"]["type"] == f"{kind.lower()}_controllers/JointTrajectoryController"
    assert ("gains" in settings["arm_controller"]) == (kind != "Position")
    assert f"<exec_depend>{kind.lower()}_controllers</exec_depend>" in (place / "rover_control/package.xml").read_text()
    assert 'ns="cell/rover"' in (place / "rover_control/launch/rover_control.launch").read_text()
    assert clean(folder) == []
    assert follows(folder / "urdf/rover.urdf.xacro", place, topics=["/cell/rover/arm_controller/command"])
    assert new("--name", "more_control") == 2  # they have a controller now


def test_transmissions_without_the_plugin_get_it(place):
    folder = robot(place, CHAIN + transmissions("Effort", ["shoulder_joint", "elbow_joint"], None), "catkin")
    assert new() == 0
    added = (folder / "urdf/control.xacro").read_text()
    assert "libgazebo_ros_control.so" in added
    assert "<transmission" not in added
    assert follows(folder / "urdf/rover.urdf.xacro", place, topics=["/rover/arm_controller/command"])


def test_a_plugin_without_a_namespace_has_the_controllers_at_the_root(place):
    plugin = "<robotNamespace>/</robotNamespace>"
    folder = robot(place, CHAIN + transmissions("Position", ["shoulder_joint", "elbow_joint"], plugin), "catkin")
    assert new() == 0
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())
    assert set(settings) == {"joint_state_controller", "arm_controller"}
    assert "ns=" not in (place / "rover_control/launch/rover_control.launch").read_text()
    assert follows(folder / "urdf/rover.urdf.xacro", place, topics=["/arm_controller/command"])


@pytest.mark.parametrize("kind", ["position", "velocity", "effort"])
def test_ros2_control_without_a_plugin_gets_controllers_and_the_plugin(place, kind):
    folder = robot(place, CHAIN + ros2_control(kind, ["shoulder_joint", "elbow_joint"]))
    assert new() == 0
    added = (folder / "urdf/control.xacro").read_text()
    assert "gz_ros2_control-system" in added
    assert "<ros2_control" not in added
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())
    assert settings["arm_controller"]["ros__parameters"]["command_interfaces"] == [kind]
    assert clean(folder) == []
    assert follows(folder / "urdf/rover.urdf.xacro", place, topics=["/arm_controller/joint_trajectory"])


def test_what_the_plugin_reads_gets_the_controllers(place, capsys):
    plugin = (
        '<gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">'
        "<parameters>$(find rover_description)/config/mine.yaml</parameters></plugin></gazebo>"
    )
    folder = robot(place, ROVER + CHAIN + ros2_control("velocity", ["left_joint", "right_joint"], plugin))
    (folder / "config").mkdir()
    mine = "# mine\ncontroller_manager:\n    ros__parameters:\n        update_rate: 100\n"
    (folder / "config/mine.yaml").write_text(mine)
    before = (folder / "urdf/rover.urdf.xacro").read_text()
    assert new() == 0
    reported = capsys.readouterr()
    assert "ros2 run controller_manager spawner base_controller arm_controller" in reported.out
    assert "controller `base_controller` for left_joint, right_joint (velocity, as in the model)" in reported.err
    after = (folder / "config/mine.yaml").read_text()
    assert all(line in after for line in mine.splitlines())
    settings = yaml.safe_load(after)
    assert set(settings) == {"controller_manager", "base_controller", "arm_controller"}
    managed = settings["controller_manager"]["ros__parameters"]
    assert managed["base_controller"] == {"type": "diff_drive_controller/DiffDriveController"}
    assert managed["update_rate"] == 100
    assert not (place / "rover_control").exists()
    added = (folder / "urdf/control.xacro").read_text()  # the arm had no hardware
    assert "shoulder_joint" in added
    assert "left_joint" not in added
    assert "<plugin filename=" not in added
    assert (folder / "urdf/rover.urdf.xacro").read_text() != before
    assert clean(folder) == []
    assert follows(folder / "urdf/rover.urdf.xacro", place, topics=["/arm_controller/joint_trajectory"])


def test_a_plugin_whose_file_is_not_there_is_told_of(place, capsys):
    plugin = (
        '<gazebo><plugin filename="gz_ros2_control-system" name="loop">'
        "<parameters>$(find rover_description)/config/none.yaml</parameters></plugin></gazebo>"
    )
    robot(place, CHAIN + ros2_control("position", ["shoulder_joint", "elbow_joint"], plugin))
    assert new() == 2
    reported = capsys.readouterr().err
    assert "plugin `loop` names " in reported
    assert "config/none.yaml, which does not exist" in reported


def test_controllers_of_another_robot_are_none_of_ours(place):
    robot(place, CHAIN, "catkin")
    assert new() == 0
    (place / "rover_description").rename(place / "other_description")
    (place / "rover_control").rename(place / "other_control")
    folder = robot(place, CHAIN + transmissions("Effort", ["shoulder_joint", "elbow_joint"]), "catkin")
    assert new() == 0
    assert (place / "rover_control/config/controllers.yaml").is_file()
    assert clean(folder) == []


def test_wheels_that_are_told_efforts_are_no_drive(place, capsys):
    robot(place, ROVER + CHAIN + transmissions("Effort", ["left_joint", "right_joint"], "<a/>"), "catkin")
    assert new() == 0
    assert "`left_joint` has the command interface effort; wheels need velocity" in capsys.readouterr().err
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())["rover"]
    assert set(settings) == {"joint_state_controller", "arm_controller"}


def test_followers_and_what_a_mixed_chain_can_be_told(place):
    mixed = transmissions("Position", ["shoulder_joint"]) + transmissions(
        "Effort", ["elbow_joint", "other_joint"], None
    )
    folder = robot(place, ARM + mixed, "catkin")
    assert new() == 0
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())["rover"]
    told = {name: (each["type"], each["joints"]) for name, each in settings.items() if "joints" in each}
    assert told == {
        "shoulder_controller": ("position_controllers/JointTrajectoryController", ["shoulder_joint"]),
        "elbow_controller": ("effort_controllers/JointTrajectoryController", ["elbow_joint"]),
        "gripper_controller": ("velocity_controllers/JointTrajectoryController", ["finger_joint"]),
        "gripper_effort_controller": ("effort_controllers/JointTrajectoryController", ["other_joint"]),
    }
    assert (folder / "urdf/control.xacro").read_text().count("<transmission ") == 1


def test_gazebo_classic_passes_over_followers_so_they_are_told_too(place, capsys):
    mirrored = ARM.replace(
        '<mimic joint="finger_joint"/>', '<mimic joint="finger_joint" multiplier="-1" offset="1.5"/>'
    )
    bent = part("wrist", "elbow", more='<mimic joint="shoulder_joint"/>').replace("0 0 0.1", "0.04 0 0.1")
    folder = robot(place, mirrored + bent, "catkin")
    assert new() == 0
    reported = capsys.readouterr().err
    assert "`other_joint` is -1 × `finger_joint` +1.5, but Gazebo Classic ignores <mimic>" in reported
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())["rover"]
    assert settings["gripper_controller"]["joints"] == ["finger_joint", "other_joint"]
    assert settings["arm_controller"]["joints"] == ["shoulder_joint", "wrist_joint", "elbow_joint"]
    assert (folder / "urdf/control.xacro").read_text().count("<transmission ") == 5
    assert clean(folder) == []


@pytest.mark.parametrize(("world", "told"), [("ignition-gazebo-", True), ("", False)])
def test_in_ros2_followers_are_listed_or_they_do_not_follow(place, world, told):
    folder = robot(place, f"{ARM}<!-- {world} -->")
    assert new() == 0
    block = ElementTree.parse(folder / "urdf/control.xacro").find("ros2_control")
    joints = {joint.get("name"): joint for joint in block.findall("joint")}
    follower = joints["other_joint"]
    assert follower.findall("command_interface") == []
    assert [each.get("name") for each in follower.findall("state_interface")] == ["position", "velocity"]
    # Until humble the plugin takes it from there, since jazzy from <mimic>.
    params = {each.get("name"): each.text for each in follower.findall("param")}
    assert params == ({"mimic": "finger_joint", "multiplier": "1"} if told else {})


@pytest.mark.parametrize("more", [[], [None]])
def test_transmissions_are_nothing_to_ros2(place, capsys, more):
    folder = robot(place, CHAIN + transmissions("Effort", ["shoulder_joint", "elbow_joint"], *more))
    assert new("--sim", "gz") == 0
    assert "controller `arm_controller` for shoulder_joint, elbow_joint\n" in capsys.readouterr().err
    written = (folder / "urdf/control.xacro").read_text()
    assert '<joint name="elbow_joint">' in written
    assert "gz_ros2_control-system" in written
    settings = yaml.safe_load((place / "rover_control/config/controllers.yaml").read_text())
    assert settings["arm_controller"]["ros__parameters"]["command_interfaces"] == ["position"]


def test_a_joint_that_nothing_can_move_is_reported_with_its_place(place, capsys):
    folder = robot(place, ARM.replace('effort="30"', 'effort="0"', 1))
    assert new() == 0
    lines = (folder / "urdf/rover.urdf.xacro").read_text().splitlines()
    number = next(number for number, line in enumerate(lines, 1) if 'effort="0"' in line)
    reported = f"rover.urdf.xacro:{number}:5: `shoulder_joint` has the limit effort 0: its controller cannot move it\n"
    assert reported in capsys.readouterr().err


def test_gains_of_a_joint_carry_its_weight(place):
    body = part("shoulder", "base", z=0.05) + part("elbow", "shoulder") + part("finger", "elbow", type="prismatic")
    loaded = load(robot(place, body) / "urdf/rover.urdf.xacro")
    upper, lower, slide = (
        gains(loaded, loaded.joint_by_name[f"{name}_joint"]) for name in ("shoulder", "elbow", "finger")
    )
    weight, inertia = 0.3 * 9.81 * (0.2 + 0.4), 3 * 0.002 + 0.3 * (0.2**2 + 0.4**2)
    assert (upper.clamp, upper.p) == (pytest.approx(weight), pytest.approx(weight / 0.01))
    assert upper.d == pytest.approx(1.8 * (upper.p * inertia) ** 0.5)
    assert lower.p == pytest.approx(0.3 * 9.81 * 0.2 / 0.01)
    assert (slide.clamp, slide.p) == (pytest.approx(0.3 * 9.81), pytest.approx(0.3 * 9.81 / 0.001))


def test_a_file_in_no_package_gets_its_controllers_beside_it(place, monkeypatch, capsys):
    folder = robot(place, part("shoulder", "base"))
    (place / "loose").mkdir()
    file = next(folder.rglob("*.xacro")).rename(place / "loose/rover.urdf.xacro")
    shutil.rmtree(folder)
    before = set(place.iterdir())
    monkeypatch.chdir(place / "loose")
    assert main(["new", "controllers", "--into", file.name, "-q"]) == 0
    assert set(place.iterdir()) == before
    assert sorted(path.name for path in (place / "loose").iterdir()) == [
        "control.xacro", "rover.urdf.xacro", "rover_control"
    ]  # fmt: skip
    assert clean(place / "loose") == []
    states = Simulator(load(file), note=lambda _: None).controllers.list()
    assert [state.name for state in states if "trajectory" in state.type.lower()]


@pytest.mark.slow
def test_a_robot_without_ros_gets_what_needs_none(place, capsys, tell):
    assert main(["new", "robot", "ab", "--ros", "none", "--yes", "-q"]) == 0
    assert main(["new", "arm", "--into", "ab_description", "--dof", "4", "--gripper", "-q"]) == 0
    before = set(place.rglob("*"))
    assert main(["new", "controllers", "--into", "ab_description", "--name", "x"]) == 2
    assert "--name is for a ROS package, and this robot has none" in capsys.readouterr().err
    assert main(["new", "controllers", "--into", "ab_description"]) == 0
    reported = capsys.readouterr()
    assert "elbow_joint: topic arm/elbow" in reported.err
    assert "ros2" not in reported.out
    assert {path.name for path in set(place.rglob("*")) - before} == {"control.xacro"}
    assert clean(place / "ab_description") == []
    simulator = Simulator(load(place / "ab_description/urdf/ab.urdf.xacro"), note=lambda _: None)
    targets = {"shoulder_pan_joint": 0.4, "shoulder_lift_joint": 0.3, "elbow_joint": -0.3, "wrist_pitch_joint": 0.2}
    tell(simulator, "none", targets | {"left_finger_joint": 0.01}, 1)
    simulator.run(3.0)
    for joint, target in targets.items():
        assert simulator.state.position(joint) == pytest.approx(target, abs=1e-2), joint
    for finger in ("left_finger_joint", "right_finger_joint"):
        assert simulator.state.position(finger) == pytest.approx(0.01, abs=2e-4)
    assert main(["new", "controllers", "--into", "ab_description"]) == 2
    assert "no joint without a controller" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ros", "launch"), [("jazzy", "ab_bringup/launch/ab.launch.py"), ("noetic", "ab_bringup/launch/ab.launch")]
)
def test_what_starts_all_of_a_robot_can_be_told_of_them(place, capsys, ros, launch):
    assert main(["new", "robot", "ab", "--ros", ros, "--yes", "-q"]) == 0
    assert main(["new", "arm", "--into", "ab_description", "-q"]) == 0
    capsys.readouterr()
    assert main(["new", "controllers", "--into", "ab_description"]) == 0
    _, add = capsys.readouterr().out.split(f"to start the controllers with the robot, add to {launch}:\n")
    lines, depends = add.split("and to ab_bringup/package.xml:\n")
    assert depends == "  <exec_depend>ab_control</exec_depend>\n"
    before = (place / launch).read_text()
    if ros == "noetic":
        ElementTree.fromstring(before.replace("</launch>", f"{lines}</launch>"))
    else:
        end = "\n    ])"
        assert before.count(end) == 1
        compile(before.replace(end, f"\n{lines}{end}"), launch, "exec")
        for name in set(re.findall(r"\b[A-Z]\w+", lines)):
            assert re.search(rf"import .*\b{name}\b", before), name
