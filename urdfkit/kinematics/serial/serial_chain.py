"""SerialChain: the joints between two links as numbers for the serial kernel, without numpy."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping
from dataclasses import dataclass

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.joint_limits import position_limits
from urdfkit.kinematics.mimic import Coupling, couplings
from urdfkit.kinematics.serial.rigid_placement import (
    IDENTITY,
    Placement,
    compose,
    invert,
    placement_of,
    placement_of_quaternion,
    rotation_to,
    turned,
)
from urdfkit.kinematics.variable_names import PARTS, require_independent, unknown_frame, variable_names

TURN = 2.0 * math.pi
UNITS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class ChainVariable:
    """A number that moves the chain: the position of an independent joint, or one number of a planar joint.

    Attributes:
        name: name of the joint, or ``joint/x``, ``joint/y``, ``joint/theta`` of a planar joint.
        lower: lower limit [rad] or [m]; minus infinity without one.
        upper: upper limit [rad] or [m]; infinity without one.
        is_periodic: whether whole turns of it move no link of the chain.
    """

    name: str
    lower: float
    upper: float
    is_periodic: bool


@dataclass(frozen=True, slots=True)
class ElementaryMotion:
    """A turn about an axis [rad], or a slide along it [m]: ``factor`` · variable + ``offset``.

    Attributes:
        variable: its name; None if the motion is constant.
        axis: unit vector.
        is_turn: whether it is a turn.
        factor: multiplier of the variable.
        offset: turn or slide where the variable is zero.
    """

    variable: str | None
    axis: tuple[float, float, float]
    is_turn: bool
    factor: float = 1.0
    offset: float = 0.0


class SerialChain:
    """The joints between two links of a robot, as constants of the serial kernel.

    Args:
        robot: a robot that is one tree.
        base: name of the link in which poses are expressed; the root link when None.
        tip: name of the link whose poses are solved for; it may be above the base.
        hold: name of a joint or variable → its position [rad] or [m]; such joints do not move.

    Raises:
        KinematicsError: an unknown link or joint, or no joint moves the tip relative to the base.

    Attributes:
        robot: the robot.
        base: name of the base link.
        tip: name of the tip link.
        hold: name of a joint or variable that does not move → its position [rad] or [m].
        variables: the variables in the order of the joints from base to tip; mimic joints are moved by their leader.
        steps: see `serial.kernel.chain_forward.place`.
        indices: index of the variable of each step.
        limits: see `serial.kernel.descent.LIMIT`.
    """

    def __init__(self, robot: Robot, base: str | None, tip: str, *, hold: Mapping[str, float] | None = None) -> None:
        self.robot = robot
        self.base = robot.roots()[0].name if base is None else base
        self.tip = tip
        self._couplings: dict[str, Coupling] = couplings(robot)
        self._names = variable_names(robot)
        self.hold = self.checked_positions(hold or {})
        self.steps, self.indices = array("d"), array("q")
        factors: dict[str, list[float]] = {}
        ranges: dict[str, tuple[float, float]] = {}
        order: dict[str, int] = {}
        placement = IDENTITY
        for joint, is_reversed in self._path():
            parts = self._motions(joint) if joint.is_movable else []
            origin = placement_of(joint.origin)
            if is_reversed:
                parts = [part if isinstance(part, ElementaryMotion) else invert(part) for part in reversed(parts)]
            else:
                placement = compose(placement, origin)
            for part in parts:
                if not isinstance(part, ElementaryMotion):
                    placement = compose(placement, part)
                    continue
                sign = -1.0 if is_reversed else 1.0
                rotation = rotation_to(part.axis)
                placement = compose(placement, rotation)
                if part.variable is None or part.variable in self.hold:
                    held = part.offset + part.factor * self.hold.get(part.variable or "", 0.0)
                    placement = compose(
                        placement, turned(sign * held, 0.0) if part.is_turn else turned(0.0, sign * held)
                    )
                else:
                    numbers = (sign * part.factor, sign * part.offset)
                    self.steps.extend((*placement, *(numbers if part.is_turn else (0.0, 0.0))))
                    self.steps.extend((0.0, 0.0) if part.is_turn else numbers)
                    self.indices.append(order.setdefault(part.variable, len(order)))
                    is_whole = part.is_turn and part.factor != 0.0 and part.factor == round(part.factor)
                    factors.setdefault(part.variable, []).append(float(is_whole))
                    ranges[part.variable] = self._range(joint, part, ranges.get(part.variable))
                    placement = IDENTITY
                placement = compose(placement, invert(rotation))
            if is_reversed:
                placement = compose(placement, invert(origin))
        self.steps.extend(placement)
        if not order:
            raise KinematicsError(f"no joint moves `{tip}` relative to `{self.base}` in robot `{robot.name}`")
        self.variables = tuple([ChainVariable(name, *ranges[name], all(factors[name])) for name in order])
        self.limits = self._kernel_limits()

    def __repr__(self) -> str:
        """Return the links at both ends and the number of variables."""
        return f"<{type(self).__name__} {self.base} → {self.tip}: {len(self.variables)} variables>"

    def checked_positions(self, positions: Mapping[str, float]) -> dict[str, float]:
        """Return positions of any independent joints of the robot.

        Raises:
            KinematicsError: an unknown name, a mimic joint, or a position that is not a finite number.
        """
        for name, value in positions.items():
            require_independent(self.robot, self._couplings, self._names, name)
            if not math.isfinite(value):
                raise KinematicsError(f"position of joint `{name}` is {value}; it must be a finite number")
        return {name: float(value) for name, value in positions.items()}

    def start(self, positions: Mapping[str, float] | None = None) -> list[float]:
        """Return a configuration: these positions; other joints in the middle of their limits, or at zero without any.

        Args:
            positions: name of a joint or variable → position; those of joints outside the chain are ignored.

        Raises:
            KinematicsError: see `checked_positions`.
        """
        positions = self.checked_positions(positions or {})
        middle = [0.5 * (v.lower + v.upper) if math.isfinite(v.lower + v.upper) else 0.0 for v in self.variables]
        return [positions.get(variable.name, value) for variable, value in zip(self.variables, middle, strict=True)]

    def _path(self) -> list[tuple[Joint, bool]]:
        """Return the joints from base to tip, and whether each is passed from child to parent."""
        above = [self._joints_above(self.base), self._joints_above(self.tip)]
        while above[0] and above[1] and above[0][-1] is above[1][-1]:
            above[0].pop()
            above[1].pop()
        return [*((joint, True) for joint in above[0]), *((joint, False) for joint in reversed(above[1]))]

    def _joints_above(self, link: str) -> list[Joint]:
        """Return the joints from a link up to the root.

        Raises:
            KinematicsError: no link of that name.
        """
        robot = self.robot
        if link not in robot.link_by_name:
            raise KinematicsError(unknown_frame(robot, link))
        joints: list[Joint] = []
        while above := robot.parents_of.get(link):
            joints.append(above[0])
            link = above[0].parent or ""
        return joints

    def _motions(self, joint: Joint) -> list[ElementaryMotion | Placement]:
        """Return the motions of a movable joint from parent to child; a floating joint is held."""
        if joint.type == "floating":
            parts = PARTS["floating"]
            values = [self.hold.get(f"{joint.name}/{part}", float(part == "rot_w")) for part in parts]
            if not any(values[3:]):
                raise KinematicsError(f"the quaternion of the floating joint `{joint.name}` is zero")
            return [placement_of_quaternion(values[:3], values[3:])]
        if not joint.has_axis or joint.type not in ("revolute", "continuous", "prismatic", "planar"):
            what = f"no usable type: {joint.type!r}" if joint.has_axis else "an axis that is zero"
            raise KinematicsError(f"joint `{joint.name}` has {what}", position=joint.element.origin.position)
        length = math.hypot(*joint.axis)
        x, y, z = (part / length for part in joint.axis)
        if joint.type == "planar":
            plane = rotation_to((x, y, z))
            return [
                plane,
                *(ElementaryMotion(f"{joint.name}/{part}", UNITS[k], k == 2) for k, part in enumerate(PARTS["planar"])),
                invert(plane),
            ]
        is_turn = joint.type != "prismatic"
        if (coupling := self._couplings.get(joint.name)) is None:
            return [ElementaryMotion(joint.name, (x, y, z), is_turn)]
        return [ElementaryMotion(coupling.master, (x, y, z), is_turn, coupling.multiplier, coupling.offset)]

    def _range(self, joint: Joint, motion: ElementaryMotion, so_far: tuple[float, float] | None) -> tuple[float, float]:
        """Return the limits of a motion's variable, narrowed by those of a mimic joint.

        Raises:
            KinematicsError: the limits exclude every position.
        """
        leader = self.robot.joint_by_name.get(motion.variable or "", joint)
        lower, upper = so_far or position_limits(leader)
        if joint is not leader and motion.factor != 0.0:
            ends = [(end - motion.offset) / motion.factor for end in position_limits(joint)]
            lower, upper = max(lower, min(ends)), min(upper, max(ends))
        if lower > upper:
            raise KinematicsError(
                f"the limits of joint `{joint.name}` exclude every position", position=joint.element.origin.position
            )
        return lower, upper

    def _kernel_limits(self) -> array[float]:
        """Return the limits of the kernel: infinite ranges are sampled around the seed, large ones around zero."""
        reach = 1.0 + sum(
            math.sqrt(sum(part * part for part in self.steps[k + 9 : k + 12])) for k in range(0, len(self.steps), 16)
        )
        numbers = array("d")
        for variable in self.variables:
            lower, upper, span = variable.lower, variable.upper, math.pi if variable.is_periodic else 2.0 * reach
            is_relative = not math.isfinite(upper - lower)
            low, high = lower, upper
            if is_relative:
                low, high = -span, span
            elif upper - lower > 2.0 * max(span, math.pi):
                middle = min(max(0.0, lower + span), upper - span)
                low, high = middle - span, middle + span
            numbers.extend((lower, upper, low, high, float(is_relative), float(variable.is_periodic)))
        return numbers
