"""Solutions of inverse kinematics in which no links collide."""

from collections.abc import Sequence
from dataclasses import replace
from math import dist

from urdfkit.kinematics.self_collision.configuration_check import ConfigurationCheck
from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import SerialSolver, Solution, SolverOptions, solution_of_row
from urdfkit.linear_algebra import Array

MOST = 256
"""Different solutions of a target that one search compares."""
SEARCHES = 4
"""Searches with different random streams for a chain with more solutions than `POSTURES`, which has infinitely many."""
POSTURES = 16
"""Maximum number of solutions of six turning joints."""


class CollisionFreeSearch:
    """Search for solutions of a chain without collisions; see `ConfigurationCheck` for the pairs that are checked.

    Args:
        chain: the chain; joints that it holds stay there.

    Raises:
        ResourceError: a mesh of a collision shape cannot be read.
    """

    def __init__(self, chain: SerialChain) -> None:
        self._names = [variable.name for variable in chain.variables]
        self.check = ConfigurationCheck(chain.robot, self._names, chain.hold)
        self._solver = SerialSolver(chain)

    def checked(self, solution: Solution) -> Solution:
        """Return a solution with its collisions."""
        collisions = self.check.collisions(dict(zip(self._names, solution.q, strict=True)))
        return replace(solution, collisions=collisions)

    def filtered(self, found: Sequence[Solution]) -> list[Solution]:
        """Return the solutions without collisions; the first one, not reached, if all collide."""
        every = [self.checked(solution) for solution in found]
        free = [solution for solution in every if solution.reached and not solution.collisions]
        return free or [replace(every[0], reached=False)]

    def improve(
        self, rows: Array, targets: Array, starts: Array, options: SolverOptions
    ) -> list[tuple[tuple[str, str], ...]]:
        """Replace solutions with collisions by others; return the collisions of each.

        Args:
            rows: solutions as the kernel writes them, changed in place; shape (N, n + `ROW`).
            targets: shape (N, 7) or (N, 16).
            starts: shape (N, n).
            options: see `SerialSolver.solve`.
        """
        collisions = []
        size = len(self._names)
        for row, target, start in zip(rows, targets.tolist(), starts.tolist(), strict=True):
            found = solution_of_row(row.tolist(), size)
            best = self.free(found, target, start, options)
            row[:size], row[size : size + 2] = best.q, (best.position_error, best.rotation_error)
            row[size + 2 : size + 4] = float(best.reached), best.restarts
            collisions.append(best.collisions or ())
        return collisions

    def free(
        self, found: Solution, target: Sequence[float], start: Sequence[float], options: SolverOptions
    ) -> Solution:
        """Return a solution without collisions: the given one or another.

        Args:
            found: the solution without regard to collisions.
            target: see `SerialSolver.solve`.
            start: see `SerialSolver.solve`.
            options: see `SerialSolver.solve`.

        Returns:
            The solution; of others that with the largest manipulability, if `options` prefer it, or the nearest to
            the start; `found`, not reached, if all collide.
        """
        found = self.checked(found)
        if not found.reached or not found.collisions:
            return found

        def rank(other: Solution) -> float:
            if options.prefer == "manipulability":
                return -self._solver.manipulability(other.q, position_only=options.position_only)
            return dist(other.q, start)

        for k in range(SEARCHES):
            every = replace(options, prefer="all", seed=options.seed + k, approaches=0)
            others = self._solver.solve(target, start, every, rows=MOST)
            free = (other for other in map(self.checked, others) if other.reached and not other.collisions)
            if (best := min(free, key=rank, default=None)) is not None:
                return best
            if len(others) <= POSTURES:
                break
        return replace(found, reached=False)
