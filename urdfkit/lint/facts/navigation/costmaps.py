"""Costmaps of Nav2 and of costmap_2d in ROS 1: order of layers, window, frames, inflation and footprint.

Sources: costmap_2d (layered_costmap.cpp, static_layer.cpp, inflation_layer.cpp) of Noetic, nav2_costmap_2d of Jazzy.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from math import hypot
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, nodes, number_of, walk, yamls
from urdfkit.lint.facts.navigation.sections import COSTMAPS, costmaps_of_ros1, sections
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.model.model import Model
from urdfkit.record import record

Defects = Iterator[tuple[Source, Node, str]]
Points = list[tuple[float, float]]

_MARKING = ("StaticLayer", "ObstacleLayer", "VoxelLayer", "RangeSensorLayer", "SpatioTemporalVoxelLayer")
_ROUNDING = 1e-6
"""Largest inscribed radius of a footprint that is 0 but for rounding [m]."""

_FALSE = ("false", "False", "FALSE")


@record(eq=False)
class Costmap:
    """The parameters of a costmap in one file.

    Attributes:
        source: the file.
        name: ``local_costmap`` or ``global_costmap``; empty for parameters of both.
        group: the parameters.
    """

    source: Source
    name: str
    group: Node


def costmaps(model: Model) -> list[Costmap]:
    """Return the costmaps in the YAML files around a robot."""
    found = []
    for source in yamls(model):
        if PARAMETERS in source.text:
            for key, group in sections(source):
                name = key.last_name
                found += [Costmap(source, name, group)] if name in COSTMAPS else []
            continue
        names = {id(value): key.text for root in documents(source) for key, value in root.entries}
        for group in costmaps_of_ros1(source):
            name = names.get(id(group), "")
            found.append(Costmap(source, name if name in COSTMAPS else "", group))
    return found


def costmap_defects(model: Model) -> Defects:
    """Yield the parameters of costmaps that contradict each other: file, place, message."""
    every = costmaps(model)
    for each in every:
        group, source = each.group, each.source
        layers = list(_layers(group))
        for at, (item, kind) in enumerate(layers):
            later = [(other, name) for other, name in layers[at + 1 :] if name in _MARKING]
            static = next((other for other, name in later if name == "StaticLayer"), None)
            if kind == "InflationLayer" and later:
                message = (
                    f"`{item.text}` is before `{later[0][0].text}`, whose obstacles are not inflated; move it last"
                )
                yield source, item, message
            elif kind in _MARKING[1:] and static is not None:
                message = f"`{static.text}` is after `{item.text}` and overwrites its obstacles; move it first"
                yield source, item, message
        window, static_map = group.find("rolling_window"), group.find("static_map")
        has_static_layer = any(kind == "StaticLayer" for _, kind in layers)
        is_static = has_static_layer or (static_map is not None and static_map.text not in _FALSE)
        if window is not None and each.name == "local_costmap" and window.text in _FALSE and layers and not is_static:
            yield source, window, "`rolling_window` of the local costmap is false, so the robot leaves the costmap"
        fixed = group.find("global_frame")
        is_link = fixed is not None and fixed.text.strip("/") in model.robot.link_by_name
        if fixed is not None and is_link and not re.search(r"map|odom|world", fixed.text):
            yield source, fixed, f"`global_frame` is `{fixed.text}`, a link of the robot; write a fixed frame"
        elif (
            fixed is not None and has_static_layer and each.name == "global_costmap" and fixed.text.strip("/") == "odom"
        ):
            yield source, fixed, "`global_frame` is `odom`, but the static layer has a map in the frame `map`"
        yield from _late_map(model, each)
        yield from _footprint(each)
        shape = _shape(each, every)
        yield from _window(each, shape)
        yield from _inflation(each, shape)
        yield from _two_shapes(each)
    yield from _late(model, every)


_SENDING_ONCE = ("nav2_map_server",)
"""Packages whose nodes publish the map once for present and later subscribers."""


def _late_map(model: Model, each: Costmap) -> Defects:
    """Yield the flag of a static layer that does not get the map that has been published before it subscribes."""
    for _, layer in each.group.entries:
        flag, topic = layer.find("map_subscribe_transient_local"), layer.find("map_topic")
        is_other = topic is not None and topic.text.strip("/") not in ("", "map")
        if flag is None or flag.text not in _FALSE or is_other:
            continue
        sender = next(
            (
                node.program
                for node in launched_nodes(model)
                if node.package in _SENDING_ONCE and node.program == "map_server"
            ),
            None,
        )
        if sender is not None:
            message = f"`{sender}` publishes the map before this layer subscribes, so the layer does not receive it"
            yield each.source, flag, f"{message}; set this to true"


def _layers(group: Node) -> Iterator[tuple[Node, str]]:
    """Yield the name of each layer in ``plugins``, and its class without the package; empty if unknown."""
    plugins = group.find("plugins")
    for item in plugins.items if plugins is not None else ():
        name = item.find("name") if item.kind == "group" else item
        kind = item.find("type") if item.kind == "group" else None
        if item.kind != "group" and (section := group.find(item.text)) is not None:
            kind = section.find("plugin")
        if name is not None:
            yield name, kind.class_name if kind is not None else ""


def footprint_of(group: Node) -> tuple[Node, Points] | None:
    """Return the footprint of a costmap with its corners [m]; None without a readable polygon."""
    node = group.find("footprint")
    if node is None:
        return None
    found = node
    if node.kind == "text":
        from urdfkit.lint.facts.control.yaml_tree import documents_in

        roots = documents_in(node.text)[0] if node.text.startswith("[") else ()
        if not roots:
            return None
        found = roots[0]
    points = []
    for item in found.items:
        pair = [number_of(each) for each in item.items]
        if len(pair) != 2 or pair[0] is None or pair[1] is None:
            return None
        points.append((pair[0], pair[1]))
    return (node, points) if len(points) > 2 else None


def vertices_of(group: Node) -> tuple[Node, Points] | None:
    """Return the vertices of a polygon of teb_local_planner with their coordinates [m]; None without them."""
    node, kind = group.find("vertices"), group.find("type")
    if node is None or kind is None or kind.text != "polygon":
        return None
    return footprint_of(Node("group", "", ((Node("text", "footprint", (), (), 0, 0), node),), (), 0, 0))


def inscribed_radius(points: Points) -> float:
    """Return the smallest distance of the sides of a polygon from the origin [m]; 0 if the origin is outside."""
    inside, distance = False, float("inf")
    for (x, y), (u, v) in pairwise([*points, points[0]]):
        inside ^= (y > 0.0) != (v > 0.0) and x + (u - x) * (0.0 - y) / (v - y) > 0.0
        length = hypot(u - x, v - y)
        (dx, dy) = ((u - x) / length, (v - y) / length) if length else (0.0, 0.0)
        along = min(max(-(x * dx + y * dy), 0.0), length)
        distance = min(distance, hypot(x + along * dx, y + along * dy))
    return distance if inside else 0.0


def _footprint(each: Costmap) -> Defects:
    found = footprint_of(each.group)
    if found is None:
        return
    node, points = found
    twice = next((point for at, point in enumerate(points) if point in points[:at]), None)
    # Without one of its corners, a rectangle around the origin is a triangle with a side through it.
    if twice is not None and inscribed_radius(points) < _ROUNDING:
        yield each.source, node, f"`footprint` has the corner [{twice[0]:g}, {twice[1]:g}] twice; check the signs"
        return
    sides = list(pairwise([*points, points[0]]))
    for at, first in enumerate(sides):
        if any(_cross(*first, *other) for other in sides[at + 2 :]):
            yield each.source, node, "sides of `footprint` cross each other; write the corners in order"
            return
    if inscribed_radius(points) == 0.0 and not any(abs(x) < 1e-3 and abs(y) < 1e-3 for x, y in points):
        yield each.source, node, "`footprint` does not contain the origin of the robot; check the signs"


def _shape(each: Costmap, every: list[Costmap]) -> Costmap | None:
    """Return the costmap with the footprint or radius of a costmap, perhaps in another file of a ROS 1 package."""
    shaped = [each]
    if PARAMETERS not in each.source.text:
        package = package_of(Path(each.source.file))
        shaped += [other for other in every if package_of(Path(other.source.file)) == package]
    names = ("footprint", "robot_radius")
    return next((one for one in shaped if any(one.group.find(name) is not None for name in names)), None)


def _window(each: Costmap, shape: Costmap | None) -> Defects:
    """Yield the width or height of a rolling window that does not contain the footprint, and cells as wide as it."""
    found, rolls = footprint_of(shape.group) if shape is not None else None, each.group.find("rolling_window")
    if found is None:
        return
    cell, inner = each.group.find("resolution"), inscribed_radius(found[1])
    step = number_of(cell)
    if cell is not None and step is not None and _ROUNDING < inner < step:
        message = f"`resolution` is {step:g} m, more than the inscribed radius of the robot, {inner:.3g} m"
        yield each.source, cell, message
    if rolls is None or rolls.text in _FALSE:
        return
    reach = max(hypot(x, y) for x, y in found[1])
    for name in ("width", "height"):
        value = each.group.find(name)
        size = number_of(value)
        if value is not None and size is not None and 0.0 < size < 2.0 * reach:
            message = f"`{name}` is {size:g} m, but the robot extends {reach:.3g} m from the middle of the costmap"
            yield each.source, value, message


def _two_shapes(each: Costmap) -> Defects:
    """Yield a radius next to a footprint, which replaces it."""
    radius = each.group.find("robot_radius")
    if radius is not None and footprint_of(each.group) is not None and number_of(radius):
        yield each.source, radius, "`robot_radius` has no effect next to `footprint`; remove one of them"


def _late(model: Model, every: list[Costmap]) -> Defects:
    """Yield the rate of a local costmap that is older than the time to drive through its inflation."""
    speeds = [
        speed
        for source in yamls(model)
        for node in nodes(source)
        for name in ("max_vel_x", "vx_max", "desired_linear_vel")
        if (speed := number_of(node.find(name))) is not None
    ]
    for each in every if speeds else ():
        value = each.group.find("update_frequency") if each.name == "local_costmap" else None
        rate = number_of(value)
        radii = [number_of(node.find("inflation_radius")) for node in walk(each.group)]
        reach = max((radius for radius in radii if radius is not None), default=0.0)
        if value is not None and rate and rate > 0.0 and 0.0 < reach < min(speeds) / rate:
            message = f"`update_frequency` is {rate:g} Hz: at {min(speeds):g} m/s, the robot drives"
            yield each.source, value, f"{message} {min(speeds) / rate:.3g} m between two updates, beyond the inflation"


def _cross(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], d: tuple[float, float]) -> bool:
    """Return whether the segments a b and c d cross in their interior."""

    def side(p: tuple[float, float], q: tuple[float, float], r: tuple[float, float]) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0.0 and side(c, d, a) * side(c, d, b) < 0.0


def _inflation(each: Costmap, shape: Costmap | None) -> Defects:
    """Yield an inflation that ends inside of the robot."""
    if shape is None:
        return
    corners, radius = footprint_of(shape.group), number_of(shape.group.find("robot_radius"))
    inner = inscribed_radius(corners[1]) if corners is not None else radius
    if corners is None and PARAMETERS in each.source.text:
        return  # parameter-value-invalid
    for node in walk(each.group):
        value = node.find("inflation_radius")
        reach = number_of(value)
        if value is not None and reach is not None and inner is not None and 0.0 < reach < inner - 1e-6:
            what = "the inscribed radius of `footprint`" if corners is not None else "`robot_radius`"
            yield each.source, value, f"`inflation_radius` is {reach:g} m, less than {what}, {inner:.3g} m"
