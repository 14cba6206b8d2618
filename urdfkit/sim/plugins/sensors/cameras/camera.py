"""Base class of camera sensors, and the colour camera of gz sim.

The camera looks along the x axis of its link, as in Gazebo. The frame id is the one configured in the plugin, by
convention an optical frame. The principal point in Gazebo Classic's CameraInfo is one pixel off the one it renders
with, (W + 1)/2 instead of (W - 1)/2; urdfkit publishes the same value for compatibility.
"""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene import Shape
from urdfkit.scene.camera_model import Distortion
from urdfkit.scene.ray_renderer import Picture
from urdfkit.scene.renderer import ImageRenderer
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cameras.camera_optics import (
    CAMERA_INFO,
    IMAGE,
    Optics,
    camera_info,
    cameras_of,
    image,
    optics_of,
)
from urdfkit.sim.plugins.sensors.noise import Noise, noise_of
from urdfkit.sim.plugins.sensors.scene_sensor import SceneSensor
from urdfkit.sim.plugins.sensors.sensor_values import pose_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout

SEVERAL = ("multicamera", "stereo_camera")
"""Sensor types with more than one camera."""

MOST_LOST = 0.25
"""Fraction of pixels without a ray above which the user is warned; the corners of a fish-eye lens stay below it."""


@dataclass(frozen=True, eq=False)
class Capture:
    """Image of a camera with the data for its messages.

    Attributes:
        t: time stamp [s].
        picture: colour, depth and shape index of each pixel.
        shapes: shapes that the indices of the picture refer to.
        frame: placement of the camera in the world; shape (4, 4).
    """

    t: float
    picture: Picture
    shapes: tuple[Shape, ...]
    frame: Array


@dataclass(frozen=True, eq=False)
class Imager:
    """One camera of a sensor.

    Attributes:
        name: name of the camera; empty if it has no name.
        pose: placement in the sensor; shape (4, 4).
        optics: lens, image format and clipping distances.
        noise: noise of its pictures.
        focal: focal length in CameraInfo [px].
        cx: column of the principal point in CameraInfo [px].
        cy: row of the principal point in CameraInfo [px].
        baseline: distance to the left camera of a stereo pair [m].
    """

    name: str
    pose: Array
    optics: Optics
    noise: Noise
    focal: float
    cx: float
    cy: float
    baseline: float

    def info(self, frame: str, t: float) -> Any:
        """Return the CameraInfo; renders nothing."""
        return camera_info(t, frame, self.optics.lens, focal=self.focal, cx=self.cx, cy=self.cy, baseline=self.baseline)

    def capture(
        self, t: float, view: ImageRenderer, frame: Array, random: np.random.Generator, *, deep: bool
    ) -> Capture:
        """Return the capture with the sensor at `frame`; `deep` adds depths and shape indices."""
        optics, placed = self.optics, matmul(frame, self.pose)
        picture = view.take(optics.lens, placed, near=optics.near, far=optics.far, samples=optics.samples, deep=deep)
        if self.noise:
            noisy = self.noise.on(picture.rgb / 255.0, random)
            picture = replace(picture, rgb=np.rint(255.0 * np.clip(noisy, 0.0, 1.0)).astype(np.uint8))
        return Capture(t, picture, view.table.shapes, placed)


class Camera(SceneSensor):
    """Sensor with one or more cameras; its subclass defines the topics.

    Attributes:
        imagers: cameras of the sensor.
        deep: whether it renders depths and shape indices.
        sensor_frame: frame id of the sensor, whose x axis points forward; `frame` may be an optical frame.
    """

    namespace = "{model}"
    deep = True

    def _prepare(self, setup: Setup, sensor: SensorTag, read: Parameters, topics: Topics) -> None:
        several = cameras_of(sensor)
        if sensor_type(setup) not in SEVERAL:
            several = several[:1]
        self.imagers = [self._imager(each, setup, read) for each in several]
        self.optics = self.imagers[0].optics
        self.sensor_frame = self.frame
        if (optical := self.optics.element.find("optical_frame_id")) is not None and optical.text:
            self.frame = optical.text
        self._advertise(setup, read, topics)

    def _imager(self, camera: Element, setup: Setup, read: Parameters) -> Imager:
        optics = optics_of(camera)
        written = Distortion(*(read.number(meaning) for meaning in ("k1", "k2", "p1", "p2", "k3")))
        if written and not optics.lens.distortion:
            optics = replace(optics, lens=replace(optics.lens, distortion=written))
        if (lost := optics.lens.lost) > MOST_LOST:
            place = (camera.find("distortion") or camera).origin.position
            setup.note(f"{place}: with this distortion, {lost:.0%} of the picture stays empty")
        lens, gz = optics.lens, self.spec.generation == "gz"
        return Imager(
            camera.get("name") or "",
            pose_of(camera),
            optics,
            noise_of(camera, setup.random),
            read.number("focal_length") or lens.focal_length,
            read.number("cx") or (lens.width + (0 if gz else 1)) / 2,
            read.number("cy") or (lens.height + (0 if gz else 1)) / 2,
            read.number("baseline"),
        )

    @abstractmethod
    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        """Read the parameters of this plugin and fill `topics`."""

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Any:
        renderer = self._surroundings.view(layout).renderer(layout)
        return self.imagers[0].capture(t, renderer, frame, random, deep=self.deep)

    def message(self, capture: Capture) -> Any:
        """Return the image of the first camera."""
        return image(capture.t, self.frame, capture.picture.rgb, self.optics.encoding)

    def other_messages(self) -> tuple[Callable[[float], Any], ...]:
        """Return the functions that build the messages of the other topics; by default `info`."""
        return (self.info,)

    def info(self, t: float) -> Any:
        """Return the CameraInfo of the first camera."""
        return self.imagers[0].info(self.frame, t)

    def topic_of(self, read: Parameters, topics: Topics, meaning: str, name: str, imager: str = "") -> str:
        """Return a topic below the camera's name: the parameter `meaning` if it is written, else `name`."""
        return topics.resolve(
            f"{read.text('camera')}/{imager}/{read.text(meaning, name)}".replace("//", "/").lstrip("/")
        )


class GzCamera(Camera):
    """Colour camera of gz sim, which publishes without a plugin."""

    kind = "gz_camera"
    deep = False

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        picture = topics.resolve(read.text("image_topic"))
        written = self.optics.element.find("camera_info_topic")
        info = written.text if written is not None and written.text else f"{picture.rpartition('/')[0]}/camera_info"
        self.topics = (setup.bus.advertise(picture, IMAGE), setup.bus.advertise(topics.resolve(info), CAMERA_INFO))


def sensor_type(setup: Setup) -> str:
    """Return the type of the sensor to configure."""
    return (setup.sensor.type or "").strip() if setup.sensor is not None else ""
