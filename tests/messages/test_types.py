import math

import numpy as np
import pytest

from urdfkit.errors import UsageError
from urdfkit.messages import (
    JOINT_STATE,
    TF,
    TWIST,
    from_fields,
    full_type_name,
    message_type,
    stamp,
    transform,
    twist,
    typestore,
)
from urdfkit.messages.conversion import LONG, cdr_parts


def test_type_names() -> None:
    assert full_type_name("geometry_msgs/Twist") == full_type_name("geometry_msgs/msg/Twist") == TWIST
    with pytest.raises(UsageError, match="did you mean `geometry_msgs/msg/Twist`"):
        message_type("geometry_msgs/Twits")


@pytest.mark.parametrize(("t", "sec", "nanosec"), [(0.0, 0, 0), (1.5, 1, 500_000_000), (2.9999999999, 3, 0)])
def test_stamps_are_rounded_to_the_nanosecond(t: float, sec: int, nanosec: int) -> None:
    assert (stamp(t).sec, stamp(t).nanosec) == (sec, nanosec)


def test_fields_by_name_and_in_order_the_others_zero() -> None:
    message = from_fields("geometry_msgs/Twist", {"linear": {"x": 0.5}, "angular": [0, 0, 1]})
    assert message == twist((0.5, 0, 0), (0, 0, 1))
    assert from_fields(TWIST, None) == twist((0, 0, 0), (0, 0, 0))


def test_nested_messages_and_lists() -> None:
    states = from_fields(JOINT_STATE, {"header": {"frame_id": "x"}, "name": ["a"], "position": [1, 2]})
    assert states.header.frame_id == "x"
    assert states.name == ["a"]
    np.testing.assert_array_equal(states.position, [1.0, 2.0])
    assert states.position.dtype == np.float64
    links = from_fields(TF, {"transforms": [{"child_frame_id": "c", "transform": {"translation": {"z": 2}}}]})
    assert links.transforms[0].transform.translation.z == 2.0
    pose = from_fields("geometry_msgs/PoseWithCovariance", None)
    assert pose.covariance.shape == (36,)


@pytest.mark.parametrize(
    ("written", "sec", "nanosec"),
    [
        ({"secs": 2, "nsecs": 5}, 2, 5),
        ({"sec": 2, "nanosec": 5}, 2, 5),
        ({"secs": 2}, 2, 0),
        (2, 2, 0),
        (2.5, 2, 500_000_000),
        (0.3, 0, 300_000_000),
        ({"sec": 1.25}, 1, 250_000_000),
        (-0.5, -1, 500_000_000),
        (1.9999999999, 2, 0),
        ([2, 5], 2, 5),
        (None, 0, 0),
    ],
)
def test_times_as_in_ros_1_and_in_seconds(written: object, sec: int, nanosec: int) -> None:
    trajectory = {"points": [{"time_from_start": written}], "header": {"seq": 7, "frame_id": "x"}}
    message = from_fields("trajectory_msgs/JointTrajectory", trajectory)
    duration = message.points[0].time_from_start
    assert (duration.sec, duration.nanosec, message.header.frame_id) == (sec, nanosec, "x")


def test_durations_are_32_bits_of_seconds() -> None:
    point = {"time_from_start": -(2**31)}
    assert from_fields("trajectory_msgs/JointTrajectoryPoint", point).time_from_start.sec == -(2**31)
    for seconds in (-(2**31) - 1, 2**31):
        with pytest.raises(UsageError, match="is out of range for builtin_interfaces/msg/Duration"):
            from_fields("trajectory_msgs/JointTrajectoryPoint", {"time_from_start": seconds})


@pytest.mark.parametrize(
    ("written", "reported"),
    [
        ({"secs": 2, "sec": 3}, "sets the same field twice"),
        ({"sec": 2.5, "nanosec": 3}, "sets the fraction of a second twice"),
        ({"scs": 2}, "did you mean `sec`?"),
        (-1, "`-1` is out of range for builtin_interfaces/msg/Time"),
        (1e10, "is out of range for builtin_interfaces/msg/Time: seconds, at most 2147483647"),
        (True, "write its fields, sec, nanosec"),
        ("2", "write its fields, sec, nanosec"),
    ],
)
def test_times_that_are_none(written: object, reported: str) -> None:
    with pytest.raises(UsageError) as caught:
        from_fields("std_msgs/Header", {"stamp": written})
    assert reported in str(caught.value)


@pytest.mark.parametrize(
    ("fields", "reported"),
    [
        ({"linear": {"w": 1}}, "no field `w` in geometry_msgs/msg/Vector3"),
        ({"linaer": {}}, "did you mean `linear`?"),
        ({"linear": {"x": "fast"}}, "field `x` of geometry_msgs/msg/Vector3 is `fast`; it must be float64"),
        ("text", "write its fields, linear, angular"),
        ({"linear": [1, 2]}, "write its fields, x, y, z"),
    ],
)
def test_wrong_fields(fields: object, reported: str) -> None:
    with pytest.raises(UsageError) as caught:
        from_fields(TWIST, fields)
    assert reported in str(caught.value)


@pytest.mark.parametrize(
    ("type", "value", "reported"),
    [
        (
            "Int32",
            2**40,
            "field `data` of std_msgs/msg/Int32 is 1099511627776; it must be int32, -2147483648 to 2147483647",
        ),
        ("UInt8", -1, "it must be uint8, 0 to 255"),
        ("Int32", 1.5, "field `data` of std_msgs/msg/Int32 is `1.5`; it must be int32"),
        ("Int32", math.inf, "field `data` of std_msgs/msg/Int32 is `inf`; it must be int32"),
        ("Bool", "false", "field `data` of std_msgs/msg/Bool is `false`; it must be bool"),
        (
            "UInt8MultiArray",
            [1, 256],
            "field `data` of std_msgs/msg/UInt8MultiArray is 256; it must be uint8, 0 to 255",
        ),
        ("String", "\ud800", r"field `data` of std_msgs/msg/String is '\ud800', which is not Unicode"),
    ],
)
def test_values_that_cannot_be_encoded(type: str, value: object, reported: str) -> None:
    with pytest.raises(UsageError) as caught:
        from_fields(f"std_msgs/{type}", {"data": value})
    assert reported in str(caught.value)


def test_transforms() -> None:
    link = transform(1.0, "odom", "base", (1, 2, 3), (0, 0, 0, 1))
    assert (link.header.frame_id, link.child_frame_id, link.transform.translation.y) == ("odom", "base", 2.0)


@pytest.mark.parametrize("size", [0, 7, LONG, LONG + 1, LONG + 6, 3 * LONG + 7])
@pytest.mark.parametrize("kind", ["Image", "CompressedImage", "PointCloud2"])
def test_parts_of_cdr_are_the_whole_message(kind: str, size: int) -> None:
    name = f"sensor_msgs/msg/{kind}"
    message = from_fields(name, {"header": {"frame_id": "x" * (size % 5)}})
    message.data = np.arange(size).astype(np.uint8)
    if kind == "PointCloud2":
        message.is_dense = True
    parts = cdr_parts(message, name)
    assert b"".join(parts) == bytes(typestore().serialize_cdr(message, name))
    assert (len(parts) > 1) == (size >= LONG)
