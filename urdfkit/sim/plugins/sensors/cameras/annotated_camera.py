"""Segmentation and bounding-box cameras of gz sim.

A visual gets its label from a label system (``gz-sim-label-system``) in the visual or in its model; a visual without
a label is background. All visuals of one model with the same label are one instance.

Sources: gz-sensors, SegmentationCameraSensor.cc and BoundingBoxCameraSensor.cc; gz-rendering,
Ogre2SegmentationMaterialSwitcher.cc; ros_gz_bridge, convert/vision_msgs.cpp, for the ROS messages of boxes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array
from urdfkit.messages import header, message_type, vector
from urdfkit.messages.constructors import pose
from urdfkit.messages.vision import DETECTIONS_2D, DETECTIONS_3D
from urdfkit.scene import Shape
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.cameras.bounding_boxes import Box2D, Box3D, draw, full_box, space_box, visible_box
from urdfkit.sim.plugins.sensors.cameras.camera import Camera, Capture
from urdfkit.sim.plugins.sensors.cameras.camera_optics import CAMERA_INFO, IMAGE, image
from urdfkit.sim.plugins.sensors.sensor_values import choice
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout

Numbers = NDArray[np.int64]

SEMANTIC = ("semantic",)
PANOPTIC = ("instance", "panoptic")

VISIBLE = ("2d", "visible_2d", "visible_box_2d")
"""Types of 2D boxes around the visible part of an object."""

FULL = ("full_2d", "full_box_2d")
"""Types of 2D boxes around the whole object, occluded parts included."""

SPACE = ("3d",)
"""Types of oriented 3D boxes."""

BOX_TYPES = (*VISIBLE, *FULL, *SPACE)

LINE = (0, 255, 0)


def owner(shape: Shape) -> tuple[str, int]:
    """Return the model that a shape belongs to, and the label of the shape."""
    return shape.body.partition("::")[0], shape.label


def instances(capture: Capture) -> tuple[Numbers, Numbers]:
    """Return label and instance number of every pixel, zero for background; shape (height, width) each.

    Instances of a label are numbered from 1, in the order of the scene.
    """
    table = np.array([*instances_of(capture.shapes), (0, 0)], dtype=np.int64)
    return table[capture.picture.shapes, 0], table[capture.picture.shapes, 1]  # -1 selects the last row, background


def instances_of(shapes: Sequence[Shape]) -> list[tuple[int, int]]:
    """Return label and instance number of every shape, zeros for background."""
    counts: dict[int, int] = {}
    numbers: dict[tuple[str, int], int] = {}
    found = []
    for shape in shapes:
        who = owner(shape)
        if shape.label and who not in numbers:
            numbers[who] = counts[shape.label] = counts.get(shape.label, 0) + 1
        found.append((shape.label, numbers[who]) if shape.label else (0, 0))
    return found


def colors_of(numbers: Numbers) -> NDArray[np.uint8]:
    """Return a colour for each number, equal for equal numbers and black for zero; shape (…, 3)."""
    mixed = numbers.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)  # Knuth's multiplicative hash
    found = np.stack([(mixed >> np.uint64(shift)) & np.uint64(255) for shift in (56, 40, 24)], axis=-1)
    return np.where(numbers[..., None] > 0, np.maximum(found, 1), 0).astype(np.uint8)


class GzSegmentationCamera(Camera):
    """Segmentation camera: publishes a map of labels, and a coloured map for display."""

    kind = "gz_segmentation_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        kinds = (*SEMANTIC, *PANOPTIC)
        kind = choice(self.optics.element, "segmentation_type", kinds, "semantic", in_any_case=True)
        self._by_instance = kind in PANOPTIC
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(f"{name}/colored_map", IMAGE),
            bus.advertise(f"{name}/labels_map", IMAGE),
            bus.advertise(f"{name}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        return self._colored, self._labels

    def _colored(self, capture: Capture) -> Any:
        labels, numbers = instances(capture)
        return image(capture.t, self.frame, colors_of(labels + 256 * numbers if self._by_instance else labels), "rgb8")

    def _labels(self, capture: Capture) -> Any:
        """Return the labels map: the label three times, or the low and high byte of the instance number and the label.

        Source: gz-rendering, Ogre2SegmentationMaterialSwitcher::ColorForVisual: red is the instance number
        modulo 256, green the instance number divided by 256, blue the label; instances are numbered from 1.
        """
        labels, numbers = instances(capture)
        planes = (numbers % 256, numbers // 256, labels) if self._by_instance else (labels, labels, labels)
        return image(capture.t, self.frame, np.stack(planes, axis=-1).astype(np.uint8), "rgb8")


@dataclass(frozen=True, eq=False)
class Boxed:
    """Capture of a bounding-box camera.

    Attributes:
        capture: image of the camera with its data.
        boxes: boxes of the labelled objects in the picture, ordered by instance number and label.
    """

    capture: Capture
    boxes: tuple[Box2D | Box3D, ...]


class GzBoundingBoxCamera(Camera):
    """Bounding-box camera: publishes a box around each visible object, and the picture with the boxes drawn in."""

    kind = "gz_bounding_box_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self._type = choice(self.optics.element, "box_type", BOX_TYPES, "2d", in_any_case=True)
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(name, DETECTIONS_3D if self._type in SPACE else DETECTIONS_2D),
            bus.advertise(f"{name}_image", IMAGE),
            bus.advertise(f"{name.rpartition('/')[0]}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics in `topics`."""
        return self._detections, self._drawn

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Boxed:
        capture = super()._observe(t, layout, frame, random)
        table = self._surroundings.view(layout).table("visual", layout)
        labels, numbers = instances(capture)
        whole, pairs = labels + 256 * numbers, instances_of(capture.shapes)
        boxes: list[Box2D | Box3D] = []
        for one in np.unique(whole[whole > 0]).tolist():
            label, shapes = one % 256, [k for k, each in enumerate(pairs) if each == (one % 256, one // 256)]
            if self._type in VISIBLE:
                boxes.append(visible_box(label, whole == one))
            elif self._type in FULL:
                boxes.append(full_box(label, table, shapes, capture.frame, self.optics.lens))
            else:
                boxes.append(space_box(label, table, shapes, capture.frame))
        return Boxed(capture, tuple(boxes))

    def _detections(self, boxed: Boxed) -> Any:
        return detections(header(boxed.capture.t, self.frame), boxed.boxes, space=self._type in SPACE)

    def _drawn(self, boxed: Boxed) -> Any:
        picture = boxed.capture.picture.rgb.copy()
        for box in boxed.boxes:
            draw(picture, box, self.optics.lens, LINE)
        return image(boxed.capture.t, self.frame, picture, "rgb8")


def detections(head: Any, boxes: Sequence[Box2D | Box3D], *, space: bool) -> Any:
    """Return the Detection2DArray or Detection3DArray of boxes (ros_gz_bridge, convert/vision_msgs.cpp)."""
    hypothesis, possible = (_type(name) for name in ("ObjectHypothesis", "ObjectHypothesisWithPose"))
    array, detection = (_type(f"Detection{3 if space else 2}D{end}") for end in ("Array", ""))
    found = []
    for box in boxes:
        results = [possible(hypothesis(str(box.label), 1.0), _nowhere())]
        found.append(detection(head, results, _box_message(box), ""))
    return array(head, found)


def _box_message(box: Box2D | Box3D) -> Any:
    if isinstance(box, Box2D):
        middle = _type("Pose2D")(_type("Point2D")((box.left + box.right) / 2, (box.top + box.bottom) / 2), 0.0)
        return _type("BoundingBox2D")(middle, float(box.right - box.left), float(box.bottom - box.top))
    import pinocchio

    return _type("BoundingBox3D")(pose(box.centre, pinocchio.Quaternion(box.axes).coeffs()), vector(box.size.tolist()))


def _type(name: str) -> Any:
    return message_type(f"vision_msgs/msg/{name}")


def _nowhere() -> Any:
    nowhere = pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    return message_type("geometry_msgs/msg/PoseWithCovariance")(nowhere, np.zeros(36))
