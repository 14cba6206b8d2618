"""The rules, by layer and family. `RULES` is all of them in the order of their codes.

They are imported when they are asked for: a clean file needs neither the pages of the catalogue nor the fault rules,
and a robot without ``<gazebo>`` needs none of those on Gazebo.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.robot import Robot
    from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule

    RULES: tuple[type[Rule], ...]


def source_rules() -> tuple[type[SourceRule], ...]:
    """Return the rules on the text of each file."""
    from urdfkit.lint.rules import document, xacro

    return (*document.source_rules(), *xacro.source_rules())


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules on what xacro could not expand."""
    from urdfkit.lint.rules import document, xacro

    return (*document.fault_rules(), *xacro.fault_rules())


def robot_rules(robot: Robot | None = None, target: str | None = None) -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot.

    Args:
        robot: leave out the rules that have nothing to look at in this one; without it all are returned.
        target: leave out those for other targets, where a robot is given.
    """
    from urdfkit.lint.rules import document, names, packaging, tree, xacro

    every = robot is None
    targeted = every or target is not None
    found = [*document.robot_rules(), *xacro.robot_rules(), *tree.robot_rules(), *names.robot_rules()]
    found += packaging.robot_rules()
    if targeted:
        found += tree.targeted_rules()
    if robot is None or robot.joints:
        from urdfkit.lint.rules import joints

        found += joints.robot_rules()
    if robot is None or robot.links:
        from urdfkit.lint.rules import geometry, inertial

        found += [*inertial.robot_rules(), *geometry.robot_rules()]
        if robot is None or _has_mesh(robot):
            found += geometry.mesh_rules()
    if robot is None or robot.joints:
        from urdfkit.lint.rules import semantics

        found += semantics.robot_rules()
    if robot is None or robot.gazebo:
        from urdfkit.lint.rules import gazebo

        found += [*gazebo.robot_rules(), *(gazebo.targeted_rules() if targeted else ())]
    if robot is None or robot.transmissions or robot.ros2_control or robot.gazebo:
        from urdfkit.lint.rules import control

        found += control.robot_rules()
        if robot is None or robot.transmissions:
            found += [*control.transmission_rules(), *(control.targeted_rules() if targeted else ())]
        if robot is None or robot.ros2_control or robot.gazebo:
            found += control.ros2_control_rules()
    return tuple(found)


def _has_mesh(robot: Robot) -> bool:
    from urdfkit.description.robot import Mesh
    from urdfkit.lint.placement import shapes_of

    return any(isinstance(shape.geometry, Mesh) for link in robot.links for shape in shapes_of(link))


def suppression_rules() -> tuple[type[Rule], ...]:
    """Return the rules on the comments that suppress findings."""
    from urdfkit.lint.rules import document

    return document.suppression_rules()


def __getattr__(name: str) -> Any:
    if name != "RULES":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    every = (*source_rules(), *fault_rules(), *robot_rules(), *suppression_rules())
    return tuple(sorted(every, key=lambda rule: rule.code))
