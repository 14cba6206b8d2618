"""Measure the scenes in urdfkit's engine and in MuJoCo, in turns, and print a table."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray

from tests.bench.contact_rich.scenes import Case, cases
from tests.bench.peers.engine_scene import InUrdfkit
from tests.bench.peers.mujoco_scene import Built, InMujoco, Settings
from tests.bench.peers.scene import DT, Running

BLOCK = 50
"""Steps of a call; the slowest block is compared with the mean."""
EVEN = 4.0
"""Largest ratio of the slowest block to the mean that is intended."""
CANDIDATES = [
    Settings(integrator, solver, cone)
    for integrator in ("implicitfast", "Euler", "discrete")
    for solver, cone in (("Newton", "pyramidal"), ("Newton", "elliptic"), ("CG", "pyramidal"), ("PGS", "pyramidal"))
]
"""Settings of MuJoCo that are tried."""


@dataclass(frozen=True, slots=True)
class Result:
    """CPU times of the blocks of a scene [s per step], and whether the scene ended as it must."""

    blocks: NDArray[np.float64]
    right: bool

    @property
    def mean(self) -> float:
        """Mean time of a step [µs]."""
        return float(1e6 * self.blocks.mean())


def measure(running: Running, case: Case) -> Result:
    """Run a scene from its start; time the blocks of its span."""
    running.advance(round(case.settle / DT))
    if case.push:
        for k in range(len(case.scene.things)):
            running.knock(k, case.push * (-1) ** k)
    times = []
    for _ in range(round(case.span / DT / BLOCK)):
        start = time.process_time()
        running.advance(BLOCK)
        times.append((time.process_time() - start) / BLOCK)
    return Result(np.array(times), all(check.ok for check in case.scene.check(running)))


def choose(case: Case) -> tuple[Settings, bool]:
    """Return the fastest settings of MuJoCo with which a scene ends as it must, and whether there are any."""
    built = Built(case.scene)
    found = []
    for settings in _candidates(case):
        result = measure(InMujoco(built, settings), case)
        found.append((not result.right, result.mean, settings))
    wrong, _, best = min(found, key=lambda each: each[:2])
    return best, not wrong


def _candidates(case: Case) -> Iterator[Settings]:
    import mujoco

    for each in CANDIDATES:
        # PGS never is the fastest for hundreds of boxes, but takes minutes.
        slow = case.scene.loose and each.solver == "PGS"
        if not slow and hasattr(mujoco.mjtIntegrator, f"mjINT_{each.integrator.upper()}"):
            yield Settings(each.integrator, each.solver, each.cone, sleep=case.sleep)


def compare(case: Case, rounds: int) -> str:
    """Return the line of a scene."""
    settings, right = choose(case)
    built = Built(case.scene)
    ours, theirs, iterated = [], [], 0
    for _ in range(rounds):
        running = InUrdfkit(case.scene, sleep=case.sleep)
        ours.append(measure(running, case))
        iterated = running.engine.iterated
        theirs.append(measure(InMujoco(built, settings), case))
    # Each round computes the same, so the least time of a block is the one without disturbance.
    blocks, peer = (np.min([each.blocks for each in engine], axis=0) for engine in (ours, theirs))
    ratio = median(b.mean / a.mean for a, b in zip(ours, theirs, strict=True))
    worst = blocks.max() / blocks.mean()
    misses = {"ratio": ratio < case.target, "uneven": worst > EVEN, "wrong": not ours[0].right}
    missed = ", ".join(name for name, is_missed in misses.items() if is_missed)
    return (
        f"{case.scene.name:22s} {1e6 * blocks.mean():9.1f} {1e6 * blocks.max():9.1f} {worst:6.1f} {iterated:7d} "
        f"{1e6 * peer.mean():9.1f} {peer.max() / peer.mean():6.1f} {ratio:7.2f} {case.target:6.1f}  "
        f"{settings}{'' if right else ' (wrong)'}{missed and f'; missed: {missed}'}"
    )


def main(argv: Sequence[str] | None = None) -> int:
    """Measure the named scenes, or all."""
    for name in ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    parser = argparse.ArgumentParser(prog="python -m tests.bench.contact_rich", description=__doc__)
    parser.add_argument("scene", nargs="*", help="names, or the starts of names; all scenes without any")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args(argv)
    print(
        "µs per step                urdfkit   slowest  /mean  hard      MuJoCo  /mean   ratio target  settings",
        flush=True,
    )
    for case in cases():
        if not options.scene or case.scene.name.startswith(tuple(options.scene)):
            print(compare(case, options.rounds), flush=True)
    return 0
