"""Recordings that tests write, by rosbags in the formats of ROS 1 and ROS 2."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from urdfkit.bridges.bag_file import kept_message_types

STORES = {1: get_typestore(Stores.ROS1_NOETIC), 2: get_typestore(Stores.ROS2_JAZZY)}
if "tf2_msgs/msg/TFMessage" not in STORES[1].types:
    definition = "geometry_msgs/TransformStamped[] transforms"
    with kept_message_types():
        STORES[1].register(get_types_from_msg(definition, "tf2_msgs/msg/TFMessage"))
Written = tuple[str, float, Any]
"""Topic, time [s], message."""


class Messages:
    """Makes the messages of one version of ROS."""

    def __init__(self, ros: int) -> None:
        self.types = STORES[ros]
        self._ros = ros

    def make(self, kind: str, *fields: Any) -> Any:
        return self.types.types[kind](*fields)

    def header(self, t: float, frame: str = "") -> Any:
        stamp = self.make("builtin_interfaces/msg/Time", int(t), round((t % 1) * 1e9))
        return self.make("std_msgs/msg/Header", *([0] if self._ros == 1 else []), stamp, frame)

    def joints(self, t: float, positions: dict[str, float]) -> Any:
        empty = np.zeros(0)
        return self.make(
            "sensor_msgs/msg/JointState", self.header(t), list(positions), np.array([*positions.values()]), empty, empty
        )

    def transforms(self, t: float, *rows: tuple[str, str, Sequence[float]]) -> Any:
        """Return a TFMessage of parents, children and poses x y z and quaternions x y z w."""
        made = [
            self.make(
                "geometry_msgs/msg/TransformStamped",
                self.header(t, parent),
                child,
                self.make(
                    "geometry_msgs/msg/Transform",
                    self.make("geometry_msgs/msg/Vector3", *map(float, pose[:3])),
                    self.make("geometry_msgs/msg/Quaternion", *map(float, pose[3:])),
                ),
            )
            for parent, child, pose in rows
        ]
        return self.make("tf2_msgs/msg/TFMessage", made)


def write_bag(path: Path, messages: Sequence[Written]) -> Path:
    """Write messages to a .bag, .db3 or .mcap file; return its path, for .db3 that of the folder around it."""
    if path.suffix == ".bag":
        from rosbags.rosbag1 import Writer as Writer1

        types: Any = STORES[1]
        writer: Any = Writer1(path)
        serialize = types.serialize_ros1
    else:
        from rosbags.rosbag2 import StoragePlugin, Writer

        types = STORES[2]
        plugin = StoragePlugin.MCAP if path.suffix == ".mcap" else StoragePlugin.SQLITE3
        path = path.with_suffix("")
        writer = Writer(path, version=9, storage_plugin=plugin)
        serialize = types.serialize_cdr
    with writer:
        connections: dict[str, Any] = {}
        for topic, t, message in messages:
            kind = message.__msgtype__
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=types)
            writer.write(connections[topic], round(t * 1e9), serialize(message, kind))
    return path
