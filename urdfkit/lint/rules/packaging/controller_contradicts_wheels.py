"""K970 controller-contradicts-wheels."""

from __future__ import annotations

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.controller_settings import Settings
    from urdfkit.lint.model import Model
    from urdfkit.lint.wheels import Wheel
    from urdfkit.lint.yaml_tree import Node

TOLERANCE = 0.1
"""Twice what drives in descriptions are granted: settings of controllers are measured on real robots."""


class ControllerContradictsWheels(RobotRule):
    """The settings of a diff_drive_controller contradict the wheels of the robot.

    ## What it does
    Compares ``wheel_separation`` and ``wheel_radius`` in YAML with the joints and the shapes of the wheels, and looks
    where the wheels are that are called left and right: x is forward and y is left (REP 103). A tenth more or less is
    let be, and so is the separation of several wheels on a side up to twice, as they slip when the robot turns; so are
    meshes. Where another description around has wheels, too, nothing is said.

    ## Why is this bad?
    The robot turns the other way, or drives and turns more or less than commanded, and its odometry is wrong.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        drive:
          type: diff_drive_controller/DiffDriveController
    drive:
      ros__parameters:
        left_wheel_names: [left_wheel_joint]
        right_wheel_names: [right_wheel_joint]
        wheel_separation: 0.6
        wheel_radius: 0.05
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        drive:
          type: diff_drive_controller/DiffDriveController
    drive:
      ros__parameters:
        left_wheel_names: [left_wheel_joint]
        right_wheel_names: [right_wheel_joint]
        wheel_separation: 0.3
        wheel_radius: 0.05
    ```

    ## References
    The wheels of the cart beside the example are 0.3 m apart.
    """

    code = "K970"
    name = "controller-contradicts-wheels"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each setting of a drive that is not what the robot has, where it is written."""
        if model.is_incomplete:
            return
        from urdfkit.lint.controller_settings import settings
        from urdfkit.lint.yaml_tree import yamls

        found: list[Finding] = []
        for source in yamls(model):
            if "DiffDriveController" in source.text:
                for one in settings(source):
                    if one.kind == "diff_drive_controller/DiffDriveController":
                        found += self._contradictions(source, one, model)
        if found and not _has_other_wheels(model):
            yield from found

    def _contradictions(self, source: Source, one: Settings, model: Model) -> Iterator[Finding]:
        from urdfkit.lint.rules.semantics.wheel_separation import SKID_STEER_RATIO
        from urdfkit.lint.wheels import track

        left, right = _wheels(one, model, "left"), _wheels(one, model, "right")
        if not left or len(left) != len(right):
            return
        (node, first), (_, other) = left[0], right[0]
        aside, along = (a - b for a, b in ((first.place[k], other.place[k]) for k in (1, 0)))
        turned_round = all(wheel.axis[1] < -0.7 for _, wheel in (*left, *right))  # Its front is where x is negative.
        if aside < 0.0 and abs(aside) > abs(along) and not turned_round:
            at = f"y = {first.place[1]:g} m, on the right side"
            yield self._at(source, node, f"`{node.text}` is a left wheel of `{one.name}`, but lies at {at}", node.text)
        apart = abs(aside)
        most = SKID_STEER_RATIO if len(left) > 1 else 1.0 + TOLERANCE
        shapes = [
            abs(a[1] - b[1])
            for (_, wheel), (_, its) in zip(left, right, strict=True)
            for a, b in zip(wheel.middles, its.middles, strict=False)
        ]
        for place, value in _numbers(one, "wheel_separation"):
            tuned = value * next((number for _, number in _numbers(one, "wheel_separation_multiplier")), 1.0)
            if apart > 0.01 and not any(d / most <= v <= most * d for d in shapes for v in (value, tuned) if d):
                actual, what = track(first, other, shapes[: min(len(first.middles), len(other.middles))])
                message = f"`wheel_separation` is {value:g} m, but {what} are {actual:.6g} m apart"
                yield self._at(source, place, message, first.joint.name)
        radii = [radius for _, wheel in (*left, *right) for radius in wheel.radii if radius > 0.0]
        for place, value in _numbers(one, "wheel_radius"):
            if radii and not any(abs(value - radius) <= TOLERANCE * radius for radius in radii):
                message = f"`wheel_radius` is {value:g} m, but the wheels have {radii[0]:.6g} m"
                yield self._at(source, place, message, first.joint.name)

    def _at(self, source: Source, node: Node, message: str, joint: str) -> Finding:
        from urdfkit.lint.yaml_tree import span_of

        return Finding(self.code, self.name, self.severity, message, span_of(source, node), joint=joint)


def _wheels(one: Settings, model: Model, side: str) -> list[tuple[Node, Wheel]]:
    """Return the wheels of a side with where they are named; none where the robot lacks one."""
    from urdfkit.lint.wheels import wheel_of

    named = one.group.find(f"{side}_wheel_names") or one.group.find(f"{side}_wheel")
    nodes = [node for node in (named, *named.items) if node.text] if named is not None else []
    joints = [model.robot.joint_by_name.get(node.text) for node in nodes]
    wheels = [wheel_of(model, joint, None) if joint is not None else None for joint in joints]
    known = [(node, wheel) for node, wheel in zip(nodes, wheels, strict=True) if wheel is not None]
    return known if len(known) == len(nodes) else []


def _numbers(one: Settings, name: str) -> Iterator[tuple[Node, float]]:
    """Yield a parameter with its place, where it is a number greater than zero: zero takes it from the description."""
    from urdfkit.description.numbers import number

    node = one.group.find(name)
    value = number(node.text) if node is not None and node.text else None
    if node is not None and value is not None and value > 0.0:
        yield node, value


def _has_other_wheels(model: Model) -> bool:
    """Whether a description around that is no part of this one has joints that turn, too."""
    from pathlib import Path

    from urdfkit.description.surroundings import package_of
    from urdfkit.lint.entries import descriptions

    own = {str(Path(name).absolute()) for name in model.expanded.sources}
    packages = {model.package, *(package_of(Path(file)) for file in model.around)}
    texts = (each for folder in sorted(p for p in packages if p is not None) for each in descriptions(folder))
    return any("continuous" in text for path, text in texts if str(path.absolute()) not in own)
