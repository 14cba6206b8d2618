"""A plugin of each table and a controller of each type continue after a snapshot as without one.

Each row of the tables is a test. It fails if the plugin has state that snapshots do not contain.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.sim.snapshots.comparison import command, differences
from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.controller_plugins import CONTROL
from urdfkit.description.plugins.drives.table import DRIVES
from urdfkit.description.plugins.sensors.table import BARE, SENSORS
from urdfkit.messages import from_fields
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.controllers.controller_types import ROS_CONTROLLERS

pytestmark = pytest.mark.slow

JOINTS = sorted({each.meaning for spec in DRIVES for each in spec.parameters if each.names == "joint"})
"""The joints of the robot, named as the parameters of drives."""

INERTIA = '<inertial><mass value="{}"/><inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/></inertial>'
SHAPE = '<geometry><box size="{}"/></geometry>'

SCAN = """<ray><scan><horizontal><samples>20</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>
</scan><range><min>0.1</min><max>10</max></range>{noise}</ray>"""
CAMERA = """<camera name="{name}"><horizontal_fov>1</horizontal_fov><image><width>16</width><height>12</height>
<format>R8G8B8</format></image><clip><near>0.1</near><far>50</far></clip>{noise}</camera>"""
NOISE = "<noise><type>gaussian</type><mean>0.01</mean><stddev>0.05</stddev></noise>"
IMU = f"""<imu><angular_velocity><x>{NOISE}</x></angular_velocity>
<linear_acceleration><z>{NOISE}</z></linear_acceleration></imu>"""
INSIDE = {"ray": SCAN.format(noise=NOISE), "camera": CAMERA.format(name="left", noise=NOISE), "imu": IMU}
INSIDE["multicamera"] = INSIDE["camera"] + CAMERA.format(name="right", noise=NOISE)

TYPES = {
    "laser": "ray", "block_laser": "ray", "range": "ray", "ray_sensor": "ray", "velodyne": "ray", "sonar": "ray",
    "camera": "camera", "multicamera": "multicamera", "openni_kinect": "depth", "depth_camera": "depth",
    "imu_sensor": "imu", "gps": "gps", "bumper": "contact",
}  # fmt: skip
"""Kind of a ROS plugin inside a ``<sensor>`` → type of the sensor."""

VALUES = {"wheel_pairs": "1", "target": "probe", "time": "0.1", "namespace": "touched"}
"""Meaning of a parameter that a plugin needs → its value."""

DRIFT = {"drift": "0.1", "driftFrequency": "2", "gaussianNoise": "0.05"}
"""Ends of the names of hector's parameters, and their values."""


def robot(extra: str, *, kind: str = "continuous") -> str:
    """Return a robot with a joint for every parameter of a drive, a sensor link and a foot on the ground."""
    text = (
        f'<robot name="probe"><link name="base">{INERTIA.format(5, i=0.5)}<collision name="body">'
        f'<origin xyz="0 0 0.1"/>{SHAPE.format("0.5 0.4 0.2")}</collision></link>'
        '<link name="eye"/><joint name="top" type="fixed"><parent link="base"/><child link="eye"/>'
        '<origin xyz="0 0 0.5"/></joint>'
    )
    for k, name in enumerate(JOINTS):
        axis = "0 0 1" if "steering" in name else "0 1 0"
        text += (
            f'<link name="{name}_link">{INERTIA.format(0.2, i=0.001)}<collision><geometry><sphere radius="0.05"/>'
            f'</geometry></collision></link><joint name="{name}" type="{kind}">'
            f'<parent link="base"/><child link="{name}_link"/><origin xyz="{0.1 * (k % 5)} {0.1 * (k // 5)} 0.4"/>'
            f'<axis xyz="{axis}"/><limit lower="-1" upper="1" effort="50" velocity="20"/></joint>'
        )
    return f"{text}{extra}</robot>"


def plugin(spec: PluginSpec) -> str:
    """Return the element of a plugin with values for its joints and for drift and noise."""
    written = []
    joints = any(each.names == "joint" for each in spec.parameters)
    for each in spec.parameters:
        own = re.sub(r"^(.*?)(drift|driftFrequency|gaussianNoise)$", r"\2", each.tag, flags=re.IGNORECASE)
        value = DRIFT.get(own[:1].lower() + own[1:])
        if each.names == "joint":
            value = each.meaning if each.meaning in JOINTS else JOINTS[0]
        elif each.names == "link" and each.default is None and "body" in each.meaning and not joints:
            value = "eye"
        elif each.meaning == "topic" and each.default is None:
            value = "probed"
        elif each.meaning in VALUES:
            value = VALUES[each.meaning]
        if value is not None:
            written.append(f"<{each.tag}>{value}</{each.tag}>")
    name = spec.class_names[0] if spec.class_names else "probed"
    return f'<plugin name="{name}" filename="{spec.filenames[0]}">{"".join(written)}</plugin>'


