"""Messages of ROS 1: checksums that the ROS 1 distributions publish, and fields that ROS 2 names otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.bridges.node.node import UnknownTypeError
from urdfkit.bridges.ros1.environment import bind_host, master_uri, own_host
from urdfkit.bridges.ros1.ros1_types import decode, definition, encode, full_name, register, service_checksum
from urdfkit.cli import main
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields

CHECKSUMS = {  # as `rosmsg md5` of Noetic prints them
    "std_msgs/msg/String": "992ce8a1687cec8c8bd883ec73ca41d1",
    "sensor_msgs/msg/LaserScan": "90c7ef2dc6895d81024acba2ac42f369",
    "sensor_msgs/msg/CameraInfo": "c9a58c1b0b154e0e6da7578cb991d214",
    "tf2_msgs/msg/TFMessage": "94810edda583a504dfda3829e70d7eec",
    "control_msgs/msg/FollowJointTrajectoryActionGoal": "cff5c1d533bf2f82dd0138d57f4304bb",
    "control_msgs/msg/FollowJointTrajectoryActionResult": "c4fb3b000dc9da4fd99699380efcc5d9",
    "control_msgs/msg/JointTrajectoryControllerState": "10817c60c2486ef6b33e97dcd87f4474",
    "nav_msgs/msg/Odometry": "cd5e73d190d741a2f92e81eda573aca7",
}


@pytest.mark.parametrize("type", CHECKSUMS)
def test_checksums_are_those_of_ros_1(type: str) -> None:
    assert definition(type).checksum == CHECKSUMS[type]
    assert definition(type).name == type.replace("/msg/", "/")


def test_fields_that_ros_2_renamed_are_converted() -> None:
    type = "sensor_msgs/msg/CameraInfo"
    message = from_fields(type, {"header": {"frame_id": "camera"}, "width": 4, "k": [float(k) for k in range(9)]})
    back = decode(encode(message, type), type)
    assert (back.header.frame_id, back.width) == ("camera", 4)
    assert np.array_equal(back.k, message.k)


def test_an_unknown_type_is_learned_from_its_publisher() -> None:
    with pytest.raises(UnknownTypeError, match="no definition of lab_msgs/msg/Arm"):
        definition("lab_msgs/msg/Arm")
    text = f"std_msgs/Header header\nlab_msgs/Part part\n{'=' * 80}\nMSG: lab_msgs/Part\nfloat32[] Values\nstring name"
    register("lab_msgs/msg/Arm", text)
    message = from_fields("lab_msgs/msg/Arm", {"part": {"Values": [1.5, 2.5], "name": "wrist"}})
    back = decode(encode(message, "lab_msgs/msg/Arm"), "lab_msgs/msg/Arm")
    assert (back.part.name, list(back.part.Values)) == ("wrist", [1.5, 2.5])


def test_services_and_names() -> None:
    assert service_checksum("std_srvs/srv/Empty") == "d41d8cd98f00b204e9800998ecf8427e"
    assert full_name("tf/tfMessage") == "tf2_msgs/msg/TFMessage"
    assert full_name("std_srvs/Empty", "srv") == "std_srvs/srv/Empty"


def test_variables_of_ros_1() -> None:
    assert master_uri({}) == "http://localhost:11311"
    assert master_uri({"ROS_MASTER_URI": "http://robot:11311"}) == "http://robot:11311"
    for text in ("robot:11311", "http://robot", "https://robot:1"):
        with pytest.raises(UsageError, match="use http://HOST:PORT"):
            master_uri({"ROS_MASTER_URI": text})
    assert (own_host({}), bind_host({})) == ("127.0.0.1", "127.0.0.1")
    assert bind_host({"ROS_IP": "10.0.0.3"}) == "0.0.0.0"


def test_without_a_master_one_line_says_so(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9")
    assert main(["sim", "run", "simpleton", "--for", "0.01", "--ros1"]) == 2
    line = capsys.readouterr().err.splitlines()[-1]
    assert line.startswith("urdfkit: no ROS master at http://127.0.0.1:9: start roscore, or set ROS_MASTER_URI")
