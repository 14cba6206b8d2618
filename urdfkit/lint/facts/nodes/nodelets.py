"""Nodelets of ROS 1 whose manager no launch file starts, and classes of nodelets that their packages do not have.

Source: ros/nodelet_core (nodelet/src/nodelet.cpp, Noetic): ``nodelet load TYPE MANAGER`` waits for the service
``MANAGER/load_nodelet``. Classes: nodelets.xml of image_pipeline, depthimage_to_laserscan, pointcloud_to_laserscan,
velodyne and realsense-ros, from memory; only similar names are reported.
"""

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launched_nodes import launches, started
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_CLASSES = """
image_proc: crop_decimate crop_nonZero crop_non_zero debayer rectify resize; stereo_image_proc: disparity point_cloud2
point_cloud; image_rotate: image_rotate; depth_image_proc: convert_metric crop_foremost disparity register
point_cloud_xyz point_cloud_xyz_radial point_cloud_xyzi point_cloud_xyzi_radial point_cloud_xyzrgb
point_cloud_xyzrgb_radial; depthimage_to_laserscan: DepthImageToLaserScanNodelet; pointcloud_to_laserscan:
pointcloud_to_laserscan_nodelet laserscan_to_pointcloud_nodelet; velodyne_driver: DriverNodelet; velodyne_pointcloud:
CloudNodelet TransformNodelet RingColorsNodelet; velodyne_laserscan: LaserScanNodelet; realsense2_camera:
RealSenseNodeFactory
"""

_MANAGER = r"<node\b[^<>]*\bargs\s*=\s*[\"']\s*manager\b[^<>]*>"
_NAME = r"\bname\s*=\s*[\"']([^\"'$]+)[\"']"


def wrong_nodelets(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the word and the message of each nodelet whose class is unknown or missing."""
    table = {name.strip(): names.split() for name, _, names in (row.partition(":") for row in _CLASSES.split(";"))}
    for source in launches(model):
        for node in started(source) if "nodelet" in source.text else ():
            words = node.arguments
            first = words[0] if words else None
            if node.package != "nodelet" or first is None or first.name not in ("load", "standalone"):
                continue
            if len(words) == 1:
                yield source, first, f"`{first.name}` needs the class of the nodelet"
            elif (word := words[1]) is not None:
                package, _, name = word.name.partition("/")
                classes = table.get(package, [])
                near = nearest(name, classes, cutoff=0.8) if name not in classes else None
                if near is not None:
                    message = f"package `{package}` has no nodelet `{name}`"
                    yield source, word, message + Suggestion(f"{package}/{near}", word.name)


def unmanaged_nodelets(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the name of the manager and the message, where that launch file starts another manager."""
    words = Words(model)
    for source in launches(model):
        found = [re.search(_NAME, tag[0]) for tag in re.finditer(_MANAGER, source.text)]
        names = sorted({name[1] for name in found if name is not None})
        if not names or len(names) < len(found):
            continue
        for node in started(source):
            listed = [word.name if word is not None else "" for word in node.arguments]
            if node.package != "nodelet" or len(listed) < 3 or listed[0] != "load" or node.arguments[2] is None:
                continue
            if ")" in listed[2]:  # the end of a substitution, such as $(arg class)
                continue
            manager = node.arguments[2]
            name = manager.name.rpartition("/")[2]
            if name not in names and not words.names(name, [(source.file, manager.start)]):
                near = names[0] if len(names) == 1 else nearest(name, names)
                yield source, manager, f"no launch file starts the nodelet manager `{name}`" + Suggestion(near, name)
