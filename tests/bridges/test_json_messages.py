import base64
import json
import math

import numpy as np
import pytest

from urdfkit.app.simulation.features.message_values import as_json
from urdfkit.bridges.json_messages import from_json, to_json
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields, message_type


def test_constants_are_no_fields() -> None:
    message = from_fields("actionlib_msgs/msg/GoalStatus", {"status": 3})
    fields = {"goal_id": {"stamp": {"sec": 0, "nanosec": 0}, "id": ""}, "status": 3, "text": ""}
    assert json.loads(to_json(message)) == as_json(message) == fields
    empty = from_fields("std_msgs/msg/Empty", None)
    assert json.loads(to_json(empty)) == as_json(empty) == {}


def test_bytes_are_base64_and_numbers_that_json_lacks_are_null() -> None:
    image = from_fields("sensor_msgs/msg/Image", {"height": 1, "width": 2, "encoding": "mono8", "data": [0, 255]})
    assert json.loads(to_json(image))["data"] == base64.b64encode(b"\x00\xff").decode()
    scan = from_fields("sensor_msgs/msg/LaserScan", {"ranges": [1.5, math.inf, math.nan]})
    written = json.loads(to_json(scan))
    assert written["ranges"] == [1.5, None, None]
    assert written["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}


def test_texts_are_escaped_and_lists_of_messages_are_objects() -> None:
    text = from_fields("std_msgs/msg/String", {"data": 'a"b\\\n\u2028é'})
    assert json.loads(to_json(text)) == {"data": 'a"b\\\n\u2028é'}
    path = from_fields("nav_msgs/msg/Path", {"poses": [{"pose": {"position": {"x": 2.0}}}]})
    assert json.loads(to_json(path))["poses"][0]["pose"]["position"] == {"x": 2.0, "y": 0.0, "z": 0.0}
    assert to_json(message_type("std_msgs/msg/Empty")()) == "{}"


@pytest.mark.parametrize("type", ["nav_msgs/msg/Odometry", "sensor_msgs/msg/JointState", "sensor_msgs/msg/CameraInfo"])
def test_a_message_survives_both_ways(type: str) -> None:
    message = from_fields(type, None)
    assert to_json(from_json(type, json.loads(to_json(message)))) == to_json(message)


def test_bytes_of_a_client_may_be_base64_or_numbers_also_inside_messages() -> None:
    as_text = from_json("sensor_msgs/Image", {"data": base64.b64encode(b"\x01\x02").decode()})
    as_list = from_json("sensor_msgs/Image", {"data": [1, 2]})
    assert np.array_equal(as_text.data, as_list.data)
    cloud = {"blob": {"data": "AQI="}}
    with pytest.raises(UsageError, match="no field `blob`"):
        from_json("sensor_msgs/Image", cloud)


@pytest.mark.parametrize(
    ("type", "fields", "reported"),
    [
        ("geometry_msgs/Twist", {"linear": {"x": "fast"}}, "must be float64"),
        ("geometry_msgs/Twist", {"speed": 1}, "no field `speed`"),
        ("geometry_msgs/Twits", {}, "no message type"),
        ("geometry_msgs/Twist", 3, "write its fields"),
        ("sensor_msgs/Image", {"data": "§"}, "not a sensor_msgs/msg/Image|not base64"),
        ("sensor_msgs/Image", {"data": [256]}, "it must be uint8, 0 to 255"),
        ("sensor_msgs/Image", {"height": 1.5e400}, "not a sensor_msgs/msg/Image|must be uint32"),
    ],
)
def test_wrong_messages_are_one_line(type: str, fields: object, reported: str) -> None:
    with pytest.raises(UsageError, match=reported) as raised:
        from_json(type, fields)
    assert "\n" not in str(raised.value)


def test_bytes_are_an_array_without_a_copy_of_each_and_null_is_not_a_number() -> None:
    image = from_json("sensor_msgs/msg/Image", {"data": base64.b64encode(bytes(range(256)) * 4).decode()})
    assert image.data.dtype == np.uint8
    assert image.data.tobytes() == bytes(range(256)) * 4
    scan = from_json("sensor_msgs/msg/LaserScan", {"ranges": [1.0, None]})
    assert np.isnan(scan.ranges[1])
