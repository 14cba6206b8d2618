"""Frames in which the sensors of Gazebo publish their data."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.urdf.robot import GazeboBlock, SensorTag
from urdfkit.lint.model.model import Model

FRAMES = ("gz_frame_id", "ignition_frame_id", "optical_frame_id")
"""Elements of a sensor that name the frame of its data."""

_NEW = ("gpu_lidar", "rgbd_camera", "depth_camera")
"""Types of sensors that Gazebo Classic does not have."""

_NEW_PLUGIN = re.compile(r"(?:lib)?(?:gz|ign)")
_CLASSIC = "libgazebo_"
"""Start of the file names of plugins of Gazebo Classic."""


def sensors_without_frame(model: Model) -> Iterator[tuple[GazeboBlock, SensorTag, str]]:
    """Yield the cameras and lidars of Gazebo that name no frame, and the frame that they lack.

    The frame is the optical frame on the link of a camera. Without one, the robot has another sensor with a frame, and
    the frame is the link itself.
    """
    sensors = [(block, sensor) for block in model.robot.gazebo for sensor in block.sensors if _is_compared(sensor)]
    lacking = [(block, sensor) for block, sensor in sensors if not _names_frame(sensor)]
    plugins = [plugin.filename or "" for block in model.robot.gazebo for plugin in block.plugins]
    plugins += [plugin.filename or "" for _, sensor in sensors for plugin in sensor.plugins]
    if not lacking or model.is_incomplete or any(name.startswith(_CLASSIC) for name in plugins):
        return
    if not any(_NEW_PLUGIN.match(name) for name in plugins) and not any(sensor.type in _NEW for _, sensor in sensors):
        return
    for block, sensor in lacking:
        link, name = block.reference or "", sensor.name or ""
        if sensor.plugins or link not in model.robot.link_by_name or not name or _is_handled(name, model):
            continue
        children = [each.child for each in model.robot.children_of.get(link, ()) if each.type == "fixed" and each.child]
        optical = [each for each in children if "optical" in each.lower()]
        if "camera" in (sensor.type or "") and len(optical) == 1:
            yield block, sensor, optical[0]
        elif len(lacking) < len(sensors):
            yield block, sensor, link


def _is_compared(sensor: SensorTag) -> bool:
    return any(word in (sensor.type or "") for word in ("camera", "lidar"))


def _names_frame(sensor: SensorTag) -> bool:
    return any("frame" in element.tag.lower() for element in sensor.element.walk())


def _is_handled(name: str, model: Model) -> bool:
    """Return whether a file publishes the frame of a sensor, or overrides it in the bridge to ROS."""
    scoped = re.compile(rf"(?<![\w/])/?\w+/\w+/{re.escape(name)}(?![\w/])|override_frame_id")
    return any(scoped.search(source.text) for source in model.related_files.values())
