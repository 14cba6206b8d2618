"""K979 costmap-contradicts-robot."""

import re
from collections.abc import Sequence
from itertools import combinations
from math import dist, hypot

from urdfkit.description.urdf.geometry import rotate, unit
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel
from urdfkit.lint.model.placement import links_below, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule
from urdfkit.record import record

_TOO_SMALL = 0.6
"""Smallest accepted ratio of the radius to the shorter half side of the base."""

_TOO_LARGE = 2.5
"""Largest accepted ratio of the radius to the distance of the farthest corner of the base."""

_UNCOVERED = 0.25
"""Largest accepted ratio of the uncovered length at one end of a footprint to the length of the base."""

_UNCOVERED_TWICE = 0.075
"""Accepted ratio of the uncovered length at each of both ends of a footprint to the length of the base."""

_ENDS = (("front", 0, 1.0), ("rear", 0, -1.0), ("left side", 1, 1.0), ("right side", 1, -1.0))


@record
class _Size:
    """The box around the base, seen from above: lowest and highest x and y [m], and distance of the farthest corner."""

    low: tuple[float, float]
    high: tuple[float, float]
    reach: float

    @property
    def half(self) -> float:
        """Half of the shorter side [m]."""
        return min(self.high[0] - self.low[0], self.high[1] - self.low[1]) / 2.0


_WIDE = 4.0
"""Largest ratio of the distance between the wheels of a caster to their radius."""

_VERTICAL = 0.985
"""Smallest vertical component of the axis of a hitch or caster."""


class CostmapContradictsRobot(RobotRule):
    """A costmap contradicts the size of the robot, or the place of its scanner.

    ## What it does
    Compares ``robot_radius`` and ``footprint`` in the parameters of costmaps with the box around the wheels and the
    links that are fixed to the root link. Reports:

    - a radius below 60 % of half the width of the robot
    - a radius, or a corner of a footprint, of more than 2.5 times the distance of the farthest corner of the robot
    - a footprint that leaves more than a quarter of the length or width of the robot uncovered at one end, or 7.5 % at
      both ends

    Robots with meshes that are not found are not checked.

    Also reports limits of the obstacle height that exclude every point of a horizontal laser scanner of the robot, and
    a range of slam_toolbox or gmapping far beyond the range of the scanner.

    ## Why is this bad?
    Navigation plans paths that are too narrow for the robot, or finds no path.

    ## Example
    ```diff
     local_costmap:
       local_costmap:
         ros__parameters:
    -      robot_radius: 2.2
    +      robot_radius: 0.22
    ```
    """

    code = "K979"
    name = "costmap-contradicts-robot"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each radius that does not suit the robot."""
        from urdfkit.lint.facts.control.controller_wheels import has_other_wheels
        from urdfkit.lint.facts.control.yaml_tree import nodes, number_of, span_of, yamls
        from urdfkit.lint.facts.navigation.costmaps import footprint_of, inscribed_radius, vertices_of
        from urdfkit.lint.facts.navigation.sensor_contradictions import sensor_contradictions

        for source, node, message in sensor_contradictions(model):
            yield self.at_span(span_of(source, node), message)
        sources = [source for source in yamls(model) if re.search(r"robot_radius|footprint|vertices", source.text)]
        size = _size(model) if sources and not has_other_wheels(model) else None
        if size is None:
            return
        for source in sources:
            for node in nodes(source):
                polygon, value = footprint_of(node), node.find("robot_radius")
                radius = number_of(value)
                if polygon is not None and inscribed_radius(polygon[1]) > 0.0:
                    value, message = polygon[0], _footprint_message(polygon[1], size)
                elif value is not None and radius is not None and radius > 0.0 and node.find("footprint") is None:
                    is_right = _TOO_SMALL * size.half <= radius <= _TOO_LARGE * size.reach
                    shown = f"extends {size.half:.3g} to {size.reach:.3g} m from its centre"
                    message = "" if is_right else f"`robot_radius` is {radius:g} m, but the robot {shown}"
                elif (band := node.find("footprint_model")) is not None and (points := vertices_of(band)) is not None:
                    value, message = points[0], _footprint_message(points[1], size).replace("footprint", "vertices")
                else:
                    continue
                if value is not None and message:
                    yield self.at_span(span_of(source, value), message, kind="size")


def _footprint_message(polygon: list[tuple[float, float]], size: _Size) -> str:
    """Return the contradiction of a footprint with the robot; empty without one."""
    outer = max(hypot(*corner) for corner in polygon)
    if outer > _TOO_LARGE * size.reach:
        return (
            f"a corner of `footprint` is {outer:.3g} m from the centre, but the robot extends only {size.reach:.3g} m"
        )
    for axis, what in enumerate(("length", "width")):
        gaps = [
            (size.high[axis] if sign > 0.0 else -size.low[axis]) - max(sign * corner[axis] for corner in polygon)
            for sign in (1.0, -1.0)
        ]
        whole = size.high[axis] - size.low[axis]
        if min(gaps) > _UNCOVERED_TWICE * whole:
            own = whole - sum(gaps)
            return f"the {what} of `footprint` is {own:.3g} m, but that of the robot is {whole:.3g} m"
    for end, axis, sign in _ENDS:
        own = max(sign * corner[axis] for corner in polygon)
        robot = size.high[axis] if sign > 0.0 else -size.low[axis]
        if robot - own > _UNCOVERED * (size.high[axis] - size.low[axis]):
            where = f"{'xy'[axis]} = {sign * own:.3g} m, but the {end} of the robot is at {sign * robot:.3g} m"
            return f"`footprint` ends at {where}"
    return ""


def _size(model: Model) -> _Size | None:
    """Return the size of the base: the wheels and the fixed parts of the robot."""
    from urdfkit.lint.facts.gazebo.rolling_wheels import rolling_wheels

    if model.is_incomplete or len(model.robot.roots()) != 1:
        return None
    if any(shapes_of(link) and link.name not in model.extents for link in model.robot.links):
        return None
    moved = {joint.child for joint in model.robot.joints if joint.is_movable and joint.type != "continuous"}
    for joint in model.robot.joints:  # Parents precede children in most files; a missed arm only widens the box.
        if joint.parent in moved:
            moved.add(joint.child)
    wheels = rolling_wheels(model)
    moved -= {wheel.joint.child for wheel in wheels}
    moved |= _towed(model, wheels)
    points = []
    for name, extent in model.extents.items():
        if name in moved or name not in model.frames:
            continue
        points += extent.corners_in(model.frames[name])
    if not points:
        return None
    sides = [[point[k] for point in points] for k in (0, 1)]
    low, high = (min(sides[0]), min(sides[1])), (max(sides[0]), max(sides[1]))
    size = _Size(low, high, max(hypot(point[0], point[1]) for point in points))
    return size if size.half > 0.0 else None


def _towed(model: Model, wheels: Sequence[Wheel]) -> set[str]:
    """Return the links of trailers: what turns about a vertical axis on wheels that are far apart, unlike a caster."""
    towed: set[str] = set()
    for joint in model.robot.joints if len(wheels) > 1 else ():
        frame, axis = model.frames.get(joint.child or ""), unit(joint.axis)
        if not joint.is_movable or frame is None or axis is None or abs(rotate(frame.rotation, axis)[2]) < _VERTICAL:
            continue
        below = links_below(model.robot, joint.child or "")
        own = [wheel for wheel in wheels if wheel.joint.child in below]
        if any(dist(a.place, b.place) > _WIDE * a.radii[0] for a, b in combinations(own, 2)):
            towed |= below
    return towed