def block(spec: PluginSpec) -> str:
    """Return the ``<gazebo>`` block for a plugin of a table."""
    if (kind := TYPES.get(spec.kind)) is None:
        return f"<gazebo>{plugin(spec)}</gazebo>" + (sensor("contact") if spec.kind == "gz_touch" else "")
    return sensor(kind, plugin(spec))


def sensor(kind: str, inner: str = "") -> str:
    """Return a ``<sensor>`` of a type, on the link that a sensor of this type needs."""
    inside = INSIDE["ray"] if kind in ("ray", "gpu_ray", "lidar", "gpu_lidar") else INSIDE.get(kind, "")
    if re.search("camera|depth|rgbd|segmentation|boundingbox", kind) and kind != "logical_camera":
        inside = INSIDE.get(kind, INSIDE["camera"])
    if kind == "contact":
        inside = "<contact><collision>body</collision></contact>"
    place = {"contact": "base", "force_torque": JOINTS[0]}.get(kind, "eye")
    return (
        f'<gazebo reference="{place}"><sensor name="probed" type="{kind}"><always_on>1</always_on>'
        f"<update_rate>50</update_rate>{inside}{inner}</sensor></gazebo>"
    )


@pytest.fixture
def make(tmp_path: Path) -> Callable[..., Callable[[], Simulator]]:
    def prepare(extra: str, kind: str = "continuous", **options: Any) -> Callable[[], Simulator]:
        (tmp_path / "probe.urdf").write_text(robot(extra, kind=kind))

        def build() -> Simulator:
            notes: list[str] = []
            simulator = Simulator(tmp_path / "probe.urdf", spawn=Spawn(z=0.01), note=notes.append, seed=3, **options)
            installed = simulator.world.robots["probe"].plugins
            assert installed.drives or installed.sensors or installed.controllers or "state" in extra.lower(), notes
            return simulator

        return build

    return prepare


@pytest.mark.parametrize(
    "spec",
    [spec for spec in (*DRIVES, *SENSORS, *CONTROL) if not spec.kind.endswith("_control") or "velocity" in spec.kind],
    ids=lambda spec: f"{spec.kind}-{spec.generation}-{spec.filenames[0]}",
)
def test_a_plugin_of_each_table(make, spec: PluginSpec) -> None:
    assert differences(make(block(spec))) == []


@pytest.mark.parametrize("kind", BARE)
def test_a_sensor_of_each_type_without_a_plugin(make, kind: str) -> None:
    assert differences(make(sensor(kind))) == []


WHEELS, STEERING = ["left_joint", "right_joint"], ["left_steering_joint", "right_steering_joint"]
FOUR = ["front_left_joint", "front_right_joint", "rear_left_joint", "rear_right_joint"]
SIZES = "wheelbase: 0.6, traction_wheels_radius: 0.1, traction_track_width: 0.4"
PID = "{p: 20, i: 1, d: 0.5, i_clamp: 5}"
GRIPPER = "joint: left_joint, max_stalled_velocity: 0.01"

