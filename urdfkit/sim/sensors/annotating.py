"""Cameras of the new Gazebo that tell things apart by their labels: segmentation and bounding boxes.

A thing has the label that a label system (``gz-sim-label-system``) in its model, or in one of its visuals, gives it;
what has none is background. One instance is what has the same label in one model.

Sources: gz-sensors, SegmentationCameraSensor.cc and BoundingBoxCameraSensor.cc; gz-rendering,
Ogre2SegmentationMaterialSwitcher.cc; ros_gz_bridge, convert/vision_msgs.cpp, which is how ROS hears of boxes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.messages import header, message_type
from urdfkit.scene import Shape
from urdfkit.sim.sensors.camera import Camera, Sight
from urdfkit.sim.sensors.optics import CAMERA_INFO, IMAGE, image
from urdfkit.vision_messages import DETECTIONS_2D

if TYPE_CHECKING:
    from urdfkit.sim.parameters import Parameters
    from urdfkit.sim.plugin import Setup
    from urdfkit.sim.topics import Topics

Numbers = NDArray[np.int64]

SEMANTIC = ("semantic",)
PANOPTIC = ("instance", "panoptic")

VISIBLE = ("2d", "visible_2d", "visible_box_2d")
"""Boxes round what is seen of a thing; the other kinds of gz-sensors go round what is hidden, too."""

LINE = (0, 255, 0)


def owner(shape: Shape) -> tuple[str, int]:
    """Return the model that a shape is of, and its label."""
    return shape.body.partition("::")[0], shape.label


def instances(sight: Sight) -> tuple[Numbers, Numbers]:
    """Return label and number of the instance of every pixel, zero for background; shape (height, width) each.

    Instances of a label are counted from 1, in the order in which they are in the scene.
    """
    counts: dict[int, int] = {}
    known: dict[tuple[str, int], int] = {}
    labels, numbers = np.zeros(len(sight.shapes) + 1, dtype=np.int64), np.zeros(len(sight.shapes) + 1, dtype=np.int64)
    for k, shape in enumerate(sight.shapes):
        if not shape.label:
            continue
        if (who := owner(shape)) not in known:
            known[who] = counts[shape.label] = counts.get(shape.label, 0) + 1
        labels[k], numbers[k] = shape.label, known[who]
    return labels[sight.picture.shapes], numbers[sight.picture.shapes]  # -1 is the last, background


def colors_of(numbers: Numbers) -> NDArray[np.uint8]:
    """Return a colour for each number, the same for the same, black for zero; shape (…, 3)."""
    mixed = numbers.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)  # Knuth's multiplicative hash
    found = np.stack([(mixed >> np.uint64(shift)) & np.uint64(255) for shift in (56, 40, 24)], axis=-1)
    return np.where(numbers[..., None] > 0, np.maximum(found, 1), 0).astype(np.uint8)


class GzSegmentationCamera(Camera):
    """A segmentation camera: labels in a picture for programs, and one of colours for people."""

    kind = "gz_segmentation_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        written = self.optics.element.find("segmentation_type")
        kind = "semantic" if written is None or not written.text else written.text.lower()
        if kind not in (*SEMANTIC, *PANOPTIC):
            raise SimulationError(
                f"<segmentation_type> is `{kind}`{did_you_mean(kind, (*SEMANTIC, *PANOPTIC))}; it must be "
                + ", ".join((*SEMANTIC, *PANOPTIC)),
                position=None if written is None else written.origin.position,
            )
        self._apart = kind in PANOPTIC
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(f"{name}/colored_map", IMAGE),
            bus.advertise(f"{name}/labels_map", IMAGE),
            bus.advertise(f"{name}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return what makes the messages of the first of `topics`."""
        return self._colored, self._labels

    def remarks(self) -> tuple[Callable[[float], Any], ...]:
        """Return what makes the messages of the others."""
        return (self.info,)

    def _colored(self, sight: Sight) -> Any:
        labels, numbers = instances(sight)
        return image(sight.t, self.frame, colors_of(labels + 256 * numbers if self._apart else labels), "rgb8")

    def _labels(self, sight: Sight) -> Any:
        """Return the label three times, or the instance's low and high byte and the label.

        Source: gz-rendering, Ogre2SegmentationMaterialSwitcher::ColorForVisual: red is the number of the instance modulo
        256, green that number divided by 256, blue the label; the first instance of a label has number 1.
        """
        labels, numbers = instances(sight)
        planes = (numbers % 256, numbers // 256, labels) if self._apart else (labels, labels, labels)
        return image(sight.t, self.frame, np.stack(planes, axis=-1).astype(np.uint8), "rgb8")


class GzBoundingBoxCamera(Camera):
    """A bounding-box camera: boxes round what is seen of each thing, and the picture with them drawn in."""

    kind = "gz_bounding_box_camera"

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        written = self.optics.element.find("box_type")
        if written is not None and written.text.strip() not in VISIBLE:
            raise SimulationError(
                f"boxes of type `{written.text}` are not made; there are {', '.join(VISIBLE)}",
                position=written.origin.position,
            )
        name, bus = topics.resolve(read.text("image_topic")), setup.bus
        self.topics = (
            bus.advertise(name, DETECTIONS_2D),
            bus.advertise(f"{name}_image", IMAGE),
            bus.advertise(f"{name.rpartition('/')[0]}/camera_info", CAMERA_INFO),
        )

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return what makes the messages of the first of `topics`."""
        return self._detections, self._drawn

    def remarks(self) -> tuple[Callable[[float], Any], ...]:
        """Return what makes the messages of the others."""
        return (self.info,)

    def _detections(self, sight: Sight) -> Any:
        point, pose, box, hypothesis, possible, detection, detections = (
            message_type(f"vision_msgs/msg/{name}")
            for name in (
                "Point2D", "Pose2D", "BoundingBox2D", "ObjectHypothesis", "ObjectHypothesisWithPose", "Detection2D",
                "Detection2DArray",
            )
        )  # fmt: skip
        found = []
        head = header(sight.t, self.frame)
        for label, low_x, low_y, high_x, high_y in boxes(sight):
            middle = pose(point((low_x + high_x) / 2, (low_y + high_y) / 2), 0.0)
            results = [possible(hypothesis(str(label), 1.0), _nowhere())]
            found.append(detection(head, results, box(middle, float(high_x - low_x), float(high_y - low_y)), ""))
        return detections(head, found)

    def _drawn(self, sight: Sight) -> Any:
        picture = sight.picture.rgb.copy()
        for _, low_x, low_y, high_x, high_y in boxes(sight):
            picture[[low_y, high_y], low_x : high_x + 1] = LINE
            picture[low_y : high_y + 1, [low_x, high_x]] = LINE
        return image(sight.t, self.frame, picture, "rgb8")


def boxes(sight: Sight) -> Iterator[tuple[int, int, int, int, int]]:
    """Yield the label of each instance in the picture, and the lowest and highest pixel of it: x, y, x, y."""
    labels, numbers = instances(sight)
    whole = labels + 256 * numbers
    for one in np.unique(whole[whole > 0]).tolist():
        row, column = np.nonzero(whole == one)
        yield one % 256, int(column.min()), int(row.min()), int(column.max()), int(row.max())


def _nowhere() -> Any:
    pose = message_type("geometry_msgs/msg/Pose")(
        message_type("geometry_msgs/msg/Point")(0.0, 0.0, 0.0),
        message_type("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0),
    )
    return message_type("geometry_msgs/msg/PoseWithCovariance")(pose, np.zeros(36))
