"""Reach maps: CPU time, share of the poses that 100 restarts find, and solutions by Pinocchio.

Run it: ``python -m tests.bench.bench_reach [--arms NAME ...] [--poses 20000] [--resolution 0.05] [--json]``. The poses
compared are drawn from the grid of each map and three cells around it.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from tests.bench.bench_kinematics import TOLERANCE, chains
from tests.kinematics.arms import Reference, errors
from urdfkit.kinematics import Chain, ReachMap, reach_map
from urdfkit.linear_algebra import rotations

MARGIN = 3
CHECKED = 5000
"""Solutions compared with Pinocchio."""


def matrices(found: ReachMap, cells: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Return poses at the centres of cells (K, 3), which may lie outside the grid; shape (K, 4, 4)."""
    poses = np.tile(np.eye(4), (len(cells), 1, 1))
    poses[:, :3, 3] = found.origin + found.resolution * (cells + 0.5)
    poses[:, :3, :3] = rotations(found.orientations)[turns]
    return poses


def measured(name: str, chain: Chain, number: int, resolution: float) -> dict[str, Any]:
    """Return the figures of one arm."""
    start = time.process_time()
    found = reach_map(chain, resolution=resolution)
    seconds = time.process_time() - start
    random = np.random.default_rng(17)
    shape = np.array(found.score.shape)
    cells = random.integers(-MARGIN, shape + MARGIN, (number, 3))
    turns = random.integers(0, len(found.orientations), number)
    start = time.process_time()
    truth = chain.solve(matrices(found, cells, turns), restarts=100, seed=99, approach=False).reached
    per_pose = (time.process_time() - start) / number
    inside = ((cells >= 0) & (cells < shape)).all(axis=1)
    ours = np.zeros(number, dtype=bool)
    ours[inside] = found.reached[(*cells[inside].T, turns[inside])]
    where = np.argwhere(found.reached)
    where = where[random.permutation(len(where))[:CHECKED]]
    q = found.q[tuple(where.T)]
    distance, angle = errors(Reference(chain).poses(q), matrices(found, where[:, :3], where[:, 3]))
    right = (distance <= TOLERANCE[0]) & (angle <= TOLERANCE[1])
    right &= (q >= chain.lower).all(axis=1) & (q <= chain.upper).all(axis=1)
    return {
        "arm": name,
        "joints": len(chain.joint_names),
        "cells": int(np.prod(shape)),
        "reached": int(found.reached.sum()),
        "cpu [s]": seconds,
        "100 restarts [s]": per_pose * found.reached.size,
        "compared": int(truth.sum()),
        "share": float(ours[truth].mean()),
        "in the map only": int((ours & ~truth).sum()),
        "false": int((~right).sum()),
    }


def main() -> None:
    """Measure arms and print a line each, or JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", nargs="*")
    parser.add_argument("--poses", type=int, default=20_000)
    parser.add_argument("--resolution", type=float, default=0.05)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        arms = chains(Path(folder))
        rows = []
        for name in arguments.arms or arms:
            rows.append(measured(name, arms[name], arguments.poses, arguments.resolution))
            if not arguments.json:
                cells = (f"{key} {value:.4g}" for key, value in rows[-1].items() if key != "arm")
                print(f"{name}: {', '.join(cells)}", flush=True)
    if arguments.json:
        print(json.dumps(rows))


if __name__ == "__main__":
    main()
