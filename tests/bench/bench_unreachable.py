"""Poses that cannot be reached: the distance of the nearest configuration, and of the best of 100 by Pinocchio.

Run it: ``python -m tests.bench.bench_unreachable [--arms NAME ...] [--poses 250] [--restarts 100] [--json]``. The peer
descends the distance alone, by Levenberg and Marquardt within the limits, with Pinocchio's poses and Jacobians.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

from tests.bench.bench_kinematics import chains
from tests.kinematics.arms import Reference, errors, random_configurations
from urdfkit.kinematics import Chain

ARMS = ("Panda", "UR5, ±π", "UR10e", "Romeo")
BEYOND = 0.3
"""Length by which the box of the targets is larger than that of reachable positions, on each side [m]."""


def unreachable(chain: Chain, count: int) -> np.ndarray:
    """Return random poses whose position no configuration reaches; shape (count, 4, 4)."""
    random = np.random.default_rng(5)
    positions = chain.forward(random_configurations(chain, 20_000, 1))[:, :3, 3]
    low, high = positions.min(axis=0) - BEYOND, positions.max(axis=0) + BEYOND
    found = np.zeros((0, 4, 4))
    while len(found) < count:
        poses = np.tile(np.eye(4), (count, 1, 1))
        poses[:, :3, 3] = random.uniform(low, high, (count, 3))
        quaternions = random.normal(size=(count, 4))
        for pose, numbers in zip(poses, quaternions / np.linalg.norm(quaternions, axis=1)[:, None], strict=True):
            pose[:3, :3] = pin.Quaternion(numbers).matrix()
        reached = chain.solve(poses, position_only=True, approach=False).reached
        found = np.concatenate([found, poses[~reached]])
    return found[:count]


class Peer:
    """Nearest positions by Pinocchio."""

    def __init__(self, chain: Chain) -> None:
        kinematics = Reference(chain).kinematics
        self.model, self.data = kinematics.model, kinematics.model.createData()
        self.tip, base = kinematics.frame(chain.tip), kinematics.frame(chain.base)
        self.q = kinematics.configuration(dict.fromkeys(chain.joint_names, 0.0))
        joints = [self.model.joints[self.model.getJointId(name)] for name in chain.joint_names]
        assert all(joint.nq == 1 for joint in joints), "a continuous joint has two numbers"
        self.q_at, self.v_at = [joint.idx_q for joint in joints], [joint.idx_v for joint in joints]
        self.lower, self.upper = chain.lower, chain.upper
        pin.framesForwardKinematics(self.model, self.data, self.q)
        self.base = self.data.oMf[base].copy()

    def distance(self, target: np.ndarray, restarts: int, random: np.random.Generator) -> float:
        """Return the distance of the nearest position found [m]."""
        goal = self.base.act(target[:3, 3])
        return min(self._descend(goal, random.uniform(self.lower, self.upper)) for _ in range(restarts))

    def _error(self, goal: np.ndarray, x: np.ndarray) -> np.ndarray:
        self.q[self.q_at] = x
        pin.forwardKinematics(self.model, self.data, self.q)
        pin.updateFramePlacement(self.model, self.data, self.tip)
        return np.asarray(self.data.oMf[self.tip].translation - goal)

    def _descend(self, goal: np.ndarray, x: np.ndarray) -> float:
        damping, error = 1e-3, self._error(goal, x)
        cost = float(error @ error)
        for _ in range(80):
            self._error(goal, x)
            jacobian = pin.computeFrameJacobian(self.model, self.data, self.q, self.tip, pin.LOCAL_WORLD_ALIGNED)
            jacobian = jacobian[:3][:, self.v_at]
            gradient = jacobian.T @ error
            held = ((x <= self.lower) & (gradient > 0.0)) | ((x >= self.upper) & (gradient < 0.0))
            jacobian = jacobian * ~held
            step = np.linalg.solve(jacobian.T @ jacobian + damping * np.eye(len(x)), jacobian.T @ error)
            tried = np.clip(x - step, self.lower, self.upper)
            next_error = self._error(goal, tried)
            fallen = cost - float(next_error @ next_error)
            if fallen > 0.0:
                x, error, cost, damping = tried, next_error, cost - fallen, max(damping / 4.0, 1e-9)
                if fallen < 1e-10 * cost:
                    break
            else:
                damping *= 4.0
                if damping > 1e4:
                    break
        return float(np.sqrt(cost))


def measured(name: str, chain: Chain, count: int, restarts: int) -> dict[str, Any]:
    """Return the figures of one arm."""
    targets = unreachable(chain, count)
    start = time.process_time()
    found = chain.solve(targets)
    seconds = time.process_time() - start
    true, _ = errors(Reference(chain).poses(found.q), targets)
    random, peer = np.random.default_rng(6), Peer(chain)
    theirs = np.array([peer.distance(target, restarts, random) for target in targets])
    return {
        "arm": name,
        "joints": len(chain.joint_names),
        "poses": count,
        "false": int((np.abs(true - found.position_error) > 1e-9).sum()),
        "farther by at most [m]": float((true - theirs).max()),
        "nearer by at most [m]": float((theirs - true).max()),
        "one [µs]": 1e6 * seconds / count,
    }


def main() -> None:
    """Measure arms and print a line each, or JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", nargs="*", default=ARMS)
    parser.add_argument("--poses", type=int, default=250)
    parser.add_argument("--restarts", type=int, default=100)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        arms = chains(Path(folder))
        rows = []
        for name in arguments.arms:
            rows.append(measured(name, arms[name], arguments.poses, arguments.restarts))
            if not arguments.json:
                cells = (f"{key} {value:.4g}" for key, value in rows[-1].items() if key != "arm")
                print(f"{name}: {', '.join(cells)}", flush=True)
    if arguments.json:
        print(json.dumps(rows))


if __name__ == "__main__":
    main()
