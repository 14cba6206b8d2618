"""Interactive markers of visualization_msgs: poses that a page moves by the handles of their controls.

A server publishes changes on ``NAME/update``. It sends all markers on ``NAME/update_full`` (ROS 1) or as the response
of the service ``NAME/get_interactive_markers`` (ROS 2), and receives the actions of the page on ``NAME/feedback``
(https://github.com/ros-visualization/interactive_markers).
"""

from collections.abc import Callable
from typing import Any

from urdfkit.app.simulation.displays.drawings import Item, finite, seven, unit_quaternion
from urdfkit.app.simulation.displays.markers import drawn_marker

UPDATE, INIT = "visualization_msgs/msg/InteractiveMarkerUpdate", "visualization_msgs/msg/InteractiveMarkerInit"
SERVICE = "visualization_msgs/srv/GetInteractiveMarkers"
KEEP_ALIVE = 0
RECENT = 100
"""Number of updates that are kept until all markers arrive."""
MOST = 500
"""Maximum number of interactive markers of a topic."""


def init_topic(update: str) -> str:
    """Return the topic with all markers of a server, for that of its updates."""
    return f"{update.rpartition('/')[0]}/update_full"


class InteractiveMarkerStore:
    """The interactive markers of one server.

    Args:
        mesh: function that returns the name of the mesh at a URI for the page; it raises `UrdfkitError`.

    Attributes:
        changes: number of changes.
        fault: why a mesh is not drawn; empty if all are.
        is_stale: whether an update was lost, so that all markers are to be requested again.
    """

    def __init__(self, mesh: Callable[[str], str]) -> None:
        self._mesh = mesh
        self._kept: dict[str, tuple[str, Item]] = {}
        self._number: int | None = None  # of the last message
        self._recent: list[Any] = []  # the last updates
        self.changes, self.fault, self.is_stale = 0, "", False

    def take(self, message: Any) -> None:
        """Apply an InteractiveMarkerUpdate, or an InteractiveMarkerInit or response, which contain all markers.

        A server numbers its updates. A response contains the updates up to its number; those after it, which may have
        arrived before the response, are applied again. A ROS 1 server sends all markers after each update.
        """
        if not hasattr(message, "erases"):
            is_response = hasattr(message, "sequence_number")
            number = int(message.sequence_number if is_response else message.seq_num)
            self._recent = [update for update in self._recent if is_response and update.seq_num > number]
            self._number, self.is_stale = int(self._recent[-1].seq_num) if self._recent else number, False
            self._kept.clear()
            for each in (message, *self._recent):
                self._apply(each)
            return
        before, self._number = self._number, int(message.seq_num)
        if before is not None and self._number < before:  # the server has started again
            self._recent.clear()
        next_number = before if message.type == KEEP_ALIVE or before is None else before + 1
        self.is_stale |= before is not None and self._number not in (before, next_number)
        if message.type == KEEP_ALIVE or (self._number and self._number == before):
            return
        self._recent = [*self._recent[1 - RECENT :], message]
        self._apply(message)

    def _apply(self, message: Any) -> None:
        self.changes += 1
        for name in getattr(message, "erases", ()):
            self._kept.pop(name, None)
        for marker in message.markers:
            if len(self._kept) < MOST or marker.name in self._kept:
                self._kept[marker.name] = marker.header.frame_id, self._item(marker)
        for moved in getattr(message, "poses", ()):
            if moved.name in self._kept:
                frame, item = self._kept[moved.name]
                frame = moved.header.frame_id or frame
                self._kept[moved.name] = frame, {**item, "pose": seven(moved.pose), "frame": frame}

    def groups(self) -> list[tuple[str, list[Item]]]:
        """Return frame and items of the markers."""
        return [(frame, [item]) for frame, item in self._kept.values()]

    def _item(self, marker: Any) -> Item:
        controls = []
        for control in marker.controls:
            drawn: list[Item] = []
            for each in control.markers:
                found, fault = drawn_marker(each, self._mesh)
                self.fault = fault or self.fault
                drawn += found
            turn = unit_quaternion(control.orientation)
            values = {"name": control.name, "mode": int(control.interaction_mode), "turn": turn, "items": drawn}
            controls.append({**values, "orientation": int(control.orientation_mode)})
        menu = [[int(entry.id), str(entry.title)[:80]] for entry in marker.menu_entries]
        place = {"frame": marker.header.frame_id, "pose": seven(marker.pose), "size": finite(marker.scale) or 1.0}
        return {"controls": controls, "name": marker.name, "menu": menu, **place}
