"""K979 costmap-contradicts-robot."""

import re
from math import hypot

from urdfkit.description.urdf.robot import Pose
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_TOO_SMALL = 0.6
"""Smallest accepted ratio of the radius to the shorter half side of the base."""

_TOO_LARGE = 2.5
"""Largest accepted ratio of the radius to the distance of the farthest corner of the base."""


class CostmapContradictsRobot(RobotRule):
    """A costmap contradicts the size of the robot, or the place of its scanner.

    ## What it does
    Compares ``robot_radius`` and ``footprint`` in the parameters of costmaps with the box around the links of the robot
    that are fixed to each other, in the frame of the root link. Reports a radius below 60 % of half the width of the
    robot, or above 2.5 times the distance of its farthest corner. For a footprint, the first limit applies to the
    inscribed radius and the second one to the circumscribed radius. Robots with meshes that are not found are not
    checked.

    Also reports heights of obstacles that exclude each point of a level laser scanner of the robot, and a range of
    slam_toolbox or gmapping far beyond that of the scanner.

    ## Why is this bad?
    Navigation plans paths that are too narrow for the robot, or finds none.

    ## Example
    ```yaml
    local_costmap:
      local_costmap:
        ros__parameters:
          robot_radius: 2.2
    ```

    ## Use instead
    ```yaml
    local_costmap:
      local_costmap:
        ros__parameters:
          robot_radius: 0.22
    ```
    """

    code = "K979"
    name = "costmap-contradicts-robot"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each radius that does not suit the robot."""
        from urdfkit.lint.facts.control.controller_wheels import has_other_wheels
        from urdfkit.lint.facts.control.yaml_tree import documents, number_of, span_of, walk, yamls
        from urdfkit.lint.facts.navigation.costmaps import footprint_of, inscribed_radius
        from urdfkit.lint.facts.navigation.sensor_contradictions import sensor_contradictions

        for source, node, message in sensor_contradictions(model):
            yield self.at_span(span_of(source, node), message)
        sources = [source for source in yamls(model) if re.search(r"robot_radius|footprint", source.text)]
        size = _size(model) if sources and not has_other_wheels(model) else None
        if size is None:
            return
        half, reach = size
        for source in sources:
            for node in (node for root in documents(source)[0] for node in walk(root)):
                polygon, value = footprint_of(node), node.find("robot_radius")
                radius = number_of(value)
                if polygon is not None and (inner := inscribed_radius(polygon[1])) > 0.0:
                    outer = max(hypot(x, y) for x, y in polygon[1])
                    what, shown = "footprint", f"extends {inner:.3g} to {outer:.3g} m"
                    value = polygon[0]
                elif value is not None and radius is not None and radius > 0.0 and node.find("footprint") is None:
                    what, shown, inner, outer = "robot_radius", f"is {radius:g} m", radius, radius
                else:
                    continue
                if value is not None and (inner < _TOO_SMALL * half or outer > _TOO_LARGE * reach):
                    message = f"`{what}` {shown}, but the robot extends {half:.3g} to {reach:.3g} m from its centre"
                    yield self.at_span(span_of(source, value), message)


def _size(model: Model) -> tuple[float, float] | None:
    """Return half the width of the fixed parts of the robot, and the distance of the farthest corner [m]."""
    if model.is_incomplete or len(model.robot.roots()) != 1:
        return None
    if any(shapes_of(link) and link.name not in model.extents for link in model.robot.links):
        return None
    moved = {joint.child for joint in model.robot.joints if joint.is_movable and joint.type != "continuous"}
    for joint in model.robot.joints:  # Parents precede children in most files; a missed arm only widens the box.
        if joint.parent in moved:
            moved.add(joint.child)
    points = []
    for name, extent in model.extents.items():
        if name in moved or name not in model.frames:
            continue
        for corner in range(8):
            x, y, z = ((extent.high if corner >> k & 1 else extent.low)[k] for k in range(3))
            points.append(model.frames[name].moved(Pose((x, y, z))).translation)
    if not points:
        return None
    sides = [[point[k] for point in points] for k in (0, 1)]
    half = min(max(side) - min(side) for side in sides) / 2.0
    return (half, max(hypot(point[0], point[1]) for point in points)) if half > 0.0 else None
