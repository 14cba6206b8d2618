"""Displays: topics that pages show in the 3-D view, the frames with their ages, and poses published with the mouse."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from urdfkit.app.simulation.displays.drawings import CLOUDS, KINDS, Item, drawing, options
from urdfkit.app.simulation.displays.frame_tree import FrameTree, seven_of
from urdfkit.app.simulation.displays.image_boxes import CAMERA_INFO, IMAGE, boxes, camera_info_topic
from urdfkit.app.simulation.displays.interactive_markers import INIT, UPDATE, InteractiveMarkerStore, init_topic
from urdfkit.app.simulation.displays.marker_meshes import MarkerMeshes
from urdfkit.app.simulation.displays.markers import MARKER, MARKERS, MarkerStore
from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.bus import Topic
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import UsageError
from urdfkit.linear_algebra import Array, matmul
from urdfkit.messages import from_fields
from urdfkit.messages.vision import DETECTIONS_2D
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.page_requests import Request, Schema, choice, number, numbers
from urdfkit.view.server.server import Server

DISPLAY, FRAMES = "display:", "frames"
"""Key of a display, with its topic and after another colon the field that colours points; key of the frames."""
TYPES = (*KINDS, *CLOUDS, MARKER, MARKERS, UPDATE)
"""Types of messages that have a display."""
FIXED = ("nav_msgs/msg/OccupancyGrid", "nav_msgs/msg/GridCells", "nav_msgs/msg/Path")
"""Types whose drawings follow their frame after the message."""
PERIOD = 0.1
"""Minimum seconds between two messages of a display."""
SHARE = 0.2
"""Maximum share of the time for the drawings."""
GLOBAL_FRAMES = ("map", "odom")
"""Frames of published poses, the first that exists; else that of the page, ``world``."""
POSES = {
    "goal": ("/goal_pose", "geometry_msgs/msg/PoseStamped"),
    "estimate": ("/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
}
"""Tool → topic and type; those of RViz, https://github.com/ros2/rviz, rviz_default_plugins/tools."""
VARIANCES = {0: 0.25, 7: 0.25, 35: 0.06853891909122467}
"""Covariance of a pose estimate, of RViz's tool: 0.5 m and 15° squared; index in the 6 × 6 matrix → value."""


