"""SerialSolver: inverse kinematics of one target at a time, without numpy, and the reason where it is not reached."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence
from dataclasses import dataclass, replace

from urdfkit.errors import KinematicsError, did_you_mean
from urdfkit.kinematics.serial.kernel.native_code import Compiling, function
from urdfkit.kinematics.serial.serial_chain import SerialChain

LINEAR = 2.0
"""Weight of a metre of distance, relative to a radian of angle, while the solver descends."""
PREFERENCES = {"first": 0, "nearest": 1, "manipulability": 2, "all": 3}
"""Which solution is kept: see `serial.kernel.search`."""
FURTHER = 16
"""Restarts after the first solution that search for a better one."""
APPROACHES = 100
"""Descents to the configuration nearest to a target that cannot be reached."""
ROW = 5
"""Numbers after the configuration of a solution: see `serial.kernel.search`."""
STEP, AXIS, LIMIT = 16, 6, 6
"""Numbers of a step, of its axis and origin, and of the limits of a variable: see `serial.kernel`."""
TURN = 2.0 * math.pi
AT_LIMIT = 1e-6
"""Distance to a limit [rad or m] from which a joint counts as being at it."""


@dataclass(frozen=True, slots=True)
class SolverOptions:
    """Options of inverse kinematics.

    Attributes:
        position_only: ignore the orientation.
        distance: tolerance [m].
        angle: tolerance [rad].
        prefer: ``first``, ``nearest`` (to the start), ``manipulability`` or ``all``.
        restarts: maximum number of random starts per target.
        seed: number of the random stream.
        approaches: number of descents to the configuration nearest to a target that cannot be reached, the first from
            the start; with 0, one with a small error is returned, in less time.
        further: number of restarts after the first solution that search for a better one, unless `prefer` is ``first``.
    """

    position_only: bool = False
    distance: float = 1e-3
    angle: float = 1.745e-3
    prefer: str = "first"
    restarts: int = 200
    seed: int = 0
    approaches: int = APPROACHES
    further: int = FURTHER

    def __post_init__(self) -> None:
        """Check the values.

        Raises:
            KinematicsError: a tolerance is not above zero, the number of restarts is negative, or `prefer` is unknown.
        """
        if not (self.distance > 0.0 and self.angle > 0.0):
            raise KinematicsError(
                f"the tolerance is {self.distance:g} m and {self.angle:g} rad; both must be above zero"
            )
        if self.restarts < 0:
            raise KinematicsError(f"the number of restarts is {self.restarts}; it must not be negative")
        if self.prefer not in PREFERENCES:
            raise KinematicsError(f"unknown preference `{self.prefer}`" + did_you_mean(self.prefer, PREFERENCES))

    def numbers(self, rows: int = 1) -> array[float]:
        """Return the options of the kernel: see `serial.kernel.search.search`."""
        angular = 0.0 if self.position_only else 1.0
        kept, seed = PREFERENCES[self.prefer], self.seed % 2**53
        return array(
            "d",
            (
                LINEAR,
                angular,
                self.distance,
                self.angle,
                self.restarts,
                kept,
                rows,
                self.further,
                seed,
                self.approaches,
            ),
        )


@dataclass(frozen=True, slots=True)
class Solution:
    """A configuration for a target.

    Attributes:
        q: the positions of the variables of the chain.
        reached: whether both errors are within the tolerance.
        position_error: distance from the tip to the target [m].
        rotation_error: angle from the tip to the target [rad].
        restarts: number of random starts that were needed.
        collisions: pairs of links that collide; None if they were not checked.
    """

    q: tuple[float, ...]
    reached: bool
    position_error: float
    rotation_error: float
    restarts: int
    collisions: tuple[tuple[str, str], ...] | None = None


class SerialSolver:
    """Inverse kinematics of a chain.

    Args:
        chain: the chain.
        compiling: called with a message before the kernel is compiled.
    """

    def __init__(self, chain: SerialChain, compiling: Compiling | None = None) -> None:
        self.chain = chain
        self._compiling = compiling

    def solve(
        self,
        target: Sequence[float],
        start: Sequence[float] | None = None,
        options: SolverOptions | None = None,
        *,
        rows: int = 1,
        limits: array[float] | None = None,
    ) -> list[Solution]:
        """Return the solution for a target; with the preference ``all``, up to `rows` different ones.

        Args:
            target: x y z [m] and quaternion x y z w of the tip in the base.
            start: configuration of the first descent; see `SerialChain.start`.
            options: the options.
            rows: maximum number of solutions.
            limits: limits instead of those of the chain: see `serial.kernel.descent.LIMIT`.

        Returns:
            The solutions; the nearest configuration alone if the target cannot be reached.

        Raises:
            KinematicsError: the target is no pose.
            MissingDependencyError: numba is not installed.
        """
        chain, size = self.chain, len(self.chain.variables)
        numbers = array("d", target)
        from_ = array("d", chain.start() if start is None else start)
        settings = (options or SolverOptions()).numbers(rows)
        result = array("d", bytes(8 * rows * (size + ROW)))
        work = array("d", bytes(8 * (AXIS * len(chain.indices) + 10 * size + 8)))
        at = numbers.buffer_info()[0]
        invalid = function("solve", self._compiling)(
            chain.steps.buffer_info()[0],
            chain.indices.buffer_info()[0],
            len(chain.indices),
            size,
            (limits or chain.limits).buffer_info()[0],
            *(at, at, len(numbers), from_.buffer_info()[0], 0, settings.buffer_info()[0], 0, 1),
            *(result.buffer_info()[0], work.buffer_info()[0]),
        )
        if invalid:
            raise KinematicsError(
                "target is not a pose: its numbers must be finite and below 1e6, and its quaternion not zero"
            )
        length = size + ROW
        found = [solution_of_row(result[k : k + length], size) for k in range(0, len(result), length)]
        return [solution for solution in found if solution.reached] or found[:1]

    def manipulability(self, q: Sequence[float], *, position_only: bool = False) -> float:
        """Return Yoshikawa's measure √det(J·Jᵀ) of a configuration; see `Chain.manipulability`."""
        chain, size = self.chain, len(self.chain.variables)
        numbers, result = array("d", q), array("d", (0.0,))
        work = array("d", bytes(8 * (AXIS * len(chain.indices) + 10 * size + 8)))
        function("forward", self._compiling)(
            *(chain.steps.buffer_info()[0], chain.indices.buffer_info()[0], len(chain.indices), size),
            *(numbers.buffer_info()[0], 1, result.buffer_info()[0], 0, 12 if position_only else 4),
            work.buffer_info()[0],
        )
        return result[0]

    def with_whole_turns(self, solutions: Sequence[Solution], start: Sequence[float]) -> list[Solution]:
        """Return solutions with all combinations of whole turns that finite limits allow, nearest to `start` first."""
        found = list(solutions)
        for k, variable in enumerate(self.chain.variables):
            if not variable.is_periodic or not math.isfinite(variable.upper - variable.lower):
                continue
            found = [
                replace(solution, q=(*solution.q[:k], solution.q[k] + turns * TURN, *solution.q[k + 1 :]))
                for solution in found
                for turns in range(
                    math.ceil((variable.lower - solution.q[k]) / TURN),
                    math.floor((variable.upper - solution.q[k]) / TURN) + 1,
                )
            ]
        return sorted(found, key=lambda solution: math.dist(solution.q, start))

    def at_limits(self, q: Sequence[float]) -> list[str]:
        """Return the variables that are at a limit."""
        return [
            variable.name
            for variable, value in zip(self.chain.variables, q, strict=True)
            if min(abs(value - variable.lower), abs(value - variable.upper)) <= AT_LIMIT
        ]

    def wide_limits(self) -> array[float]:
        """Return limits for `solve` without those of turning joints; sliding joints move farther by their range."""
        limits = array("d", self.chain.limits)
        for k, variable in enumerate(self.chain.variables):
            if variable.is_periodic:
                limits[LIMIT * k : LIMIT * (k + 1)] = array("d", (-math.inf, math.inf, -math.pi, math.pi, 1.0, 1.0))
            else:
                travel = variable.upper - variable.lower
                limits[LIMIT * k : LIMIT * k + 2] = array("d", (variable.lower - travel, variable.upper + travel))
        return limits

    def reason(self, target: Sequence[float], solution: Solution, options: SolverOptions) -> str:
        """Return why a target is not reached, in words.

        The target is solved again with the limits of `wide_limits`: if it is reached then, the limits are the reason.

        Args:
            target: see `solve`.
            solution: the nearest configuration.
            options: the options it was found with.
        """
        is_near = solution.position_error <= options.distance
        if solution.collisions and is_near and (options.position_only or solution.rotation_error <= options.angle):
            return "collision " + ", ".join(f"`{first}`–`{second}`" for first, second in solution.collisions)
        free = replace(options, position_only=options.position_only or not is_near, prefer="first", approaches=0)
        wide = self.solve(target, solution.q, free, limits=self.wide_limits())[0]
        if wide.reached:
            names = self.at_limits(solution.q) or [
                variable.name
                for variable, value in zip(self.chain.variables, wide.q, strict=True)
                if not variable.lower <= value <= variable.upper
            ]
            listed = ", ".join(f"`{name}`" for name in names)
            return f"limit{'s' * (len(names) > 1)} of joint{'s' * (len(names) > 1)} {listed}"
        if is_near:
            return f"orientation: {solution.rotation_error:.3g} rad off"
        return f"beyond reach by {solution.position_error:.3g} m"


def solution_of_row(row: Sequence[float], size: int) -> Solution:
    """Return a solution as the kernel writes it; `size` is the number of variables."""
    return Solution(tuple(row[:size]), row[size + 2] > 0.0, row[size], row[size + 1], int(row[size + 3]))
