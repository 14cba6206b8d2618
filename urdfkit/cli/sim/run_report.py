"""Reports of ``sim run``: the JSON object, and a summary as text."""

from dataclasses import dataclass
from math import hypot
from typing import Any

from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.quaternion import to_rpy

MAX_JOINTS = 8
"""Number of joints in the summary."""


@dataclass(frozen=True, slots=True)
class Effort:
    """CPU and wall seconds spent stepping.

    Attributes:
        is_paced: the simulation ran in real time, for bridges.
    """

    cpu: float
    wall: float
    is_paced: bool = False

    def factor(self, t: float) -> float:
        """Return simulated seconds per CPU second, or per second of the wall clock if the simulation was paced."""
        spent = self.wall if self.is_paced else self.cpu
        return t / spent if spent > 0 else 0.0


def as_json(simulator: Simulator, spent: Effort) -> dict[str, Any]:
    """Return the report as JSON values.

    Planar and floating joints have the same fields as the base, relative to their parent frame; ``odometry`` is
    keyed by odometry frame; ``real_time_factor`` is that of `Effort.factor`.
    """
    state = simulator.state
    pose, velocity = state.base_pose, state.base_velocity
    kinetic, potential = state.energy
    joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
    return {
        "robot": simulator.name,
        "world": simulator.world.name,
        "dt": simulator.dt,
        "steps": state.step,
        "duration": state.t,
        "cpu": spent.cpu,
        "wall": spent.wall,
        "real_time_factor": spent.factor(state.t),
        "base": {
            "frame": simulator.kinematics.root,
            "position": list(pose[:3]),
            "quaternion": list(pose[3:]),
            "linear_velocity": list(velocity[:3]),
            "angular_velocity": list(velocity[3:]),
        },
        "joints": {
            name: {"position": state.position(name), "velocity": state.velocity(name), "effort": state.effort(name)}
            for name in joints
        }
        | {name: _several(simulator, name) for name in simulator.kinematics.several_names},
        "odometry": {
            frame: {"position": list(position), "quaternion": list(quaternion)}
            for frame, (position, quaternion) in simulator.odometry().items()
        },
        "bodies": {
            name: {"position": list(pose[:3]), "quaternion": list(pose[3:])}
            for name, pose in simulator.world.body_poses().items()
        },
        "contacts": [
            {
                "a": contact.a,
                "b": contact.b,
                "position": list(contact.position),
                "normal": list(contact.normal),
                "depth": contact.depth,
                "force": list(contact.force),
            }
            for contact in state.contacts
        ],
        "repairs": [repair.as_json() for repair in simulator.repairs],
        "energy": {"kinetic": kinetic, "potential": potential},
        "topics": {
            topic.name: {"type": topic.type.replace("/msg/", "/"), "count": topic.count}
            for topic in simulator.bus.topics
        },
    }


def as_text(simulator: Simulator, spent: Effort) -> str:
    """Return the summary as text."""
    state = simulator.state
    pose = state.base_pose
    factor = spent.factor(state.t)
    rate = f", {factor:.{2 if spent.is_paced else 0}f} × real time" if factor else ""
    lines = [
        f"{simulator.name} in world {simulator.world.name}: {state.t:g} s in {state.step} steps{rate}",
        _line(f"base {simulator.kinematics.root}", pose[:3], pose[3:]),
    ]
    for frame, (position, quaternion) in simulator.odometry().items():
        off = hypot(position[0] - pose[0], position[1] - pose[1])
        lines.append(_line(f"odometry {frame}", position, quaternion) + f"  ({1000 * off:.1f} mm from the base)")
    joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
    for name in joints[:MAX_JOINTS]:
        unit = "m" if simulator.robot.joint_by_name[name].type == "prismatic" else "rad"
        at, speed = _fixed(state.position(name)), _fixed(state.velocity(name))
        lines.append(f"joint {name}: {at} {unit}, {speed} {unit}/s")
    if (more := len(joints) - MAX_JOINTS) > 0:
        lines.append(f"and {more} more joint{'s' * (more != 1)} (--json shows all)")
    for name in simulator.kinematics.several_names:
        pose, twist = state.several(name)
        speed, turning = (" ".join(map(_fixed, part)) for part in (twist[:3], twist[3:]))
        lines.append(_line(f"joint {name}", pose[:3], pose[3:]) + f", moving at {speed} m/s, {turning} rad/s")
    touching = {contact.a for contact in state.contacts}
    lines.append(f"on the ground: {', '.join(sorted(touching)) or 'nothing'}")
    return "\n".join(lines)


def _several(simulator: Simulator, joint: str) -> dict[str, Any]:
    pose, twist = simulator.state.several(joint)
    return {
        "position": list(pose[:3]),
        "quaternion": list(pose[3:]),
        "linear_velocity": list(twist[:3]),
        "angular_velocity": list(twist[3:]),
    }


def _line(label: str, position: tuple[float, ...], quaternion: tuple[float, ...]) -> str:
    x, y, z, roll, pitch, yaw = map(_fixed, (*position, *to_rpy(quaternion)))
    return f"{label}: x {x} y {y} z {z} m, roll {roll} pitch {pitch} yaw {yaw} rad"


def _fixed(number: float) -> str:
    return f"{round(number, 4) + 0.0:.4f}"  # the sum turns -0.0000 into 0.0000
