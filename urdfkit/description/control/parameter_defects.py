"""Defects of the parameters of controllers: missing ones, and values that their controller cannot read."""

from collections.abc import Callable, Iterator, Sequence

from urdfkit.description.control.controller_types import TYPES
from urdfkit.description.control.settings import Settings
from urdfkit.errors import DescriptionError

_NUMBERS = (
    *("state_publish_rate", "action_monitor_rate", "stop_trajectory_duration", "publish_rate", "cmd_vel_timeout"),
    *("reference_timeout", "max_effort", "goal_tolerance", "stall_velocity_threshold", "stall_timeout"),
    *("wheel_separation_h_multiplier", "wheel_radius_multiplier", "steer_pos_multiplier"),
    *("wheel_separation_multiplier", "left_wheel_radius_multiplier", "right_wheel_radius_multiplier"),
)
_LENGTHS = (
    *("wheel_separation", "wheel_radius", "wheelbase", "wheel_track", "front_wheel_track", "rear_wheel_track"),
    *("traction_track_width", "steering_track_width", "traction_wheels_radius", "traction_wheel_radius"),
    *("front_wheels_radius", "front_wheel_radius", "rear_wheels_radius", "rear_wheel_radius", "wheel_separation_h"),
    *("kinematics/wheels_radius", "kinematics/sum_of_robot_center_projection_on_X_Y_axis", "track", "wheel_base"),
)
"""Numbers greater than zero."""
_FLAGS = (
    *("allow_partial_joints_goal", "allow_nonzero_velocity_at_trajectory_end", "allow_stalling", "open_loop"),
    *("front_steering", "reduce_wheel_speed_until_steering_reached", "enable_odom_tf", "publish_cmd"),
    *("publish_limited_velocity", "allow_multiple_cmd_vel_publishers", "use_local_topics", "use_stamped_vel"),
    "tf_frame_prefix_enable",
)
_CORNERS = tuple(f"{axle}_{side}_wheel_command_joint_name" for axle in ("front", "rear") for side in ("left", "right"))
_TEXTS = (
    *("odom_frame_id", "base_frame_id", "tf_frame_prefix", "interpolation_method", "interface_name", "joint"),
    *("max_effort_interface", "max_velocity_interface"),
    *_CORNERS,
)
_NAMES = (
    *("joints", "left_wheel", "right_wheel", "left_wheel_names", "right_wheel_names", "front_wheel", "rear_wheel"),
    *("front_wheels_names", "rear_wheels_names", "traction_joints_names", "steering_joints_names"),
    *("front_steer", "rear_steering"),
)
_VARIANCES = ("pose_covariance_diagonal", "twist_covariance_diagonal")

SIGNS = {"max_deceleration": -1, "max_acceleration_reverse": -1, "max_deceleration_reverse": 1}
"""Limit of diff_drive_controller since Jazzy → the sign that it may have."""

SIGNS_OF_MINIMA = {"min_velocity": -1, "min_jerk": -1}
"""Limit of diff_drive_controller → the sign that it may have since Jazzy; any in Humble."""

JOINT_NAMES = ("joint", *_CORNERS, *_NAMES)
"""Parameters that name joints."""

_ACKERMANN = "ackermann_steering_controller/AckermannSteeringController"
_PAIRS = ("front_wheel", "rear_wheel", "front_steering", "rear_steering")
_INTERFACES = ("position", "velocity", "effort")
"""Interfaces of ``interface_name`` that Gazebo's hardware has."""
STEERED = {
    "bicycle_steering_controller/BicycleSteeringController": (1, 1),
    "tricycle_steering_controller/TricycleSteeringController": (2, 1),
    _ACKERMANN: (2, 2),
}
"""Type of a steering controller → numbers of its driven and of its steered joints in ROS 2."""

_FOUR_WHEELS = "four_wheel_steering_controller/FourWheelSteeringController"
"""The one type of ROS 1 in which `front_steering` is a list of joints."""
_OTHER_KINDS = ((_FOUR_WHEELS, "front_steering"), ("gpio_controllers/GpioCommandController", "command_interfaces"))
"""Types of controllers, and a parameter that is of another kind in them."""

_REQUIRED = {
    "joint_trajectory_controller/JointTrajectoryController": ("joints", "command_interfaces"),
    "forward_command_controller/ForwardCommandController": ("interface_name", "joints"),
    "parallel_gripper_action_controller/GripperActionController": ("joint",),
    "mecanum_drive_controller/MecanumDriveController": (*_CORNERS, *_LENGTHS[-4:-2]),
    **{
        f"{kind}_controllers/{name}": (parameter,)
        for kind in ("position", "velocity", "effort")
        for name, parameter in (
            ("JointTrajectoryController", "joints"),
            (f"JointGroup{kind.title()}Controller", "joints"),
            ("JointPositionController", "joint"),
            ("JointVelocityController", "joint"),
            ("JointEffortController", "joint"),
            ("GripperActionController", "joint"),
        )
    },
}
"""Type → parameters without a default."""
_DIFF = "diff_drive_controller/DiffDriveController"
_REQUIRED_BY_RELEASE = {
    (_DIFF, 1): ("left_wheel", "right_wheel", *_VARIANCES),
    (_DIFF, 2): ("left_wheel_names", "right_wheel_names", "wheel_separation", "wheel_radius"),
    (_ACKERMANN, 1): ("wheel_separation_h", "wheel_radius", *_VARIANCES),
    (_FOUR_WHEELS, 1): ("front_wheel", "rear_wheel", "front_steering", "rear_steering", *_VARIANCES),
    **{(kind, 2): ("wheelbase",) for kind in STEERED},
}
"""Type and version of ROS → parameters without a default."""