CONTROLLERS: dict[str, tuple[int, dict[str, list[str]], str]] = {
    "joint_state_broadcaster/JointStateBroadcaster": (2, {"position": WHEELS}, ""),
    "velocity_controllers/JointVelocityController": (1, {"velocity": ["left_joint"]}, "joint: left_joint"),
    "velocity_controllers/JointGroupVelocityController": (2, {"velocity": ["left_joint"]}, "joints: [left_joint]"),
    "effort_controllers/JointPositionController": (1, {"effort": ["left_joint"]}, f"joint: left_joint, pid: {PID}"),
    "effort_controllers/JointVelocityController": (1, {"effort": ["left_joint"]}, f"joint: left_joint, pid: {PID}"),
    "effort_controllers/JointGroupPositionController": (
        1, {"effort": ["left_joint"]}, f"joints: [left_joint], left_joint: {{pid: {PID}}}",
    ),
    "effort_controllers/JointTrajectoryController": (
        1, {"effort": ["left_joint"]}, f"joints: [left_joint], gains: {{left_joint: {PID}}}",
    ),
    "diff_drive_controller/DiffDriveController": (
        2, {"velocity": WHEELS},
        "left_wheel_names: [left_joint], right_wheel_names: [right_joint], wheel_separation: 0.4, wheel_radius: 0.1",
    ),
    "position_controllers/GripperActionController": (2, {"position": ["left_joint"]}, GRIPPER),
    "parallel_gripper_action_controller/GripperActionController": (2, {"position": ["left_joint"]}, GRIPPER),
    "ackermann_steering_controller/AckermannSteeringController": (
        2, {"velocity": WHEELS, "position": STEERING},
        f"traction_joints_names: {WHEELS}, steering_joints_names: {STEERING}, {SIZES}",
    ),
    "four_wheel_steering_controller/FourWheelSteeringController": (
        1, {"velocity": FOUR, "position": [*STEERING, "steering_joint", "steering_wheel_joint"]},
        (f"front_wheel: {FOUR[:2]}, rear_wheel: {FOUR[2:]}, front_steering: {STEERING}, "
        "rear_steering: [steering_joint, steering_wheel_joint], track: 0.4, wheel_base: 0.6, wheel_radius: 0.1, "
        f"pose_covariance_diagonal: {[0] * 6}, twist_covariance_diagonal: {[0] * 6}"),
    ),
    "mecanum_drive_controller/MecanumDriveController": (
        2, {"velocity": FOUR},
        ("front_left_wheel_command_joint_name: front_left_joint, front_right_wheel_command_joint_name: "
        "front_right_joint, rear_right_wheel_command_joint_name: rear_right_joint, "
        "rear_left_wheel_command_joint_name: rear_left_joint, kinematics: {wheels_radius: 0.1, "
        "sum_of_robot_center_projection_on_X_Y_axis: 0.4}"),
    ),
}  # fmt: skip
"""Type of a controller → version of ROS, joints by interface, and parameters."""


def send(simulator: Simulator) -> None:
    """Publish commands, and a trajectory or goal that is still active when the snapshot is taken."""
    command(simulator)
    trajectory = {
        "joint_names": ["left_joint"],
        "points": [{"positions": [0.5], "time_from_start": 0.1}, {"positions": [-0.5], "time_from_start": 1.0}],
    }
    for topic in simulator.bus.topics:
        fields: dict[str, Any] | None = None
        if topic.type.endswith("FollowJointTrajectoryActionGoal"):
            fields = {"goal": {"trajectory": trajectory}}
        elif topic.type.endswith("GripperCommand_SendGoal_Request"):
            position = [0.9] if "Parallel" in topic.type else 0.9
            fields = {"goal": {"command": {"position": position}}}
        if fields is not None and topic.subscribers:
            simulator.bus.publish(topic.name, topic.type, from_fields(topic.type, fields))


def test_each_class_of_controllers_has_a_case() -> None:
    assert [kind.__name__ for kind in ROS_CONTROLLERS if not kind.types.keys() & CONTROLLERS.keys()] == []


@pytest.mark.parametrize("kind", CONTROLLERS)
def test_a_controller_of_each_class(make, tmp_path: Path, kind: str) -> None:
    ros, joints, parameters = CONTROLLERS[kind]
    pairs = [(interface, name) for interface, names in joints.items() for name in names]
    if ros == 1:
        extra = "".join(
            '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
            f'<joint name="{name}"><hardwareInterface>hardware_interface/{interface.capitalize()}JointInterface'
            "</hardwareInterface></joint></transmission>"
            for interface, name in pairs
        )
        extra += '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
        yaml = f"probe:\n  own: {{type: {kind}, {parameters}}}\n"
    else:
        interfaces = "".join(
            f'<joint name="{name}"><command_interface name="{interface}"/></joint>' for interface, name in pairs
        )
        extra = (
            '<ros2_control name="r" type="system"><hardware><plugin>gazebo_ros2_control/GazeboSystem</plugin>'
            f"</hardware>{interfaces}</ros2_control>"
            '<gazebo><plugin filename="libgazebo_ros2_control.so" name="c"/></gazebo>'
        )
        yaml = f"controller_manager:\n  ros__parameters:\n    own: {{type: {kind}}}\n"
        yaml += f"own:\n  ros__parameters: {{{parameters}}}\n"
    (tmp_path / "control.yaml").write_text(yaml)
    build = make(extra, kind="revolute", controllers=[tmp_path / "control.yaml"])
    (own,) = [each for each in build().controllers.list() if each.name == "own"]
    assert own.state in ("running", "active")
    assert differences(build, act=send) == []
