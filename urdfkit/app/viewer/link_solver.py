"""Inverse kinematics for the page: joint positions that place a link at a pose, and the motions lost there."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from threading import Thread
from typing import Any

from urdfkit.errors import UrdfkitError
from urdfkit.kinematics import Chain
from urdfkit.kinematics.self_collision.collision_free_search import CollisionFreeSearch
from urdfkit.kinematics.serial.serial_solver import SerialSolver, Solution, SolverOptions
from urdfkit.view.protocol.page_requests import Schema, flag, numbers, text

TOLERANCE = (1e-4, 1e-3)
"""Distance [m] and angle [rad] within which a pose is reached: less than a pixel."""
RESTARTS = 40
"""Random starts per move of the handle; a quarter of a second has time for ten moves of a pose beyond reach."""
MOST, FOUND = 32, 256
"""Solutions offered to choose from, and those found of which they are chosen."""
DISTINCT = 0.5
"""Difference [rad or m] of some joint between any two solutions offered: redundant arms have infinitely many."""
BETTER = (1e-3, 0.02)
"""Distance [m] and angle [rad] by which another configuration must be nearer to a pose beyond reach than that of the
descent from the present one; otherwise joints would jump between configurations that are equally near."""


def request_schemas() -> dict[str, Schema]:
    """Return the requests of the page: a link and the pose in the root link that it is to have, and a link's map."""
    flags = dict.fromkeys(("turn", "limits", "collision_free", "all"), flag)
    return {
        "ik": Schema({"link": text()}, {"pose": numbers(7), **flags}, changes=False),
        "reach": Schema({"link": text()}, changes=False),
    }


class LinkSolver:
    """Inverse kinematics of the links of one robot, by the solver of ``urdfkit ik``.

    Args:
        robot: the robot, one tree.
    """

    def __init__(self, robot: Any) -> None:
        self._robot = robot
        self._chains: dict[str, tuple[Mapping[str, float], Chain]] = {}
        self._searches: dict[str, CollisionFreeSearch] = {}

    def answer(self, values: Mapping[str, Any], positions: Mapping[str, float]) -> dict[str, Any]:
        """Return the answer to a request `ik`; see docs/protocol.md.

        Args:
            values: of the request.
            positions: joint → present position [rad] or [m].

        Raises:
            UrdfkitError: an unknown link, no joint moves it, or a mesh for the check of collisions cannot be read.
        """
        if not kernel_is_ready():
            return {"ready": False, "missing": str(_failures[0]) if _failures else None}
        chain = self.chain(values["link"], positions)
        start = chain.serial.start({name: positions[name] for name in chain.joint_names})
        turn = values.get("turn", True)
        found = self._solutions(chain, values, start, positions, turn) if "pose" in values else []
        q = found[0].q if found else start
        return {
            "ready": True,
            "solutions": [dict(zip(chain.joint_names, each.q, strict=True)) for each in found],
            "reached": bool(found and found[0].reached),
            "position_error": found[0].position_error if found else 0.0,
            "rotation_error": found[0].rotation_error if found else 0.0,
            "collisions": [list(pair) for pair in found[0].collisions or ()] if found else [],
            "reason": self._reason(chain, values, found[0], turn) if found and not found[0].reached else None,
            "lost": lost_motions(chain, q, turn=turn),
        }

    def chain(self, link: str, positions: Mapping[str, float]) -> Chain:
        """Return the chain from the root to a link, whose planar and floating joints stay where they are.

        Raises:
            KinematicsError: an unknown link, or no joint moves it.
        """
        held = {name: value for name, value in positions.items() if name not in self._robot.joint_by_name}
        kept = self._chains.get(link)
        if kept is None or kept[0] != held:
            self._chains[link] = kept = (held, Chain(self._robot, None, link, hold=held))
            self._searches.pop(link, None)
        return kept[1]

    def _solutions(
        self,
        chain: Chain,
        values: Mapping[str, Any],
        start: Sequence[float],
        positions: Mapping[str, float],
        turn: bool,
    ) -> list[Solution]:
        """Return all solutions, nearest first, or the one for the next move of a handle."""
        solver = SerialSolver(chain.serial)
        limits = None if values.get("limits", True) else solver.wide_limits()
        options = SolverOptions(not turn, *TOLERANCE, "nearest", RESTARTS)
        pose = values["pose"]
        search = self._search(values["link"], chain, positions) if values.get("collision_free") else None
        if values.get("all"):
            every = replace(options, prefer="all", restarts=5 * RESTARTS)
            found = solver.solve(pose, start, every, rows=FOUND, limits=limits)
            found = search.filtered(found) if search else found
            return _distinct(solver.with_whole_turns(found, start)) if found[0].reached else found
        [best] = solver.solve(pose, start, replace(options, restarts=0, approaches=1), limits=limits)
        if not best.reached:
            [other] = solver.solve(pose, start, options, limits=limits)
            nearer = other.position_error < best.position_error - BETTER[0]
            better = other.position_error < best.position_error + BETTER[0] and turn
            if other.reached or nearer or (better and other.rotation_error < best.rotation_error - BETTER[1]):
                best = other
        return [search.free(best, pose, start, options) if search else best]

    def _search(self, link: str, chain: Chain, positions: Mapping[str, float]) -> CollisionFreeSearch:
        search = self._searches.get(link)
        if search is None:
            self._searches[link] = search = CollisionFreeSearch(chain.serial)
        search.check.hold({name: value for name, value in positions.items() if name not in chain.joint_names})
        return search

    def _reason(self, chain: Chain, values: Mapping[str, Any], best: Solution, turn: bool) -> str:
        return SerialSolver(chain.serial).reason(
            values["pose"], best, SolverOptions(not turn, *TOLERANCE, restarts=RESTARTS)
        )


def _distinct(solutions: Sequence[Solution]) -> list[Solution]:
    """Return solutions that differ clearly, in the same order."""
    kept: list[Solution] = []
    for one in solutions:
        if all(max(abs(a - b) for a, b in zip(one.q, other.q, strict=True)) > DISTINCT for other in kept):
            kept.append(one)
    return kept[:MOST]


def lost_motions(chain: Chain, q: Sequence[float], *, turn: bool) -> list[dict[str, Any]]:
    """Return the motions of the tip that no joints cause at a configuration: `direction`, linear first, and `words`."""
    import numpy as np

    from urdfkit.kinematics.jacobian_analysis import analyse, direction_in_words

    jacobian = chain.jacobian(q)
    twists = analyse(jacobian if turn else jacobian[:3]).lost
    twists = np.pad(twists, ((0, 0), (0, 6 - twists.shape[1])))
    return [{"direction": twist.tolist(), "words": direction_in_words(twist, chain.base)} for twist in twists]


_loading: list[Thread] = []
_failures: list[UrdfkitError] = []


def kernel_is_ready() -> bool:
    """Return whether the solver is loaded; the first call loads it, or compiles it without waiting."""
    if not _loading:
        _loading.append(Thread(target=_load, name="solver", daemon=True))
        _loading[0].start()
        _loading[0].join(0.2)  # loading takes milliseconds; compiling, once per machine, seconds
    return not (_failures or _loading[0].is_alive())


def _load() -> None:
    from urdfkit.kinematics.serial.kernel.native_code import function

    try:
        for name in ("solve", "forward"):
            function(name)
    except UrdfkitError as error:
        _failures.append(error)