def _length(settings: Settings, name: str) -> None:
    value = settings.number(name, 1.0)
    if value <= 0.0:
        place, name = settings.group(name).position, name.rpartition("/")[2]
        raise DescriptionError(f"`{name}` is {value:g} m; it must be greater than zero", position=place)


def _variances(settings: Settings, name: str) -> None:
    found = settings.numbers(name, ())
    if len(found) != 6:
        place = settings.group(name).position
        raise DescriptionError(f"`{name}` has {len(found)} numbers; it needs 6", position=place)


_READERS: dict[str, Callable[[Settings, str], object]] = {
    **dict.fromkeys(_NUMBERS, lambda settings, name: settings.number(name, 0.0, unset=True)),
    **dict.fromkeys(_LENGTHS, _length),
    **dict.fromkeys(_FLAGS, lambda settings, name: settings.flag(name, False)),
    **dict.fromkeys(_TEXTS, lambda settings, name: settings.text(name, "")),
    **dict.fromkeys((*_NAMES, "command_interfaces"), lambda settings, name: settings.texts(name)),
    **dict.fromkeys(_VARIANCES, _variances),
}
"""Parameter → function that raises an error for a value that its controllers cannot read."""


def invalid_parameters(settings: Settings, ros: int) -> Iterator[DescriptionError]:
    """Yield the errors of the parameters of a controller that are missing or that it cannot read.

    Args:
        settings: parameters of the controller.
        ros: version of ROS.
    """
    kind = settings.group("type").value or ""
    for name in (*_REQUIRED.get(kind, ()), *_REQUIRED_BY_RELEASE.get((kind, ros), ())):
        if not (found := settings.find(name)) or not (found.items or found.value is not None or found.children):
            try:
                settings.text(name)
            except DescriptionError as error:
                yield error
    if kind not in TYPES:
        return
    for name, read in _READERS.items():
        if settings.find(name) is None or (kind, name) in _OTHER_KINDS:
            continue
        try:
            read(settings, name)
        except DescriptionError as error:
            yield error
    if ros == 2 and kind in STEERED:
        yield from _wrong_counts(settings, traction_and_steering, STEERED[kind])
        yield from _missing_lengths(settings, STEERED[kind][0])
    if ros == 1 and kind == _FOUR_WHEELS:
        yield from _wrong_counts(settings, lambda _: [(name,) for name in _PAIRS], (2,) * len(_PAIRS))
    named = settings.find("interface_name")
    if named is not None and named.value and named.value not in _INTERFACES:
        message = f"unknown interface `{named.value}` (available: {', '.join(_INTERFACES)})"
        yield DescriptionError(message, position=named.position)


def _missing_lengths(settings: Settings, driven: int) -> Iterator[DescriptionError]:
    """Yield an error for a steering controller without the track or the radius of its driven wheels."""
    try:
        track, radius = track_and_radius(settings)
    except DescriptionError:
        return  # Reported with the flags.
    for names in (track, radius) if driven == 2 else (radius,):
        if all(settings.find(name) is None for name in names):
            try:
                settings.text(names[0])
            except DescriptionError as error:
                yield error


def _wrong_counts(
    settings: Settings, names_of: Callable[[Settings], Sequence[tuple[str, ...]]], counts: Sequence[int]
) -> Iterator[DescriptionError]:
    """Yield an error for each list of joints of another length than its controller needs.

    Args:
        settings: parameters of the controller.
        names_of: function that returns the names of each list, the first for messages.
        counts: number of joints of each list.
    """
    try:
        lists = names_of(settings)
    except DescriptionError:
        return  # Reported with the flags.
    for names, count in zip(lists, counts, strict=True):
        written = next((each for each in names if settings.find(each) is not None), names[0])
        try:
            found = settings.texts(written)
        except DescriptionError as error:
            if written not in _READERS:
                yield error
            continue
        if len(found) != count and (found or len(names) > 1):
            message = f"`{names[0]}` names {len(found)} joints; this controller needs {count}"
            yield DescriptionError(message, position=settings.group(names[0]).place)


def traction_and_steering(settings: Settings) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return the names of the parameters for the traction and the steering joints in ROS 2, and those in Humble.

    Raises:
        DescriptionError: `front_steering` is neither true nor false.
    """
    rear, front = ("rear", "front") if settings.flag("front_steering", True) else ("front", "rear")
    return ("traction_joints_names", f"{rear}_wheels_names"), ("steering_joints_names", f"{front}_wheels_names")


def track_and_radius(settings: Settings) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of the parameters for the track and for the radius of the driven wheels in any ROS 2 release.

    Raises:
        DescriptionError: `front_steering` is neither true nor false.
    """
    rear = "rear" if settings.flag("front_steering", True) else "front"
    radius = ("traction_wheels_radius", "traction_wheel_radius", f"{rear}_wheels_radius", f"{rear}_wheel_radius")
    return ("traction_track_width", f"{rear}_wheel_track", "wheel_track"), radius


def sign_defect(limit: str, value: float, sign: int) -> str | None:
    """Return why diff_drive_controller refuses the sign of a limit; None if it accepts it."""
    wanted = "negative" if sign > 0 else "positive"
    return f"`{limit}` is {value:g}; it must not be {wanted}" if value * sign < 0.0 else None
