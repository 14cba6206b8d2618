"""Sensor views on the page of ``sim teleop``: points of lidars in the scene, and small images of cameras.

A sensor is read only while a page shows it and has received the last view; the sensor that has waited longest comes
first. Views use a limited share of the time, whatever the rates of the sensors. Cameras render a small image for the
page, so that the simulation never waits for a large one.
"""

import io
from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.bus import Topic
from urdfkit.messages.point_cloud import colors_of, read_points, scan_points
from urdfkit.sim.plugins.sensors.cameras.annotated_camera import GzSegmentationCamera
from urdfkit.sim.plugins.sensors.cameras.camera import Camera
from urdfkit.sim.plugins.sensors.cameras.camera_optics import IMAGE
from urdfkit.sim.plugins.sensors.cameras.depth_camera import GzDepthCamera
from urdfkit.sim.plugins.sensors.lidars.lidar import LASER_SCAN, Lidar
from urdfkit.sim.plugins.sensors.scene_sensor import SceneSensor
from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.websocket_messages import COLORED, PICTURE, POINTS
from urdfkit.view.server.server import Server

Array = NDArray[Any]

PERIOD = 0.1
"""Minimum seconds between two views of one sensor."""
SHARE = 0.25
"""Maximum share of the time for views."""
WIDTH = 320
"""Maximum width of an image on the page [px]."""
LARGE = 1280
"""Maximum width of an enlarged image [px]."""
ENLARGED = "large:"
"""Key of an enlarged image, with its topic."""
MOST_POINTS = 20_000
"""Maximum points of a scan on the page; larger scans are subsampled."""
CLOUDS = ("sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/PointCloud")
OPTICAL = np.array([[0.0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""Optical frame of a camera in the sensor's frame: z forward, x right, y down."""


@dataclass
class SensorView:
    """View of one topic.

    Attributes:
        topic: topic of the sensor.
        sensor: the sensor.
        large: the sensor for enlarged images.
        kind: `POINTS`, `COLORED` or `PICTURE`.
        exact: whether the colours are labels, which a JPEG would blur.
        due: earliest time of the next view [s of the clock].
        shown: number of messages at the last view.
    """

    topic: Topic
    sensor: SceneSensor
    large: SceneSensor
    kind: int
    exact: bool = False
    due: float = 0.0
    shown: int = 0

    @property
    def key(self) -> str:
        """Key of the stream."""
        return f"sensor:{self.topic.name}"

    def content(self, message: Any) -> bytes:
        """Return the view of a message."""
        if self.kind == PICTURE:
            return picture(message, exact=self.exact, width=LARGE)
        frame = self.sensor.viewpoint
        if isinstance(self.sensor, Camera) and not isinstance(self.sensor, GzDepthCamera):
            frame = frame @ OPTICAL
        return points(message, frame, colored=self.kind == COLORED)


class SensorViews:
    """Views of the lidars and cameras of a simulation.

    Args:
        simulator: the simulation.
        server: the page.
        clock: wall clock [s].
    """

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        self._simulator, self._server, self._clock = simulator, server, clock
        self._views: list[SensorView] = []
        self._revision = -1
        self._free = 0.0
        self._is_ready: Callable[[], bool] | None = None

    def begin_when(self, is_ready: Callable[[], bool]) -> None:
        """Show views only after `is_ready`, called in every iteration while there are sensors, has returned True."""
        self._is_ready = is_ready

    def find(self) -> bool:
        """Find the sensors, publish their list, and return whether there are any."""
        self._revision = self._simulator.world.revision
        self._views = []
        for robot in self._simulator.world.robots.values():
            for sensor in robot.plugins.sensors:
                if isinstance(sensor, SceneSensor):
                    sizes = (WIDTH, LARGE)
                    shown, large = [smaller(sensor, size) if isinstance(sensor, Camera) else sensor for size in sizes]
                    exact = isinstance(sensor, GzSegmentationCamera)
                    self._views += [SensorView(topic, shown, large, kind, exact) for topic, kind in _shown(sensor)]
        names = [
            {"topic": view.topic.name, "picture": view.kind == PICTURE, "camera": isinstance(view.sensor, Camera)}
            for view in self._views
        ]
        self._server.publish_latched("sensors", sensors=names)
        return bool(self._views)

    def prepare(self) -> None:
        """Render each camera once, so that the simulation does not wait for the first image."""
        for sensor in {id(view.sensor): view.sensor for view in self._views}.values():
            if isinstance(sensor, Camera):
                sensor.glimpse(self._simulator.t)

    def show(self) -> float:
        """Send the view of one sensor, if one is due; return the time spent [s]."""
        if self._simulator.world.revision != self._revision:
            self.find()
        if self._is_ready is not None:
            if not (self._views and self._is_ready()):
                return 0.0
            self._is_ready = None
            self.prepare()
        now = self._clock()
        if now < self._free:
            return 0.0
        waiting = [
            (k, each)
            for k, each in enumerate(self._views)
            if each.due <= now and each.topic.count != each.shown and self._server.hub.accepts(each.key)
        ]
        if not waiting:
            return 0.0
        first = min(waiting, key=lambda pair: pair[1].due)[1]
        together = [(k, each) for k, each in waiting if each.sensor is first.sensor]  # they share one rendering
        messages: dict[str, Callable[[], Any]] = {}
        enlarged = {f"{ENLARGED}{view.topic.name}" for _, view in together} & self._server.hub.subscribed_keys
        sensor = first.large if enlarged else first.sensor
        if isinstance(sensor, Camera):
            names = (topic.name for topic in sensor.topics)
            messages = dict(zip(names, sensor.glimpse(self._simulator.t), strict=False))
        for index, view in together:
            view.shown = view.topic.count
            message = messages[view.topic.name]() if messages else view.topic.latest
            if message is not None:
                self._server.sense(view.key, index, self._simulator.t, view.kind, view.content(message))
        cost = self._clock() - now
        for _, view in together:
            view.due = now + max(PERIOD, cost / SHARE)
        self._free = now + cost / SHARE
        return cost


def smaller(camera: Camera, width: int) -> Camera:
    """Return a copy of a camera with images of at most this width [px]."""
    smaller_camera = copy(camera)
    smaller_camera.imagers = []
    for imager in camera.imagers:
        lens = imager.optics.lens
        part = min(1.0, width / lens.width)
        small = replace(lens, width=round(part * lens.width), height=max(1, round(part * lens.height)))
        smaller_camera.imagers.append(replace(imager, optics=replace(imager.optics, lens=small)))
    smaller_camera.optics = smaller_camera.imagers[0].optics
    return smaller_camera


def _shown(sensor: SceneSensor) -> list[tuple[Topic, int]]:
    if isinstance(sensor, Lidar):
        return [(topic, POINTS) for topic in sensor.topics if topic.type in (LASER_SCAN, *CLOUDS)][:1]
    if isinstance(sensor, GzSegmentationCamera):
        return [(sensor.topics[0], PICTURE)]  # the others hold numbers, too dark to see
    kinds = {IMAGE: PICTURE, CLOUDS[0]: COLORED}
    return [(topic, kinds[topic.type]) for topic in sensor.topics if topic.type in kinds]


def points(message: Any, viewpoint: Array, *, colored: bool = False) -> bytes:
    """Return the points of a scan in the world [m], as little-endian float32.

    Args:
        message: a LaserScan, PointCloud2 or PointCloud in the coordinates of the sensor.
        viewpoint: pose of the sensor; shape (4, 4).
        colored: append red, green, blue and 255 to each point, one byte each; for a PointCloud2 with ``rgb``.
    """
    colors = None
    if hasattr(message, "ranges"):
        found = scan_points(message)
    elif hasattr(message, "data"):
        rows = read_points(message)
        found = np.stack([rows[axis] for axis in "xyz"], axis=-1).astype(float)
        if colored and "rgb" in rows.dtype.names:
            colors = colors_of(rows["rgb"])
            colors[:, 3] = 255
    else:
        found = np.array([(each.x, each.y, each.z) for each in message.points], dtype=float).reshape(-1, 3)
    finite = np.isfinite(found).all(axis=1)
    every = max(1, -(-int(finite.sum()) // MOST_POINTS))
    found = (found[finite][::every] @ viewpoint[:3, :3].T + viewpoint[:3, 3]).astype("<f4")
    if not colored:
        return bytes(found.tobytes())
    if colors is None:
        colors = np.full((len(finite), 4), 255, dtype=np.uint8)
    return bytes(np.concatenate([found.view(np.uint8).reshape(-1, 12), colors[finite][::every]], axis=1).tobytes())


def picture(message: Any, *, exact: bool = False, width: int = WIDTH) -> bytes:
    """Return an Image as a small JPEG; depths in grey, near ones bright.

    Args:
        message: the Image.
        exact: return a lossless WebP instead.
        width: maximum width [px].
    """
    from PIL import Image

    from urdfkit.app.simulation.image_files import png

    with Image.open(io.BytesIO(png(message))) as whole:
        small = whole
        if whole.mode not in ("RGB", "L"):
            depth = np.asarray(whole, dtype=float)
            valid = depth[depth > 0]
            far = float(valid.max()) if len(valid) else 1.0
            small = Image.fromarray(np.where(depth > 0, 255 - 215 * depth / far, 0).astype(np.uint8))
        size = min(width, whole.width), max(1, round(whole.height * min(1.0, width / whole.width)))
        file = io.BytesIO()
        if exact:
            small.resize(size, Image.Resampling.NEAREST).save(file, format="WEBP", lossless=True, quality=0, method=0)
        else:
            small.resize(size).save(file, format="JPEG", quality=80)
    return file.getvalue()
