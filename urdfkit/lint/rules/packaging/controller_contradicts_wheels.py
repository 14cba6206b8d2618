"""K970 controller-contradicts-wheels."""

from collections.abc import Iterator
from typing import Any

from urdfkit.description.urdf.robot import Cylinder, Sphere
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.controller_settings import ControllerSettings
from urdfkit.lint.facts.control.yaml_tree import Node, span_of
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

TOLERANCE = 0.1
"""Accepted relative deviation; twice that of Gazebo plugins, because controllers are tuned on real robots."""


class ControllerContradictsWheels(RobotRule):
    """The parameters of a drive or steering controller contradict the wheels of the robot.

    ## What it does
    Compares ``wheel_separation``, ``wheel_radius``, the radius, distances and corners of mecanum controllers, and the
    ``wheelbase`` and tracks of steering controllers in YAML with the joints and shapes of the wheels. Also checks the
    positions of the left and right wheels: x points forward and y left (REP 103). Deviations of up to 10 % are
    accepted. With several wheels on each side, up to twice the separation is accepted, because the wheels slip when the
    robot turns. If the controller has a ``wheel_separation_multiplier``, the larger separation is reported, because the
    multiplier already compensates for the slip. For wheels with meshes, the rule uses only round collision shapes. A
    left and a right wheel at the same place are reported.

    Nothing is reported if another description in the package or its neighbours also has continuous joints.

    ## Why is this bad?
    The robot turns in the wrong direction, or drives and turns more or less than commanded, and its odometry is wrong.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         drive:
           type: diff_drive_controller/DiffDriveController
     drive:
       ros__parameters:
         left_wheel_names: [left_wheel_joint]
         right_wheel_names: [right_wheel_joint]
    -    wheel_separation: 0.6
    +    wheel_separation: 0.3
    ```

    ## References
    In the robot of this example, the wheels are 0.3 m apart.
    """

    code = "K970"
    name = "controller-contradicts-wheels"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter of a drive controller that contradicts the robot."""
        if model.is_damaged:
            return
        from urdfkit.lint.facts.control.controller_wheels import diff_drives, has_other_wheels

        findings: list[Finding] = list(self._of_steering(model))
        for source, controller in diff_drives(model):
            findings += self._contradictions(source, controller, model)
        if findings and not has_other_wheels(model):
            yield from findings

    def _of_steering(self, model: Model) -> Findings:
        """Yield a finding for the wheel radius of a steering or mecanum controller that differs from the robot's."""
        from urdfkit.lint.facts.control.controller_wheels import mecanum_defects, mecanum_wheels, steering_wheels
        from urdfkit.lint.facts.gazebo.steered_axles import axles, exchanged, wrong_lengths

        for each in axles(model):
            for node, message, actual in wrong_lengths(each):
                joint = each.wheels["traction"][0][1].joint.name if each.wheels["traction"] else ""
                yield self._at(each.source, node, message, joint, f"write {actual:.6g}")
            for node, message in exchanged(each):
                yield self._at(each.source, node, message, node.text, "exchange the names")
        for source, node, message, joint, help in mecanum_defects(model):
            yield self._at(source, node, message, joint, help)
        for source, group, name, wheels in (*steering_wheels(model), *mecanum_wheels(model)):
            links = [model.robot.link_by_name.get(wheel.joint.child or "") for wheel in wheels]
            shapes = [shape.geometry for link in links if link is not None for shape in link.collisions]
            radii = [shape.radius for shape in shapes if isinstance(shape, (Cylinder, Sphere)) and shape.radius > 0.0]
            for parameter, value in _positive_number(group, name):
                if radii and not any(abs(value - radius) <= TOLERANCE * radius for radius in radii):
                    message = f"`{name}` is {value:g} m, but the radius of the wheels is {radii[0]:.6g} m"
                    names = tuple(str(wheel.joint.child) for wheel in wheels)
                    joint, help = wheels[0].joint.name, f"write {radii[0]:.6g}"
                    yield self._at(source, parameter, message, joint, help, names=names)

    def _contradictions(self, source: Source, controller: ControllerSettings, model: Model) -> Findings:
        from urdfkit.lint.facts.control.controller_wheels import wheels_of
        from urdfkit.lint.facts.gazebo.drive_wheels import collision_radii, track
        from urdfkit.lint.facts.root_cause import property_of_length
        from urdfkit.lint.rules.semantics.wheel_separation import SKID_STEER_RATIO

        left, right = (wheels_of(controller, model, side) for side in ("left", "right"))
        if not left or len(left) != len(right):
            return
        (node, first), (_, other) = left[0], right[0]
        lateral, longitudinal = (a - b for a, b in ((first.place[k], other.place[k]) for k in (1, 0)))
        # If all axes point right, the front of the robot is at negative x.
        is_reversed = all(wheel.axis[1] < -0.7 for _, wheel in (*left, *right))
        if lateral < 0.0 and abs(lateral) > abs(longitudinal) and not is_reversed:
            # Of lists that are exchanged, the first one is reported.
            sides = (("left", node, first, "right"), ("right", right[0][0], other, "left"))
            side, wrong, wheel, place = min(sides, key=lambda each: each[1].line if len(left) > 1 else 0)
            message = f"{side} wheel `{wrong.text}` of controller `{controller.name}` is on the {place} side"
            message += f", at y = {wheel.place[1]:g} m"
            names = _links(first, other)
            yield self._at(source, wrong, message, wrong.text, "swap the wheel names", names=names)
        if first.joint is not other.joint and first.place == other.place and first.place[1] != 0.0:
            position = f"{first.place[0]:g} {first.place[1]:g} {first.place[2]:g} m"
            message = f"wheels `{node.text}` and `{right[0][0].text}` are at the same place, {position}"
            help, names = "check the signs of the joint origins", (right[0][0].text, *_links(first, other))
            yield self._at(source, node, message, node.text, help, kind="place", names=names)
        separation_of_joints = abs(lateral)
        max_ratio = SKID_STEER_RATIO if len(left) > 1 else 1.0 + TOLERANCE
        distances = [
            abs(left_centre[1] - right_centre[1])
            for (_, wheel), (_, opposite) in zip(left, right, strict=True)
            for left_centre, right_centre in zip(wheel.middles, opposite.middles, strict=False)
        ]
        for parameter, value in _positive_number(controller.group, "wheel_separation"):
            multiplier = next(
                (number for _, number in _positive_number(controller.group, "wheel_separation_multiplier")), 1.0
            )
            tuned = value * multiplier
            # A multiplier compensates for slip, so the separation itself is that of the wheels.
            most = 1.0 + TOLERANCE if multiplier > 1.0 + TOLERANCE else max_ratio
            if separation_of_joints > 0.01 and not any(
                distance / (1.0 + TOLERANCE) <= separation <= most * distance
                for distance in distances
                for separation in (value, tuned)
                if distance
            ):
                actual, subject = track(first, other, distances[: min(len(first.middles), len(other.middles))])
                message = f"`wheel_separation` is {value:g} m, but {subject} are {actual:.6g} m apart"
                written = property_of_length(model, actual)
                yield self._at(
                    source,
                    parameter,
                    message,
                    first.joint.name,
                    f"write {actual:.6g}",
                    other=written,
                    names=_links(first, other),
                )
        found = (radius for _, wheel in (*left, *right) for radius in collision_radii(wheel, model))
        radii = [radius for radius in found if radius > 0.0]
        for parameter, value in _positive_number(controller.group, "wheel_radius"):
            if radii and not any(abs(value - radius) <= TOLERANCE * radius for radius in radii):
                message = f"`wheel_radius` is {value:g} m, but the radius of the wheels is {radii[0]:.6g} m"
                help, names = f"write {radii[0]:.6g}", _links(first, other)
                written = property_of_length(model, radii[0])
                yield self._at(source, parameter, message, first.joint.name, help, names=names, other=written)

    def _at(
        self, source: Source, node: Node, message: str, joint: str, help: str, other: Span | None = None, **details: Any
    ) -> Finding:
        # Several files that contradict one property are different causes.
        cause = f"{message} in {source.file}" if other is not None else ""
        details |= {"joint": joint, "help": help, "other": other, "cause": cause}
        return self.at_span(span_of(source, node), message, **details)


def _links(*wheels: Wheel) -> tuple[str, ...]:
    """Return the links that the joints of wheels connect."""
    links = (link for wheel in wheels for link in (wheel.joint.parent, wheel.joint.child))
    return tuple(dict.fromkeys(link for link in links if link is not None))


def _positive_number(group: Node, name: str) -> Iterator[tuple[Node, float]]:
    """Yield the node and value of a parameter greater than zero; with zero, the controller reads the description."""
    from urdfkit.description.xml.numbers import number

    node = group.find(name)
    value = number(node.text) if node is not None and node.text else None
    if node is not None and value is not None and value > 0.0:
        yield node, value
