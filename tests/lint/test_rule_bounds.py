"""Rules at both sides of their bounds, and with each part of their conditions alone."""

from __future__ import annotations

import re

import pytest

from urdfkit.lint import lint

LIMITS = 'effort="1" velocity="1"'
BOX = '<geometry><box size="1 1 1"/></geometry>'
BALL = '<geometry><sphere radius="0.1"/></geometry>'
UNIT = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
BASE = '<link name="base"/>'
TOO_LARGE = "inertia of link `base` is too large: radius of gyration 1 m, but its shapes extend only 0.1 m"


def joint(inside: str = "", *, type: str = "revolute", name: str = "elbow", child: str = "arm") -> str:
    links = f'<joint name="{name}" type="{type}"><parent link="base"/><child link="{child}"/>{inside}</joint>'
    return f'{links}<link name="{child}"/>'


def axes(count: int, *, without: int) -> str:
    """Return joints of which the first ones have no axis, with links that have a shape."""
    joints = (
        joint("" if k < without else '<axis xyz="0 0 1"/>', type="continuous", name=f"j{k}", child=f"l{k}")
        for k in range(count)
    )
    return re.sub(r'(<link name="l\d+")/>', rf"\1><visual>{BOX}</visual></link>", "".join(joints))


def moved(inside: str, *, type: str = "continuous") -> str:
    return BASE + joint(type=type).replace('<link name="arm"/>', f'<link name="arm">{inside}</link>')


def fixed(inside: str) -> str:
    """Return a link that is fixed to a base with a mass."""
    return moved(inside, type="fixed").replace(BASE, f'<link name="base">{inertial(1)}</link>')


def inertial(mass: float, tensor: str = UNIT, xyz: str = "0 0 0") -> str:
    return f'<inertial><origin xyz="{xyz}"/><mass value="{mass}"/>{tensor}</inertial>'


def diagonal(xx: float, yy: float, zz: float) -> str:
    return f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>'


def limits(lower: float, upper: float, *, type: str = "revolute") -> str:
    return joint(f'<limit lower="{lower}" upper="{upper}" {LIMITS}/>', type=type)


def safety(attributes: str, *, type: str = "revolute") -> str:
    return joint(f'<limit lower="-1" upper="2" {LIMITS}/><safety_controller {attributes}/>', type=type)


def colour(rgba: str) -> str:
    return f'<material name="paint"><color rgba="{rgba}"/></material>'


def wheel(xyz: str, *, type: str = 'type="continuous"', axis: str = '<axis xyz="0 1 0"/>', shape: str = "") -> str:
    shape = shape or '<cylinder radius="0.1" length="0.05"/>'
    visual = f'<visual><origin xyz="{xyz}" rpy="1.5707963 0 0"/><geometry>{shape}</geometry></visual>'
    parts = '<parent link="base"/><child link="wheel"/>'
    return f'{BASE}<joint name="axle" {type}>{parts}{axis}</joint><link name="wheel">{visual}</link>'


def system(name: str, filename: str) -> str:
    return f'<gazebo><plugin name="{name}" filename="{filename}"/></gazebo>'


def control(interface: str, *, type: str = "revolute") -> str:
    block = (
        f'<ros2_control name="r" type="system"><joint name="elbow">{interface}</joint>'
        f"<hardware><plugin>gazebo_ros2_control/GazeboSystem</plugin></hardware></ros2_control>"
    )
    return joint('<limit lower="-1" upper="1" effort="2" velocity="3"/>', type=type) + block


def command(name: str, which: str, value: float) -> str:
    return f'<command_interface name="{name}"><param name="{which}">{value}</param></command_interface>'


