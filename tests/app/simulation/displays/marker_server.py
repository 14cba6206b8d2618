"""A server of interactive markers that behaves as that of the package interactive_markers."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

from urdfkit.bus import Bus
from urdfkit.messages import from_fields

KIND = "visualization_msgs/msg/InteractiveMarker"
KEEP_ALIVE, UPDATE = 0, 1
POSE_UPDATE = 1


class MarkerServer:
    """Collects changes, and publishes them with the next number (interactive_marker_server.cpp).

    Args:
        bus: of the topics ``NAME/update`` and ``NAME/feedback``.
        name: namespace of the topics.
        is_ros1: whether all markers are published on ``NAME/update_full`` after each change; a server of ROS 2 sends
            them as the response of a service.
    """

    def __init__(self, bus: Bus, name: str, *, is_ros1: bool = True) -> None:
        self.bus, self.name, self.is_ros1 = bus, name, is_ros1
        self.number = 0
        self.markers: dict[str, dict[str, Any]] = {}
        self.feedback: list[Any] = []
        self._changed: dict[str, str] = {}  # name → insert, pose or erase
        bus.subscribe(f"{name}/feedback", f"{KIND}Feedback", self._take)
        self._publish_all()

    def insert(self, marker: dict[str, Any]) -> None:
        self.markers[marker["name"]] = deepcopy(marker)
        self._changed[marker["name"]] = "insert"

    def set_pose(self, name: str, pose: dict[str, Any], frame: str = "") -> None:
        """Set a pose; a frame other than that of the marker replaces it."""
        marker = self.markers[name]
        marker["pose"] = pose
        marker["header"] = {"frame_id": frame or marker["header"]["frame_id"]}
        self._changed.setdefault(name, "pose")

    def erase(self, name: str) -> None:
        del self.markers[name]
        self._changed[name] = "erase"

    def apply_changes(self, *, lost: bool = False) -> None:
        """Publish the changes; `lost`: they do not arrive."""
        if not self._changed:
            return
        self.number += 1
        parts: dict[str, list[Any]] = {"insert": [], "pose": [], "erase": []}
        for name, change in self._changed.items():
            parts[change].append(name)
        self._changed = {}
        poses = [{key: self.markers[name][key] for key in ("header", "pose", "name")} for name in parts["pose"]]
        if lost:
            return
        self._publish(
            "Update", "update", type=UPDATE, markers=[self.markers[name] for name in parts["insert"]],
            poses=poses, erases=parts["erase"],
        )  # fmt: skip
        self._publish_all()

    def keep_alive(self) -> None:
        """Publish the number, as a timer does every half second."""
        self._publish("Update", "update", type=KEEP_ALIVE)

    def response(self) -> Any:
        """Return the response of the service at this moment."""
        fields = {"sequence_number": self.number, "markers": list(self.markers.values())}
        return from_fields("visualization_msgs/srv/GetInteractiveMarkers_Response", fields)

    def _publish_all(self) -> None:
        if self.is_ros1:
            self._publish("Init", "update_full", markers=list(self.markers.values()))

    def _publish(self, kind: str, topic: str, **fields: Any) -> None:
        fields = {"server_id": self.name, "seq_num": self.number, **fields}
        self.bus.publish(f"{self.name}/{topic}", f"{KIND}{kind}", from_fields(f"{KIND}{kind}", fields))

    # The pose of feedback becomes that of the marker, in its frame; callbacks of servers then apply the changes.
    def _take(self, message: Any) -> None:
        self.feedback.append(message)
        if message.event_type != POSE_UPDATE or message.marker_name not in self.markers:
            return
        pose = {
            part: {axis: getattr(getattr(message.pose, part), axis) for axis in axes}
            for part, axes in (("position", "xyz"), ("orientation", "xyzw"))
        }
        self.set_pose(message.marker_name, pose, message.header.frame_id)
        self.apply_changes()