class Displays(Feature):
    """The displays of all pages. It needs a bus, the time, and the poses of the links only."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._frames: FrameTree | None = None
        self._shown: dict[str, _Display] = {}
        self._free = 0.0
        self._meshes: MarkerMeshes | None = None

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        values = {"as": choice(*POSES), "position": numbers(2, bound=1e4, unit="m"), "yaw": number(-7, 7, unit="rad")}
        return {"publish_pose": (Schema(values), self._publish_pose)}

    def show(self) -> None:
        """Publish the types of messages that have a display, with its options."""
        self.server.publish_latched("display_types", types={kind: options(kind) for kind in TYPES})

    @property
    def frames(self) -> FrameTree:
        """The transforms, followed since the first use."""
        if self._frames is None:
            self._frames = FrameTree(self.simulator.bus, lambda: self.simulator.t)
        return self._frames

    def links(self) -> dict[str, Array]:
        """Return link → pose in the world, shape (4, 4)."""
        simulator = self.simulator
        return dict(zip(simulator.kinematics.link_names, pose_matrices(simulator.link_poses()), strict=True))

    def pose(self, frame: str, links: Mapping[str, Array]) -> Array | None:
        """Return the pose of a frame in the world of the page, shape (4, 4); None if nothing connects it."""
        return self.frames.pose(frame, links)

    def mesh(self, uri: str) -> str:
        """Return the name of the mesh at a URI for the page.

        Raises:
            ResourceError: it is not a mesh file of a package.
        """
        if self._meshes is None:
            packages = self.simulator.kinematics.robot.packages or Packages()
            self._meshes = MarkerMeshes(packages, self.server.geometries)
        return self._meshes.name(uri)

    def request_markers(self, topic: str, take: Callable[[Any], None]) -> None:
        """Request all interactive markers of a server for `take`, where the topics come from a graph with services.

        Args:
            topic: of its updates.
            take: receives the response.
        """

    def tick(self) -> None:
        """Subscribe to the wanted topics, and send their drawings."""
        keys = self.server.hub.subscribed_keys
        if FRAMES in keys and self.is_due(0.5):
            self.server.send_to_subscribers(FRAMES, FRAMES, rows=self.frames.rows())
        wanted = {key for key in keys if key.startswith(DISPLAY)}
        for key in [key for key in self._shown if key not in wanted]:
            self._shown.pop(key).close()
        if not wanted:
            return
        topics = {topic.name: topic for topic in self.simulator.bus.topics} if wanted - self._shown.keys() else {}
        for key in wanted - self._shown.keys():
            name, _, field = key.removeprefix(DISPLAY).partition(":")
            if (topic := topics.get(name)) is not None and topic.type in (*TYPES, DETECTIONS_2D):
                self._shown[key] = _Display(self, key, topic, field)
        if (now := self.clock()) >= self._free:
            for display in self._shown.values():
                display.send(now)
            self._free = now + (self.clock() - now) / SHARE

    def forget(self) -> None:
        """Begin again after a reset."""
        for display in self._shown.values():
            display.close()
        self._shown.clear()
        if self._frames is not None:
            self._frames.close()
            self._frames = None

    def _publish_pose(self, request: Request) -> Done:
        (x, y), yaw = request.values["position"], request.values["yaw"]
        links = self.links()
        candidates = ((name, self.frames.pose(name, links)) for name in GLOBAL_FRAMES)
        frame, origin = next(((name, pose) for name, pose in candidates if pose is not None), ("world", np.eye(4)))
        pose = np.eye(4)
        pose[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
        pose[:2, 3] = x, y
        topic, kind = POSES[request.values["as"]]
        message = pose_message(kind, seven_of(matmul(np.linalg.inv(origin), pose)), frame, self.simulator.t)
        try:
            self.simulator.bus.publish(topic, kind, message)
        except UsageError as error:
            raise UsageError(f"{error}; the tool publishes {kind}") from error
        return {"topic": topic, "frame": frame}


def pose_message(kind: str, pose: Sequence[float], frame: str, t: float) -> Any:
    """Return the message of a tool.

    Args:
        kind: its type, one of `POSES`.
        pose: x y z [m] and quaternion x y z w in the frame.
        frame: name of the frame.
        t: time of the stamp [s].
    """
    place: dict[str, Any] = {
        "position": dict(zip("xyz", pose[:3], strict=True)),
        "orientation": dict(zip("xyzw", pose[3:], strict=True)),
    }
    if kind == POSES["estimate"][1]:
        place = {"pose": place, "covariance": [VARIANCES.get(k, 0.0) for k in range(36)]}
    stamp = {"sec": int(t), "nanosec": int(t % 1 * 1e9)}
    return from_fields(kind, {"header": {"stamp": stamp, "frame_id": frame}, "pose": place})


class _Display:
    """The display of one topic: its last message, and where the frame was when it came."""

    def __init__(self, displays: Displays, key: str, topic: Topic, field: str) -> None:
        self._displays, self._key, self._topic, self._field = displays, key, topic, field
        simulator = displays.simulator
        self._markers: MarkerStore | InteractiveMarkerStore | None = None
        if topic.type in (MARKER, MARKERS):
            self._markers = MarkerStore(lambda: simulator.t, displays.mesh)
        elif topic.type == UPDATE:
            self._markers = InteractiveMarkerStore(displays.mesh)
        self._groups: list[tuple[str, Array | None, list[Item]]] = []
        self._waiting: tuple[Any, Array | None] | None = None
        self._sent: tuple[int, list[Any]] | None = None
        self._pages: frozenset[Any] = frozenset()  # that have the drawing
        self._size: tuple[int, int] | None = None  # of the image of boxes, whose topic is the field
        self._due = 0.0
        displays.frames.rows()  # follow the transforms from now on
        topics = [topic]
        if topic.type == UPDATE:
            topics = [
                each for each in simulator.bus.topics if each.name == init_topic(topic.name) and each.type == INIT
            ]
            topics.append(topic)
            displays.request_markers(topic.name, self._take)
        for each in topics:
            if each.count and each.latest is not None:
                self._take(each.latest)
        self._subscriptions = [simulator.bus.subscribe(each.name, each.type, self._take) for each in topics]
        if topic.type == DETECTIONS_2D:
            sources = ((camera_info_topic(field), CAMERA_INFO), (field, IMAGE))
            image = next((each for each in simulator.bus.topics if (each.name, each.type) in sources), None)
            if image is not None:
                self._subscriptions.append(simulator.bus.subscribe(image.name, image.type, self._measure))

    def _measure(self, message: Any) -> None:
        self._size = int(message.width), int(message.height)

    def _take(self, message: Any) -> None:
        if self._markers is not None:
            self._markers.take(message)
            return
        frame = message.header.frame_id
        is_flat = self._topic.type == DETECTIONS_2D
        self._waiting = message, np.eye(4) if is_flat else self._displays.pose(frame, self._displays.links())

    def send(self, now: float) -> None:
        """Send the drawing, if it has changed."""
        if now < self._due:
            return
        self._due = now + PERIOD
        changed, fault = False, None
        links = self._displays.links()
        if self._markers is not None:
            if isinstance(self._markers, InteractiveMarkerStore) and self._markers.is_stale:
                self._markers.is_stale = False
                self._displays.request_markers(self._topic.name, self._take)
            before = self._sent[0] if self._sent is not None else -1
            groups = self._markers.groups()
            changed = before != self._markers.changes
            self._groups = [(frame, self._displays.pose(frame, links), items) for frame, items in groups]
        elif self._waiting is not None:
            (message, pose), self._waiting, changed = self._waiting, None, True
            frame = message.header.frame_id
            try:
                is_flat = self._topic.type == DETECTIONS_2D
                drawn = boxes(message, self._size) if is_flat else drawing(message, self._topic.type, self._field)
                self._groups = [(frame, pose, drawn)]
            except (ArithmeticError, LookupError, TypeError, ValueError) as error:  # its sizes contradict its data
                self._groups, fault = [], f"a message cannot be drawn: {error}"
        elif self._topic.type in FIXED:
            self._groups = [(frame, self._displays.pose(frame, links), items) for frame, _, items in self._groups]
        poses = [None if pose is None else [round(x, 6) for x in seven_of(pose)] for _, pose, _ in self._groups]
        pages = self._displays.server.hub.subscribers(self._key)
        if self._sent is not None:  # new pages and newly connected frames need the whole drawing
            earlier, current = ([pose is not None for pose in each] for each in (self._sent[1], poses))
            changed |= current != earlier or not pages <= self._pages
        self._pages = pages
        if not changed and (self._sent is None or poses == self._sent[1]):
            return
        self._sent = self._markers.changes if self._markers is not None else 0, poses
        lost = sorted({frame for frame, pose, _ in self._groups if pose is None})
        if lost:
            fault = f"no transform from frame {', '.join(lost)} to a link of the robot"
        if self._markers is not None:
            fault = fault or self._markers.fault or None
        shown = [
            {"pose": pose, "items": items}
            for pose, (_, _, items) in zip(poses, self._groups, strict=True)
            if pose is not None
        ]
        values: dict[str, Any] = {"groups": shown} if changed else {"poses": [each["pose"] for each in shown]}
        server = self._displays.server
        server.send_to_subscribers(
            self._key, "display", source=self._key, fault=fault, time=self._displays.simulator.t, **values
        )

    def close(self) -> None:
        """Unsubscribe."""
        for subscription in self._subscriptions:
            subscription.close()
