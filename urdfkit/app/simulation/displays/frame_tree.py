"""The frames of a simulation or recording: transforms of ``/tf`` and ``/tf_static``, joined with the robot's links."""

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from urdfkit.bus import Bus, Subscription
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.state.quaternion import from_matrix

TOPICS = {"/tf": False, "/tf_static": True}
"""Topic of transforms → whether they do not change."""
KIND = "tf2_msgs/msg/TFMessage"
WORLD = ("", "world")
"""Names of the frame of the page, unless the transforms have a frame of this name."""


@dataclass(slots=True)
class _Edge:
    parent: str
    matrix: Array
    stamp: float
    received: float
    static: bool


class FrameTree:
    """The last transform of each frame.

    Args:
        bus: carries the transforms, from now on until `close`.
        now: the time of the simulation [s].
    """

    def __init__(self, bus: Bus, now: Callable[[], float]) -> None:
        self._now = now
        self._edges: dict[str, _Edge] = {}
        self._children: dict[str, set[str]] = {}
        self._subscriptions: list[Subscription] = []
        for topic, static in TOPICS.items():
            if (found := next((each for each in bus.topics if each.name == topic), None)) is None:
                continue  # none is advertised for it
            if found.latest is not None:
                self._take(found.latest, static=static)
            self._subscriptions.append(bus.subscribe(topic, KIND, partial(self._take, static=static)))

    def close(self) -> None:
        """Stop following the topics."""
        for subscription in self._subscriptions:
            subscription.close()

    def _take(self, message: Any, *, static: bool) -> None:
        for each in message.transforms:
            t, q = each.transform.translation, each.transform.rotation
            child, parent = each.child_frame_id.lstrip("/"), each.header.frame_id.lstrip("/")
            matrix = pose_matrices(np.array([[t.x, t.y, t.z, q.x, q.y, q.z, q.w]]))[0]
            if child in self._edges and self._edges[child].parent != parent:
                self._children[self._edges[child].parent].discard(child)
            stamp = each.header.stamp.sec + 1e-9 * each.header.stamp.nanosec
            self._edges[child] = _Edge(parent, matrix, stamp, self._now(), static)
            self._children.setdefault(parent, set()).add(child)

    def pose(self, frame: str, links: Mapping[str, Array]) -> Array | None:
        """Return the pose of a frame in the world of the page, shape (4, 4); None if nothing connects it.

        Args:
            frame: its name.
            links: link → pose in the world, shape (4, 4).
        """
        wanted = frame.lstrip("/")
        paths, seen = deque([(wanted, np.eye(4))]), {wanted}
        while paths:
            name, path = paths.popleft()
            if name in links:
                found: Array = matmul(links[name], path)
                return found
            steps = []
            if (edge := self._edges.get(name)) is not None:
                steps.append((edge.parent, matmul(edge.matrix, path)))
            for child in self._children.get(name, ()):
                steps.append((child, matmul(np.linalg.inv(self._edges[child].matrix), path)))
            for other, matrix in steps:
                if other not in seen:
                    seen.add(other)
                    paths.append((other, matrix))
        return np.eye(4) if wanted in WORLD else None

    def rows(self) -> list[dict[str, Any]]:
        """Return name, parent, age [s] and whether it is static of each transform, for the page."""
        now = self._now()
        return [
            {"name": name, "parent": edge.parent, "age": round(now - edge.received, 3), "static": edge.static}
            for name, edge in sorted(self._edges.items())
        ]


def seven_of(matrix: Array) -> list[float]:
    """Return x y z [m] and quaternion x y z w of a pose matrix."""
    return [*matrix[:3, 3].tolist(), *from_matrix(matrix[:3, :3]).tolist()]