CASES: list[tuple[str, str, list[str]]] = [
    # mass-nonpositive
    ("I501", moved(inertial(0) + f"<visual>{BOX}</visual>"), ["warning: link `arm` has an inertia but no mass"]),
    ("I501", moved(inertial(0) + f"<collision>{BOX}</collision>"), ["warning: link `arm` has an inertia but no mass"]),
    ("I501", fixed(inertial(0) + f"<visual>{BOX}</visual>"), []),
    ("I501", moved(inertial(-1), type="fixed"), ["error: mass of link `arm` is negative: -1 kg"]),
    ("I501", moved(inertial(1e-6)), []),
    # inertia-zero
    ("I504", moved(inertial(2, diagonal(0, 0, 0))), ["error: link `arm` has a mass of 2 kg but zero inertia"]),
    (
        "I504",
        fixed(inertial(2, diagonal(0, 0, 0))),
        ["note: link `arm` has a mass of 2 kg but zero inertia"],
    ),
    ("I504", moved(inertial(2, diagonal(0, 0, 1e-9))), []),
    ("I504", moved(inertial(0, diagonal(0, 0, 0))), []),
    ("I504", moved(inertial(-2, diagonal(0, 0, 0))), []),
    # inertia-identity-placeholder: explained by a mass of 1 kg at 1 m, or by an unknown size
    ("I509", moved(inertial(1)), []),
    ("I509", moved(inertial(-1) + f"<visual>{BOX}</visual>"), []),
    (
        "I509",
        moved(inertial(1) + f"<visual>{BALL}</visual>"),
        ["warning: inertia of link `arm` is the identity matrix, a placeholder"],
    ),
    # axis-missing-on-movable: a warning where the only one of at least four has no axis
    (
        "J413",
        BASE + axes(4, without=1),
        ["warning: continuous joint `j0` has no <axis> and uses the default, x (1 0 0)"],
    ),
    ("J413", BASE + axes(3, without=1), ["note: continuous joint `j0` has no <axis> and uses the default, x (1 0 0)"]),
    (
        "J413",
        BASE + axes(5, without=2),
        [f"note: continuous joint `j{k}` has no <axis> and uses the default, x (1 0 0)" for k in range(2)],
    ),
    # limits
    ("J405", BASE + limits(1, 1), []),
    (
        "J405",
        BASE + limits(1, 0.5),
        ["error: lower limit 1 rad of joint `elbow` is greater than its upper limit 0.5 rad"],
    ),
    (
        "J405",
        BASE + limits(1, 0.5, type="prismatic"),
        ["error: lower limit 1 m of joint `elbow` is greater than its upper limit 0.5 m"],
    ),
    ("J405", BASE + limits(1, 0.5, type="continuous"), []),
    (
        "J405",
        BASE + joint(f'<limit upper="-1" {LIMITS}/>'),
        ["error: lower limit 0 rad of joint `elbow` is greater than its upper limit -1 rad"],
    ),
    ("J406", BASE + limits(0, 0), ["warning: joint `elbow` cannot move: both limits are 0 rad"]),
    ("J406", BASE + limits(0.5, 0.5), ["note: joint `elbow` cannot move: both limits are 0.5 rad"]),
    ("J406", BASE + limits(0.5, 0.5, type="prismatic"), ["note: joint `elbow` cannot move: both limits are 0.5 m"]),
    ("J406", BASE + limits(0.5, 0.5, type="continuous"), []),
    (
        "J406",
        BASE + joint(f'<limit lower="0" {LIMITS}/>'),
        ["warning: joint `elbow` cannot move: both limits are 0 rad"],
    ),
    ("J407", BASE + limits(-12.5, 12.5), []),
    ("J407", BASE + limits(0, 13), ["warning: upper limit 13 rad of joint `elbow` is 2.1 turns"]),
    ("J407", BASE + limits(-13, 1), ["warning: lower limit -13 rad of joint `elbow` is 2.1 turns"]),
    ("J407", BASE + limits(0, 360), ["warning: upper limit 360 rad of joint `elbow` is 57.3 turns"]),
    ("J407", BASE + limits(0, 361), []),
    ("J407", BASE + limits(0, 22.5), ["warning: upper limit 22.5 rad of joint `elbow` is 3.6 turns"]),
    ("J407", BASE + limits(0, 22.3), []),
    ("J407", BASE + limits(0, 90, type="prismatic"), []),
    # effort-or-velocity-zero
    (
        "J409",
        BASE + joint('<limit effort="0" velocity="0"/>', type="continuous"),
        ["note: effort and velocity limits of joint `elbow` are zero"],
    ),
    (
        "J409",
        BASE + joint('<limit effort="1" velocity="0"/>', type="continuous"),
        ["note: velocity limit of joint `elbow` is zero"],
    ),
    ("J409", BASE + joint('<limit effort="0" velocity="0"/>', type="fixed"), []),
    # axis-not-normalised
    ("J412", BASE + joint('<axis xyz="0 0 1.0009"/>', type="continuous"), []),
    (
        "J412",
        BASE + joint('<axis xyz="0 0 0.5"/>', type="continuous"),
        ["warning: the axis of joint `elbow` has length 0.5 instead of 1"],
    ),
    ("J412", BASE + joint('<axis xyz="0 0 2"/>', type="fixed"), []),
    ("J412", BASE + joint('<axis xyz="0 0 0"/>', type="continuous"), []),
    # dynamics-empty-or-negative
    ("J419", BASE + joint("<dynamics/>"), ["warning: <dynamics> of joint `elbow` has neither damping nor friction"]),
    ("J419", BASE + joint('<dynamics friction="0"/>'), []),
    (
        "J419",
        BASE + joint('<dynamics damping="-1"/>', type="prismatic"),
        ["warning: damping -1 N·s/m of joint `elbow` is negative"],
    ),
    (
        "J419",
        BASE + joint('<dynamics friction="-1"/>', type="prismatic"),
        ["warning: friction -1 N of joint `elbow` is negative"],
    ),
    ("J419", BASE + joint('<dynamics friction="-1"/>'), ["warning: friction -1 N·m of joint `elbow` is negative"]),
    # safety-controller-inconsistent
    ("J420", BASE + safety('k_velocity="1" soft_lower_limit="-1" soft_upper_limit="2"'), []),
    (
        "J420",
        BASE + safety('k_velocity="1" soft_lower_limit="-2" soft_upper_limit="1"'),
        ["warning: soft_lower_limit -2 rad of joint `elbow` is beyond the hard limit -1 rad"],
    ),
    (
        "J420",
        BASE + safety('k_velocity="1" soft_upper_limit="3"', type="prismatic"),
        ["warning: soft_upper_limit 3 m of joint `elbow` is beyond the hard limit 2 m"],
    ),
    (
        "J420",
        BASE + safety('k_velocity="1" soft_lower_limit="1" soft_upper_limit="0"'),
        ["warning: soft_lower_limit 1 rad of joint `elbow` is greater than soft_upper_limit 0 rad"],
    ),
    (
        "J420",
        BASE + safety('soft_lower_limit="0" soft_upper_limit="0"'),
        ["warning: <safety_controller> of joint `elbow` lacks k_velocity"],
    ),
    ("J420", BASE + safety('k_velocity="1" soft_lower_limit="5"', type="continuous"), []),
    # rgba-out-of-range
    ("G614", colour("1 1 1 1"), []),
    ("G614", colour("255 0 0 255"), ['warning: rgba="255 0 0 255" has components outside the range 0 to 1']),
    ("G614", colour("0 0 0 -0.5"), ['warning: rgba="0 0 0 -0.5" has components outside the range 0 to 1']),
    # visual-offset-from-wheel-axis
    ("G615", wheel("0 0.5 0.009"), []),
    ("G615", wheel("0 0.5 0.011"), ["warning: wheel `wheel` is drawn 0.011 m off the axis of joint `axle`"]),
    ("G615", wheel("0 0 0.05", shape='<cylinder radius="0.1" length="0.2"/>'), []),
    (
        "G615",
        wheel("0 0 0.05", shape='<sphere radius="0.1"/>'),
        ["warning: wheel `wheel` is drawn 0.05 m off the axis of joint `axle`"],
    ),
    ("G615", wheel("0 0 0.05", type='type="revolute"'), []),
    ("G615", wheel("0 0 0.05", type=""), ["warning: wheel `wheel` is drawn 0.05 m off the axis of joint `axle`"]),
    ("G615", wheel("0 0 0.05", axis='<axis xyz="1 0 0"/>'), []),
    # plugin-unknown
    ("Z825", system("drive", "libgazebo_ros_dif_driv$.so"), []),
    ("Z825", system("drive", "libsomething_of_my_own.so"), []),
    ("Z825", system("drive", "libgazebo_ros_diff_drive.so"), []),
    (
        "Z825",
        system("camera", "libgazebo_ros_kinect.so"),
        ["error: unknown library `gazebo_ros_kinect`; did you mean `libgazebo_ros_openni_kinect.so`?"],
    ),
    ("Z825", system("drive", "libgazebo_ros_drive.so"), []),  # diff drive, or tricycle drive
    (
        "C719",
        control(command("position", "max", 1.5)),
        ["note: position command of joint `elbow`: max 1.5 is beyond the joint limit 1 rad"],
    ),
    (
        "C719",
        control(command("position", "min", -57)),
        ["warning: position command of joint `elbow`: min -57 is beyond the joint limit -1 rad"],
    ),
    (
        "C719",
        control(command("position", "min", -57), type="prismatic"),
        ["note: position command of joint `elbow`: min -57 is beyond the joint limit -1 m"],
    ),
    (
        "C719",
        control(command("velocity", "min", -4)),
        ["note: velocity command of joint `elbow`: min -4 is beyond the joint limit -3 rad/s"],
    ),
    (
        "C719",
        control(command("effort", "max", 4)),
        ["note: effort command of joint `elbow`: max 4 is beyond the joint limit 2 N·m"],
    ),
    (
        "C719",
        control(command("effort", "max", 4), type="prismatic"),
        ["note: effort command of joint `elbow`: max 4 is beyond the joint limit 2 N"],
    ),
    ("C719", control(command("position", "min", 0.5)), []),
    (
        "C719",
        control(command("velocity", "min", 1).replace("</param>", '</param><param name="max">1</param>')),
        ["warning: velocity command of joint `elbow`: min 1 is equal to max 1"],
    ),
    (
        "C719",
        control(command("position", "initial_value", 9).replace("command_", "state_")),
        ["warning: initial position 9 rad of joint `elbow` is beyond its limits -1 … 1 rad"],
    ),
    ("C719", control(command("position", "initial_value", 1.0005).replace("command_", "state_")), []),
    ("C719", control(command("velocity", "initial_value", 9).replace("command_", "state_")), []),
]


@pytest.mark.parametrize(("code", "body", "expected"), CASES, ids=[f"{i}-{case[0]}" for i, case in enumerate(CASES)])
def test_rules_at_their_bounds(code: str, body: str, expected: list[str], write) -> None:
    found = lint(write("r.urdf", body), select=(code,))
    assert [f"{finding.severity}: {finding.message}" for finding in found] == expected
