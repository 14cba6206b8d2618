"""S919 twins-turn-differently."""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint, Vector
from urdfkit.lint.facts.macro_calls import with_calls_of
from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.facts.twins import mirrored
from urdfkit.lint.rule import Findings, Model, RobotRule

_PLACE = 1e-3
"""Largest difference of the coordinates of mirrored joints [m], and of mirrored limits [rad]."""

_PARALLEL = 0.99
"""Smallest cosine of the angle between the axis of a joint and the mirrored axis of its counterpart."""


class TwinsTurnDifferently(RobotRule):
    """A joint and its counterpart on the other side do not make mirrored motions.

    ## What it does
    Compares the axes and limits of pairs of ``revolute`` joints. The names of the two joints differ only in a side
    (``left`` and ``right``), and their positions are mirrored at the plane y = 0 with every joint at zero. If the axes
    are mirrored, equal angles make mirrored motions, so the limits must be equal. If one axis is reversed, the limits
    must be negated and exchanged. Symmetric limits, and limits that fit neither case, are not reported.

    ## Why is this bad?
    One leg moves outwards while its counterpart moves inwards. Usually the axis or the limits of one side have the
    wrong sign.

    ## Example
    ```diff
     <robot name="walker">
       <link name="base"/>
       <link name="left_leg"/>
       <link name="right_leg"/>
       <joint name="left_hip_roll" type="revolute">
         <parent link="base"/><child link="left_leg"/><origin xyz="0 0.1 0"/><axis xyz="1 0 0"/>
         <limit lower="-0.3" upper="0.7" effort="90" velocity="6"/>
       </joint>
       <joint name="right_hip_roll" type="revolute">
    -    <parent link="base"/><child link="right_leg"/><origin xyz="0 -0.1 0"/><axis xyz="1 0 0"/>
    +    <parent link="base"/><child link="right_leg"/><origin xyz="0 -0.1 0"/><axis xyz="-1 0 0"/>
         <limit lower="-0.3" upper="0.7" effort="90" velocity="6"/>
       </joint>
     </robot>
    ```
    """

    code = "S919"
    name = "twins-turn-differently"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each pair of joints with one missing sign."""
        if model.is_incomplete:
            return
        for first, second in _pairs(model):
            axes = [axis_in_root(joint, model) for joint in (first, second)]
            if axes[0] is None or axes[1] is None or not _are_mirrored(first, second, model):
                continue
            # A rotation is a pseudovector: mirrored at y = 0, its x and z change their signs.
            cosine = -axes[0][0] * axes[1][0] + axes[0][1] * axes[1][1] - axes[0][2] * axes[1][2]
            (low, high), (low2, high2) = _limits(first), _limits(second)
            are_equal = max(abs(low - low2), abs(high - high2)) < _PLACE
            are_negated = max(abs(low + high2), abs(high + low2)) < _PLACE
            if are_equal == are_negated or abs(cosine) < _PARALLEL or (cosine > 0.0) is are_equal:
                continue
            message = (
                f"joint `{second.name}` turns from {-high:.4g} to {-low:.4g} rad when mirrored, "
                f"but its counterpart `{first.name}` turns from {low:.4g} to {high:.4g} rad"
            )
            element = second.element.find("axis") or second.element
            help = "reverse the axis of one joint, or negate and swap its limits"
            names = (first.name, second.name)
            found = self.at(model, element, message, attribute="xyz", joint=second.name, help=help, names=names)
            is_one_tag = first.element.origin.position == second.element.origin.position
            yield with_calls_of(found, first.element) if is_one_tag else found


def _pairs(model: Model) -> Iterator[tuple[Joint, Joint]]:
    """Yield the revolute joints with limits and a counterpart on the other side: left, right."""
    joints = model.robot.joint_by_name
    for joint in model.robot.joints:
        for name in mirrored(joint.name) if joint.type == "revolute" else ():
            other = joints.get(name)
            if other is not None and other.type == "revolute" and joint.name < name:
                yield joint, other


def _limits(joint: Joint) -> tuple[float, float]:
    """Return the limits of a joint [rad]; without them, zeros, which are symmetric."""
    limit = joint.limit
    return (0.0, 0.0) if limit is None else (limit.lower or 0.0, limit.upper or 0.0)


def _are_mirrored(first: Joint, second: Joint, model: Model) -> bool:
    """Return whether two joints are mirrored at the plane y = 0 of the root link."""
    places: list[Vector] = []
    for joint in (first, second):
        frame = model.frames.get(joint.child or "")
        if frame is None:
            return False
        places.append(frame.translation)
    (x, y, z), (x2, y2, z2) = places
    return max(abs(x - x2), abs(y + y2), abs(z - z2)) < _PLACE < abs(y)
