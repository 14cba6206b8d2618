"""Parameters of costmaps and of mapping that contradict the height or the range of the robot's laser scanners.

The behaviour is that of costmap_2d, nav2_costmap_2d, slam_toolbox and gmapping; the sources were not compared.
"""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import GazeboBlock
from urdfkit.description.xml.numbers import number
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, yamls
from urdfkit.lint.facts.gazebo.sensor_topics import published
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Source, Node, str]]

_LEVEL = 0.99
"""Least cosine of the angle between the axis of a scanner and the vertical."""

_MAX_RATIO = 1.5
_DEFAULT_RANGE = 20.0
"""Accepted ratio of the range of a mapping node to that of the scanner, and the default of slam_toolbox [m]."""


def sensor_contradictions(model: Model) -> Defects:
    """Yield the heights between which no point of a scan lies, and the ranges far beyond that of the scanner."""
    lasers = {one.topic.strip("/"): one.key[0] for one in published(model) if one.type == "LaserScan"}
    ranges = _ranges(model)
    for source in yamls(model):
        for node in (each for each in nodes(source) if each.entries):
            topic, kind, frame = (node.find(name) for name in ("topic", "data_type", "sensor_frame"))
            if topic is not None and kind is not None and kind.text == "LaserScan":
                link = lasers.get(topic.text.strip("/")) or (frame.text if frame is not None else "")
                yield from ((source, *defect) for defect in _of_height(node, link, model))
            scan, most = node.find("scan_topic"), node.find("max_laser_range") or node.find("maxUrange")
            reach = ranges.get(lasers.get(scan.text.strip("/"), "") if scan is not None else _only(ranges))
            value = number_of(most)
            if most is not None and value is not None and reach is not None and value != _DEFAULT_RANGE:
                name = "max_laser_range" if node.find("max_laser_range") is most else "maxUrange"
                if value > _MAX_RATIO * reach:
                    yield source, most, f"`{name}` is {value:g} m, but the scanner measures up to {reach:g} m"


def _of_height(node: Node, link: str, model: Model) -> Iterator[tuple[Node, str]]:
    frame = model.frames.get(link)
    if frame is None or model.is_incomplete or len(model.robot.roots()) != 1 or abs(frame.rotation[2][2]) < _LEVEL:
        return
    height = frame.translation[2]
    for name, sign in (("min_obstacle_height", 1.0), ("max_obstacle_height", -1.0)):
        value = node.find(name)
        limit = number_of(value)
        if value is not None and limit is not None and sign * (limit - height) > 1e-3:
            side = "above" if sign > 0.0 else "below"
            message = f"`{name}` is {limit:g} m, {side} the scanner `{link}` at {height:.3g} m, so no point is used"
            yield value, message


def _ranges(model: Model) -> dict[str, float]:
    """Return link → greatest range of its only laser scanner [m]."""
    found: dict[str, list[float]] = {}
    for block in model.robot.gazebo:
        found.setdefault(block.reference or "", []).extend(_of_block(block))
    return {link: values[0] for link, values in found.items() if len(values) == 1}


def _of_block(block: GazeboBlock) -> Iterator[float]:
    for sensor in block.sensors:
        kind = next((each for name in ("ray", "lidar") if (each := sensor.element.find(name)) is not None), None)
        limits = kind.find("range") if kind is not None else None
        most = limits.find("max") if limits is not None else None
        value = number(most.text) if most is not None else None
        if value is not None and value > 0.0:
            yield value


def _only(ranges: dict[str, float]) -> str:
    return next(iter(ranges)) if len(ranges) == 1 else ""
