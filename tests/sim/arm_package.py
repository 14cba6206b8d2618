"""Packages of a two-joint arm and its controllers, written where a test wants them."""

from __future__ import annotations

from pathlib import Path

LINK = """
  <link name="{name}">
    <collision><origin xyz="0 0 {half}"/><geometry><box size="0.05 0.05 {length}"/></geometry></collision>
    <inertial><origin xyz="0 0 {half}"/><mass value="{mass}"/>
      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.002"/></inertial>
  </link>
"""

JOINT = """
  <joint name="{name}" type="{type}"><parent link="{parent}"/><child link="{child}"/>
    <origin xyz="0 0.1 {z}"/><axis xyz="0 1 0"/>{limit}</joint>
"""

TRANSMISSION = """
  <transmission name="tran_{joint}"><type>transmission_interface/SimpleTransmission</type>
    <joint name="{joint}"><hardwareInterface>hardware_interface/{interface}JointInterface</hardwareInterface></joint>
    <actuator name="motor_{joint}"><mechanicalReduction>1</mechanicalReduction></actuator>
  </transmission>
"""

PLUGIN = """
  <gazebo><plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">
    <robotNamespace>/arm</robotNamespace></plugin></gazebo>
"""

LIMIT = '<limit lower="-2.5" upper="2.5" effort="{effort}" velocity="{velocity}"/>'


def arm(extra: str, *, elbow: str = "revolute", effort: float = 40.0, velocity: float = 4.0, safety: str = "") -> str:
    """Return an arm: shoulder and elbow about y, each link 0.4 m long and 1 kg, and more XML."""
    limit = LIMIT.format(effort=effort, velocity=velocity) + safety
    turning = f'<limit effort="{effort}" velocity="{velocity}"/>'
    return (
        '<robot name="arm"><link name="world"/><link name="base"/>\n'
        '<joint name="mount" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>'
        + LINK.format(name="upper", half=0.2, length=0.4, mass=1)
        + LINK.format(name="fore", half=0.2, length=0.4, mass=1)
        + JOINT.format(name="shoulder", type="revolute", parent="base", child="upper", z=0.1, limit=limit)
        + JOINT.format(
            name="elbow", type=elbow, parent="upper", child="fore", z=0.4,
            limit=limit if elbow == "revolute" else turning,
        )
        + extra
        + "</robot>"
    )  # fmt: skip


def transmissions(shoulder: str = "Effort", elbow: str = "Effort") -> str:
    """Return transmissions for both joints, with the hardware interfaces named, and the plugin."""
    return (
        TRANSMISSION.format(joint="shoulder", interface=shoulder)
        + TRANSMISSION.format(joint="elbow", interface=elbow)
        + PLUGIN
    )


def package(folder: Path, name: str) -> Path:
    """Make an empty package."""
    where = folder / name
    where.mkdir(parents=True, exist_ok=True)
    (where / "package.xml").write_text(f"<package format='2'><name>{name}</name></package>")
    return where


def write_arm(folder: Path, extra: str, **options: object) -> Path:
    """Write the package arm_description; returns the model's file."""
    urdf = package(folder, "arm_description") / "urdf" / "arm.urdf"
    urdf.parent.mkdir(exist_ok=True)
    urdf.write_text(arm(extra, **options))  # type: ignore[arg-type]
    return urdf


def write_control(folder: Path, yaml: str, *spawned: str, launch: bool = True) -> Path:
    """Write the package arm_control: a parameter file and a launch file that loads it and spawns controllers."""
    where = package(folder, "arm_control")
    (where / "config").mkdir(exist_ok=True)
    path = where / "config" / "arm.yaml"
    path.write_text(yaml)
    if launch:
        (where / "launch").mkdir(exist_ok=True)
        spawner = f'<node name="s" pkg="controller_manager" type="spawner" ns="/arm" args="{" ".join(spawned)}"/>'
        (where / "launch" / "control.launch").write_text(
            '<launch><arg name="file" default="arm"/>'
            '<rosparam command="load" file="$(find arm_control)/config/$(arg file).yaml"/>'
            f"{spawner if spawned else ''}</launch>"
        )
    return path
