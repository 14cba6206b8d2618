"""The differential drive in three spellings: laws, defaults, topics, odometry, errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib import import_module
from inspect import isabstract
from pathlib import Path
from pkgutil import walk_packages
from types import SimpleNamespace
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import BOOL, ODOMETRY, TF, from_fields, twist
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.base import Controller, Drive, Sensor

Make = Callable[..., Any]
ENCODER = {"ros1": "<odometrySource>encoder</odometrySource>", "ros2": "<odometry_source>0</odometry_source>", "gz": ""}
PUBLISH = {"ros1": "", "ros2": "<publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf>", "gz": ""}
GENERATIONS = ("ros1", "ros2", "gz")


@pytest.mark.parametrize(
    ("package_name", "base"), [("drives", Drive), ("sensors", Sensor), ("controllers", Controller)]
)
def test_every_class_of_a_package_is_in_its_tuple(package_name: str, base: type) -> None:
    package = import_module(f"urdfkit.sim.plugins.{package_name}")
    found = set()
    for module in walk_packages(package.__path__, f"{package.__name__}."):
        for value in vars(import_module(module.name)).values():
            if isinstance(value, type) and issubclass(value, base) and value is not base and not isabstract(value):
                found.add(value)
    assert found == set(getattr(package, package_name.upper()))


@pytest.mark.parametrize("generation", GENERATIONS)
def test_wheels_turn_at_v_plus_minus_w_times_half_the_separation(make: Make, generation: str) -> None:
    simulator = make(generation, fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((0.5, 0, 0), (0, 0, 1.0))
    simulator.run(0.5)
    assert simulator.state.velocity("left_joint") == pytest.approx((0.5 - 0.15) / 0.1)
    assert simulator.state.velocity("right_joint") == pytest.approx((0.5 + 0.15) / 0.1)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_a_command_holds_until_the_next_one(make: Make, generation: str) -> None:
    simulator = make(generation)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(5.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.3)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_encoders_see_what_the_wheels_roll(make: Make, generation: str) -> None:
    simulator = make(generation, ENCODER[generation], spawn=Spawn(x=3.0, y=1.0, yaw=1.0))
    for part in range(1, 11):  # gently, so that the tyres do not slip
        simulator.command((0.05 * part, 0, 0), (0, 0, 0.05 * part))
        simulator.run(0.1 if part < 10 else 9.1)
    pose = simulator.state.base_pose
    (position, quaternion) = next(iter(simulator.odometry().values()))
    dx, dy = pose[0] - 3.0, pose[1] - 1.0
    assert position[0] == pytest.approx(dx * math.cos(1.0) + dy * math.sin(1.0), abs=5e-3)
    assert position[1] == pytest.approx(dy * math.cos(1.0) - dx * math.sin(1.0), abs=5e-3)
    turned = 2 * math.atan2(pose[5], pose[6]) - 1.0
    assert math.remainder(2 * math.atan2(quaternion[2], quaternion[3]) - turned, 2 * math.pi) == pytest.approx(
        0, abs=5e-3
    )


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_world_odometry_is_the_true_pose_in_the_world(make: Make, generation: str) -> None:
    simulator = make(generation, PUBLISH[generation], spawn=Spawn(x=3.0, yaw=math.pi / 2))
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    topic = "/rover/odom" if generation == "ros1" else "/odom"
    message = simulator.bus.latest(topic)
    at = message.pose.pose.position
    assert (at.x, at.y, at.z) == simulator.state.base_pose[:3]
    assert (at.x, at.y) == pytest.approx((3.0, 0.5), abs=0.05)
    assert message.twist.twist.linear.x == pytest.approx(0.5)
    assert message.twist.twist.linear.y == pytest.approx(0.0, abs=1e-9)


def test_driving_backwards_is_reported_as_each_generation_does(make: Make) -> None:
    reported = {}
    for generation, topic in (("ros1", "/rover/odom"), ("ros2", "/odom"), ("gz", "/model/rover/odometry")):
        simulator = make(generation, ENCODER[generation] + PUBLISH[generation])
        simulator.command((-0.3, 0, 0), (0, 0, 0))
        simulator.run(1.0)
        message = simulator.bus.latest(topic)
        reported[generation] = message.twist.twist.linear.x
        assert message.pose.pose.position.x < -0.2
    assert reported == pytest.approx({"ros1": 0.3, "ros2": 0.3, "gz": -0.3})


@pytest.mark.parametrize(
    ("generation", "parameters", "command", "odometry"),
    [
        ("ros1", "", "/rover/cmd_vel", "/rover/odom"),
        ("ros1", "<robotNamespace></robotNamespace>", "/rover/cmd_vel", "/rover/odom"),
        ("ros1", "<robotNamespace>/</robotNamespace>", "/cmd_vel", "/odom"),
        ("ros1", "<robotNamespace>/fleet/a</robotNamespace>", "/fleet/a/cmd_vel", "/fleet/a/odom"),
        ("ros1", "<commandTopic>/drive</commandTopic>", "/drive", "/rover/odom"),
        ("ros1", "<commandTopic>rover/cmd_vel</commandTopic>", "/rover/rover/cmd_vel", "/rover/odom"),
        ("ros2", "", "/cmd_vel", "/odom"),
        ("ros2", "<command_topic>drive</command_topic>", "/cmd_vel", "/odom"),
        ("ros2", "<ros><namespace>/r</namespace></ros>", "/r/cmd_vel", "/r/odom"),
        (
            "ros2",
            "<ros><namespace>/r</namespace><remapping>cmd_vel:=drive</remapping><remapping>odom:=/o</remapping></ros>",
            "/r/drive",
            "/o",
        ),
        ("ros2", "<ros><argument>cmd_vel:=drive</argument></ros>", "/drive", "/odom"),
        ("gz", "", "/model/rover/cmd_vel", "/model/rover/odometry"),
        ("gz", "<topic>cmd_vel</topic><odom_topic>odom</odom_topic>", "/cmd_vel", "/odom"),
    ],
)
def test_topics(make: Make, generation: str, parameters: str, command: str, odometry: str) -> None:
    simulator = make(generation, PUBLISH[generation] + parameters)
    assert simulator.command_topics == (command,)
    simulator.run(0.1)
    assert simulator.bus.latest(odometry) is not None


@pytest.mark.parametrize(
    ("generation", "parameters", "frames"),
    [
        ("ros1", "", ("odom", "base_footprint")),
        ("ros2", PUBLISH["ros2"], ("odom", "base_footprint")),
        ("gz", "", ("rover/odom", "rover/base")),
        ("gz", "<frame_id>map</frame_id><child_frame_id>base</child_frame_id>", ("map", "base")),
    ],
)
def test_frames(make: Make, generation: str, parameters: str, frames: tuple[str, str]) -> None:
    simulator = make(generation, parameters)
    topic = "/model/rover/tf" if generation == "gz" else "/tf"
    seen: list[Any] = []
    simulator.subscribe(topic, TF, seen.append)
    simulator.run(0.05)
    links = [(link.header.frame_id, link.child_frame_id) for message in seen for link in message.transforms]
    assert frames in links


@pytest.mark.parametrize(
    ("generation", "parameters", "message", "with_tf"),
    [
        ("ros1", "", 100, 100),
        ("ros1", "<publishTf>false</publishTf>", 0, 0),
        ("ros1", "<publishOdomTF>0</publishOdomTF>", 100, 0),
        ("ros1", "<updateRate>20</updateRate>", 20, 20),
        ("ros2", "", 0, 0),
        ("ros2", "<publish_odom>1</publish_odom>", 100, 0),
        ("ros2", "<publish_odom_tf>true</publish_odom_tf>", 0, 100),
        ("gz", "", 50, 50),
        ("gz", "<odom_publish_frequency>0</odom_publish_frequency>", 1000, 1000),
    ],
)
def test_what_is_published_how_often(make: Make, generation: str, parameters: str, message: int, with_tf: int) -> None:
    simulator = make(generation, parameters)
    simulator.run(1.0)
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    odometry = {"ros1": "/rover/odom", "ros2": "/odom", "gz": "/model/rover/odometry"}[generation]
    assert counts.get(odometry, 0) == message
    links = 0 if generation == "gz" else 50
    assert counts["/model/rover/tf" if generation == "gz" else "/tf"] == with_tf + links


def test_covariance(make: Make) -> None:
    simulator = make("ros1")
    simulator.run(0.1)
    matrix = simulator.bus.latest("/rover/odom").pose.covariance
    assert [matrix[i] for i in (0, 7, 14, 21, 28, 35)] == [1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3]
    assert matrix.sum() == pytest.approx(3e12 + 1.02e-3)
    assert not simulator.bus.latest("/rover/odom").twist.covariance.any()
    simulator = make("ros2", PUBLISH["ros2"] + "<covariance_x>0.25</covariance_x>")
    simulator.run(0.1)
    for part in (simulator.bus.latest("/odom").pose, simulator.bus.latest("/odom").twist):
        assert part.covariance[::7].tolist() == [0.25, 1e-5, 1e12, 1e12, 1e12, 1e-3]


def test_wheel_states_and_wheel_transforms(make: Make) -> None:
    on = "<publishWheelTF>true</publishWheelTF><publishWheelJointState>true</publishWheelJointState>"
    simulator = make("ros1", on)
    simulator.command((0.3, 0, 0), (0, 0, 0.2))
    simulator.run(0.5)
    states = simulator.bus.latest("/rover/joint_states")
    assert states.name == ["left_joint", "right_joint"]
    assert list(states.position) == [simulator.state.position(name) for name in states.name]
    assert len(states.velocity) == 0
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.run(0.01)
    pairs = [(link.header.frame_id, link.child_frame_id) for message in seen for link in message.transforms]
    assert ("base", "left_wheel") in pairs
    assert ("base", "right_wheel") in pairs


def test_acceleration_is_limited(make: Make) -> None:
    simulator = make("ros1", "<wheelAcceleration>0.5</wheelAcceleration>", fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.velocity("left_joint") * 0.1 == pytest.approx(0.5, abs=0.01)
    simulator.run(1.5)
    assert simulator.state.velocity("left_joint") * 0.1 == pytest.approx(1.0, abs=0.011)


@pytest.mark.parametrize(("generation", "jumps"), [("ros1", True), ("ros2", False)])
def test_one_wheel_close_to_its_target_frees_both_in_ros_1_only(make: Make, generation: str, jumps: bool) -> None:
    tag = {"ros1": "wheelAcceleration", "ros2": "max_wheel_acceleration"}[generation]
    simulator = make(generation, f"<{tag}>0.5</{tag}>", fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((0.3, 0, 0), (0, 0, 2.0))  # the left wheel stands, the right one has to do 0.6 m/s
    simulator.run(0.1)
    right = simulator.state.velocity("right_joint") * 0.1
    assert right == pytest.approx(0.6 if jumps else 0.05, abs=0.011)


def test_torque_limit(make: Make) -> None:
    weak, strong = (make("ros1", f"<wheelTorque>{torque}</wheelTorque>") for torque in (0.01, 5))
    for simulator in (weak, strong):
        simulator.command((1.0, 0, 0), (0, 0, 0))
        simulator.run(0.5)
    # 2 · 0.01 N·m / 0.1 m on 1.4 kg and the wheels' rotation, m + 2·I/r² = 1.6 kg
    assert weak.state.base_velocity[0] == pytest.approx(0.2 / 1.6 * 0.5, rel=0.02)
    assert strong.state.base_velocity[0] == pytest.approx(1.0, abs=0.05)


def test_limits_of_gz_sim(make: Make) -> None:
    limits = "<max_linear_acceleration>0.5</max_linear_acceleration><max_velocity>0.4</max_velocity>"
    simulator = make("gz", limits, fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(0.4)
    assert simulator.state.velocity("left_joint") * 0.1 == pytest.approx(0.2, abs=1e-3)
    simulator.run(1.0)
    assert simulator.state.velocity("left_joint") * 0.1 == pytest.approx(0.4)


def test_gz_sim_can_be_disabled(make: Make) -> None:
    simulator = make("gz")
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(0.5)
    simulator.bus.publish("/model/rover/enable", BOOL, from_fields(BOOL, {"data": False}))
    simulator.run(1.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.0, abs=1e-9)
    simulator.bus.publish("/model/rover/enable", BOOL, from_fields(BOOL, {"data": True}))
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(0.5)
    assert simulator.state.base_velocity[0] == pytest.approx(0.3)


@pytest.mark.parametrize("bad", [(math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0), (0.0, -math.inf), (1e308, 0.0)])
@pytest.mark.parametrize("generation", GENERATIONS)
def test_commands_that_are_not_finite_are_dropped_with_one_warning(
    make: Make, generation: str, bad: tuple[float, float]
) -> None:
    notes: list[str] = []
    simulator = make(generation, note=notes.append)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    for _ in range(3):
        simulator.command((bad[0], 0, 0), (0, 0, bad[1]))
        simulator.run(0.5)
    assert simulator.state.base_velocity[0] == pytest.approx(0.3)
    assert len(notes) == 1
    assert "is not finite" in notes[0]


def test_several_pairs_and_several_drives(write_rover: Callable[..., Path]) -> None:
    from urdfkit.sim import Simulator as Sim

    path = write_rover(
        """<gazebo><plugin name="a" filename="libgazebo_ros_diff_drive.so"><ros><namespace>a</namespace></ros>
        <num_wheel_pairs>2</num_wheel_pairs><left_joint>left_joint</left_joint><left_joint>left_joint</left_joint>
        <right_joint>right_joint</right_joint><right_joint>right_joint</right_joint>
        <wheel_separation>0.3</wheel_separation><wheel_separation>0.3</wheel_separation>
        <wheel_diameter>0.2</wheel_diameter><wheel_diameter>0.2</wheel_diameter></plugin>
        <plugin name="b" filename="libgazebo_ros_diff_drive.so"><ros><namespace>b</namespace></ros>
        <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint></plugin></gazebo>"""
    )
    assert Sim(path).command_topics == ("/a/cmd_vel", "/b/cmd_vel")


@pytest.mark.parametrize(
    ("extra", "said"),
    [
        ("<leftJoint>left_joit</leftJoint>", "no joint `left_joit` in robot `rover`; did you mean `left_joint`?"),
        ("<leftJoint>ball_joint</leftJoint>", "joint `ball_joint` is fixed: it cannot be driven"),
        ("<wheelSeparation>wide</wheelSeparation>", "<wheelSeparation> is `wide`; it must be a number greater than"),
        ("<wheelSeparation>0</wheelSeparation>", "<wheelSeparation> is `0`; it must be a number greater than zero"),
        ("<wheelTorque>nan</wheelTorque>", "<wheelTorque> is `nan`; it must be a number, zero or greater"),
        ("<wheelTorque>-5</wheelTorque>", "<wheelTorque> is `-5`; it must be a number, zero or greater"),
        ("<wheelAcceleration>-1</wheelAcceleration>", "<wheelAcceleration> is `-1`; it must be a number, zero or"),
        ("<publishTf>maybe</publishTf>", "<publishTf> is `maybe`; it must be true or false"),
        ("<odometrySource>gps</odometrySource>", "<odometrySource> is `gps`; it must be `encoder` or `world`"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(write_rover: Callable[..., Path], extra: str, said: str) -> None:
    # The first of two tags counts, so what is wrong comes first.
    head = f'<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so">\n{extra}\n'
    rest = "<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint></plugin></gazebo>"
    path = write_rover(head + rest)
    with pytest.raises(SimulationError) as caught:
        Simulator(path, strict=True)
    line = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if text == extra)
    assert said in str(caught.value)
    assert f"rover.urdf:{line}:1: " in str(caught.value)


@pytest.mark.parametrize(
    ("distro", "written", "swapped"),
    [
        ("hydro", "", True),
        ("indigo", "<legacyMode>false</legacyMode>", True),
        ("kinetic", "", True),
        ("kinetic", "<legacyMode>false</legacyMode>", False),
        ("lunar", "<legacyMode>true</legacyMode>", True),
        ("melodic", "<legacyMode>true</legacyMode>", False),
        ("noetic", "", False),
        ("humble", "", False),
        (None, "<legacyMode>true</legacyMode>", False),
    ],
)
def test_sides_are_swapped_until_lunar(make: Make, distro: str | None, written: str, swapped: bool) -> None:
    simulator = make("ros1", ENCODER["ros1"] + written, ros_distro=distro, note=lambda text: None)
    simulator.command((0, 0, 0), (0, 0, 1.0))
    simulator.run(0.5)
    sign = -1 if swapped else 1
    assert simulator.state.velocity("right_joint") == pytest.approx(sign * 1.5)
    assert simulator.state.base_velocity[5] == pytest.approx(sign * 1.0, abs=0.02)
    # Its odometry takes the wheels for swapped as well, and so believes to turn as it was told.
    (_, quaternion) = simulator.odometry()["odom"]
    assert quaternion[2] > 0.2


def test_ros_2_never_swapped_sides(make: Make) -> None:
    simulator = make("ros2", ros_distro="kinetic")
    simulator.command((0, 0, 0), (0, 0, 1.0))
    simulator.run(0.1)
    assert simulator.state.velocity("right_joint") == pytest.approx(1.5)


def test_models_that_rely_on_legacy_mode_are_reported(make: Make, write_rover: Callable[..., Path]) -> None:
    def notes(path: Path, distro: str | None) -> list[str]:
        found: list[str] = []
        Simulator(path, ros_distro=distro, note=found.append)
        return found

    def rover(left: str, extra: str = "") -> Path:
        right = "right" if left == "left" else "left"
        return write_rover(
            f"""<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so"><leftJoint>{left}_joint</leftJoint>
            <rightJoint>{right}_joint</rightJoint>{extra}</plugin></gazebo>"""
        )

    assert notes(rover("left"), None) == notes(rover("left", "<legacyMode>false</legacyMode>"), None) == []
    (written,) = notes(rover("left", "<legacyMode>true</legacyMode>"), None)
    assert "up to ROS Lunar, is ignored: the sides are not swapped; --ros-distro kinetic" in written
    (crossed,) = notes(rover("right"), None)
    assert "joint `right_joint` turns the robot like a right wheel" in crossed
    assert notes(rover("right"), "indigo") == notes(rover("right"), "noetic") == []


@pytest.mark.parametrize(("distro", "published"), [("indigo", True), ("kinetic", False), (None, False)])
def test_the_odometry_transform_can_be_turned_off_since_kinetic(
    make: Make, distro: str | None, published: bool
) -> None:
    simulator = make("ros1", "<publishOdomTF>false</publishOdomTF>", ros_distro=distro)
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.run(0.1)
    frames = {link.child_frame_id for message in seen for link in message.transforms}
    assert ("base_footprint" in frames) is published


def test_joints_that_do_not_pair_up(write_rover: Callable[..., Path]) -> None:
    lonely = '<plugin name="d" filename="gz-sim-diff-drive-system"><left_joint>left_joint</left_joint></plugin>'
    path = write_rover(f"<gazebo>{lonely}</gazebo>")
    with pytest.raises(
        SimulationError,
        match="1 <left_joint> and 0 <right_joint>; this drive needs equal numbers of both, at least one of each",
    ):
        Simulator(path, strict=True)


def test_a_drive_from_another_package(write_rover: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    from urdfkit import entry_points
    from urdfkit.description.plugins import Parameter, PluginSpec

    made: list[Any] = []

    class Spinner(Drive):
        kind = "spinner"
        specs = (PluginSpec("spinner", "ros1", ("spinner",), (), (Parameter("rate", "rate", "2"),), "here"),)

        def configure(self, setup: Any) -> None:
            made.append(setup)

        def write(self, state: Any, motors: Any) -> None:
            motors.drive("left_joint", 2.0, 5.0)

        def read(self, state: Any) -> None: ...

        def reset(self) -> None: ...

    monkeypatch.setattr(entry_points, "load", lambda group: [Spinner] if group == "urdfkit.drives" else [])
    path = write_rover('<gazebo><plugin name="s" filename="libspinner.so"/></gazebo>')
    simulator = Simulator(path, fixed_base=True, spawn=Spawn(z=1.0))
    simulator.run(0.1)
    assert simulator.state.velocity("left_joint") == pytest.approx(2.0)
    assert made[0].model == "rover"


@pytest.mark.parametrize(
    ("filename", "parameters", "topic", "joints", "count"),
    [
        (
            "libgazebo_ros_joint_state_publisher.so",
            "<jointName>left_joint, right_joint</jointName>",
            "/rover/joint_states",
            ["left_joint", "right_joint"],
            100,
        ),
        (
            "libgazebo_ros_joint_state_publisher.so",
            "<joint_name>left_joint</joint_name><update_rate>20</update_rate><ros><namespace>/r</namespace></ros>",
            "/r/joint_states",
            ["left_joint"],
            20,
        ),
        (
            "gz-sim-joint-state-publisher-system",
            "",
            "/world/empty/model/rover/joint_state",
            ["left_joint", "right_joint"],
            1000,
        ),
    ],
)
def test_joint_state_publishers(
    make: Make, filename: str, parameters: str, topic: str, joints: list[str], count: int
) -> None:
    extra = f'<gazebo><plugin name="states" filename="{filename}">{parameters}</plugin></gazebo>'
    simulator = make(None, extra=extra)
    simulator.run(1.0)
    message = simulator.bus.latest(topic)
    assert message.name == joints
    assert len(message.velocity) == len(joints)
    assert len(message.effort) == 0
    counts = {t.name: t.count for t in simulator.bus.topics}
    assert counts[topic] == count
    assert "/joint_states" not in counts


def test_odometry_messages_are_nav_msgs(make: Make) -> None:
    simulator = make("ros1")
    simulator.run(0.1)
    topics = {topic.name: topic.type for topic in simulator.bus.topics}
    assert topics["/rover/odom"] == ODOMETRY
    assert isinstance(twist((1, 2, 3), (4, 5, 6)).linear.x, float)
    assert SimpleNamespace(n=simulator.bus.latest("/rover/odom").header.stamp.nanosec).n == 100_000_000
