"""K976 controller-joint-foreign."""

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.yaml_tree import Node
from urdfkit.lint.facts.twins import mirrored, side_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ControllerJointForeign(RobotRule):
    """A controller lists a joint on the other side of the robot, or sets values for a joint that it does not control.

    ## What it does
    Compares the groups in ``constraints`` and ``gains`` of trajectory controllers with their ``joints``. Names that
    resemble a joint of the controller are reported as misspelt by K962. Also reports a joint on the other side of the
    robot in a list of joints, if the name of the controller or of the list states the side.

    In the Python code of the workspace, checks ``JointTrajectory`` and ``JointState`` messages. They must contain as
    many values as joint names. If the values are variables whose names contain words of the joint names, they must be
    in the order of the joints. Also compares the number of values in ``Float64MultiArray`` messages with the joints of
    the controller that reads them.

    ## Why is this bad?
    The values have no effect, and the controller uses the default gains or tolerances for the intended joint.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
           type: joint_trajectory_controller/JointTrajectoryController
     arm_controller:
       ros__parameters:
         joints: [elbow]
         command_interfaces: [position]
         state_interfaces: [position]
         constraints:
    -      finger: {goal: 0.01}
    +      elbow: {goal: 0.01}
    ```
    """

    code = "K976"
    name = "controller-joint-foreign"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each group of another joint."""
        from urdfkit.lint.facts.connections.messages_in_code import unequal_commands, unequal_joints
        from urdfkit.lint.facts.control.controller_settings import misspelt_names
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls
        from urdfkit.lint.fix_builders import meant

        for source, place, message in dict.fromkeys((*unequal_joints(model), *unequal_commands(model))):
            yield self.at_span(source.span(*place), message)
        for source in yamls(model):
            for one in settings(source) if re.search(_SIDES, source.text) else ():
                for item, near, message in _of_other_side(one, model):
                    message += Suggestion(near, item.text)
                    yield self.at_span(span_of(source, item), message, names=(item.text, near), kind="side")
            if "constraints" not in source.text and "gains" not in source.text:
                continue
            misspelt = {(node.line, node.column) for node, _, _ in misspelt_names(source)}
            for one in settings(source):
                listed = one.group.find("joints")
                names = listed.texts() if listed is not None and one.kind.endswith("TrajectoryController") else []
                # A joint that no robot has is reported where it is listed.
                is_complete = set(names) <= model.robot.joint_by_name.keys()
                left_out = _left_out(one, names, model) if names and is_complete else set()
                if listed is not None and left_out:
                    key = _place_before(one, listed, left_out)
                    lacking = ", ".join(f"`{name}`" for name in sorted(left_out))
                    message = f"`joints` of `{one.name}` lacks {lacking}, which its other settings and MoveIt have"
                    named = (*sorted(left_out), one.name)
                    yield self.at_span(span_of(source, key), message, names=named, kind="left out")
                for key, value in one.group.entries if names and is_complete else ():
                    for inner, each in value.entries if key.text in ("constraints", "gains") else ():
                        is_joint = each.kind == "group" and inner.text not in (*names, *left_out)
                        if is_joint and "$" not in inner.text and (inner.line, inner.column) not in misspelt:
                            message = f"`{key.text}` has `{inner.text}`, which controller `{one.name}` does not control"
                            hint = meant(inner.text, names)[1]
                            yield self.at_span(
                                span_of(source, inner), message + hint, names=(inner.text,), kind="foreign"
                            )


def _place_before(one: ControllerSettings, listed: Node, left_out: set[str]) -> Node:
    """Return the joint in a list after which a joint is missing by the order of the constraints or gains."""
    orders = [
        [key.text for key, value in group.entries if value.kind == "group"]
        for name in ("constraints", "gains")
        if (group := one.group.find(name)) is not None
    ]
    order = next((each for each in orders if left_out <= {*each}), [])
    missing = min((order.index(name) for name in left_out), default=0)
    before = [item for item in listed.items if item.text in order[:missing]]
    return before[-1] if before else listed.items[0]


def _left_out(one: ControllerSettings, names: list[str], model: Model) -> set[str]:
    """Return the joints that the settings of a controller and of its MoveIt controller have, but not its list."""
    from urdfkit.lint.facts.moveit.settings import entries, moveit_yamls

    groups = [value for key, value in one.group.entries if key.text in ("constraints", "gains")]
    named = {key.text for group in groups for key, value in group.entries if value.kind == "group"} - set(names)
    named &= model.robot.joint_by_name.keys()
    if not named:
        return named
    controllers = [entry for source, _ in moveit_yamls(model) for entry in entries(source)]
    controllers = [entry for entry in controllers if entry.kind == "controller" and entry.name.last_name == one.name]
    lists = [joints.texts() for entry in controllers if (joints := entry.settings.find("joints")) is not None]
    return {name for name in named if any({name, *names} <= {*each} for each in lists)}


_SIDES = "left|right|[lr]_"
_LISTS = r"joints|(?:left|right)_wheel(?:_names)?"


def _of_other_side(one: ControllerSettings, model: Model) -> Iterator[tuple[Node, str, str]]:
    """Yield the only joint of a list on the other side of the robot, its counterpart and a message.

    The name of the controller or of the list states the side, and another joint is on this side.
    """
    for key, value in one.group.entries:
        sides = [side_of(item.text) for item in value.items] if re.fullmatch(_LISTS, key.text) else []
        side = side_of(key.text) or side_of(one.name)
        wrong = [at for at, each in enumerate(sides) if each and side and each != side]
        if len(wrong) != 1 or side not in sides:
            continue
        item, names = value.items[wrong[0]], value.texts()
        meant = [each for each in mirrored(item.text) if each in model.robot.joint_by_name and each not in names]
        if len(meant) == 1 and item.text in model.robot.joint_by_name:
            message = f"`{key.text}` of controller `{one.name}` lists `{item.text}`, which is on the other side"
            yield item, meant[0], message
