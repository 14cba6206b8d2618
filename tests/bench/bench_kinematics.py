"""Inverse and forward kinematics: success by Pinocchio, and CPU time next to roboticstoolbox's C++ solver, in turns.

Run it: ``python -m tests.bench.bench_kinematics [--targets 1000] [--json]``. roboticstoolbox is optional; it gets the
same chains as elementary transforms, the same targets and the same tolerance, and its best solver, Levenberg-Marquardt
with Chan's damping. Times are CPU time of the process; each turn solves all targets with both, and medians count.
"""

from __future__ import annotations

import argparse
import json
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from tests.kinematics.arms import ROBOTS, Reference, errors, random_configurations
from urdfkit import load
from urdfkit.cli import main as urdfkit
from urdfkit.kinematics import Chain

CORPUS = ROBOTS.parents[1]
TOLERANCE = (1e-3, 1.745e-3)


def chains(folder: Path) -> dict[str, Chain]:
    """Return nine arms: of the corpus, bundled, and new ones."""
    for joints in (6, 7):
        urdfkit(
            ["new", "robot", f"made{joints}", "--arm", str(joints), "--drive", "none", "--into", str(folder), "-yq"]
        )
    ur = CORPUS / "Universal_Robots_ROS2_Description/urdf/ur.urdf.xacro"
    return {
        "Panda": Chain(ROBOTS / "panda_description/urdf/panda.urdf", "panda_link0", "panda_hand"),
        "FR3": Chain(CORPUS / "franka_description/robots/fr3/fr3.urdf.xacro", "base", "fr3_hand_tcp"),
        "UR5": Chain(ROBOTS / "ur_description/urdf/ur5_robot.urdf", "base_link", "tool0"),
        "UR5, ±π": Chain(ROBOTS / "ur_description/urdf/ur5_joint_limited_robot.urdf", "base_link", "tool0"),
        "UR10e": Chain(load(ur, arguments={"ur_type": "ur10e", "name": "ur"}), "base_link", "tool0"),
        "Romeo": Chain(ROBOTS / "romeo_description/urdf/romeo.urdf", "base_link", "r_wrist"),
        "seven_dof_arm": Chain("seven_dof_arm", "world", "grasping_frame"),
        "new, 6 joints": Chain(str(folder / "made6_description"), "world", "hand_roll_link"),
        "new, 7 joints": Chain(str(folder / "made7_description"), "world", "hand_roll_link"),
    }


def peer(chain: Chain) -> Any:
    """Return the chain for roboticstoolbox; None where it is not installed."""
    try:
        from roboticstoolbox import ET, ETS
    except ImportError:
        return None
    steps = np.array(chain.serial.steps)
    parts = []
    for k in range(len(chain.serial.indices) + 1):
        numbers = steps[16 * k : 16 * k + 12]
        fixed = np.eye(4)
        fixed[:3, :3], fixed[:3, 3] = numbers[:9].reshape(3, 3), numbers[9:]
        parts.append(ET.SE3(fixed))
        if k < len(chain.serial.indices):
            j = chain.serial.indices[k]
            limits = {"qlim": [max(chain.lower[j], -np.pi), min(chain.upper[j], np.pi)]}
            parts.append(ET.Rz(**limits) if steps[16 * k + 12] else ET.tz(**limits))
    return ETS(parts)


def each(solve: Any, targets: np.ndarray) -> tuple[list[float], list[Any]]:
    """Return the CPU time of each call [s] and the results."""
    times, results = [], []
    for target in targets:
        start = time.process_time_ns()
        results.append(solve(target))
        times.append(1e-9 * (time.process_time_ns() - start))
    return times, results


def measured(name: str, chain: Chain, number: int) -> dict[str, Any]:
    """Return the figures of one arm."""
    targets = chain.forward(random_configurations(chain, number, 11))
    found = chain.solve(targets)
    distance, angle = errors(Reference(chain).poses(found.q), targets)
    right = (distance <= TOLERANCE[0]) & (angle <= TOLERANCE[1])
    right &= (found.q >= chain.lower).all(axis=1) & (found.q <= chain.upper).all(axis=1)
    row = {
        "arm": name,
        "joints": len(chain.joint_names),
        "reached": float((found.reached & right).mean()),
        "false": int((found.reached & ~right).sum()),
    }
    ets = peer(chain)
    turns: dict[str, list[float]] = {"ours": [], "theirs": []}
    reached = 0
    for _ in range(3):
        times, _ = each(chain.solve, targets)
        turns["ours"].append(statistics.median(times))
        if ets is not None:
            # Its own error is half a square sum: 1e-6 is about our tolerance.
            times, results = each(lambda target: ets.ik_LM(target, tol=1e-6, k=0.1, method="chan"), targets)
            turns["theirs"].append(statistics.median(times))
            reached = sum(bool(np.all(result.success)) for result in results)
    row["one [µs]"] = 1e6 * statistics.median(turns["ours"])
    if ets is not None:
        row["roboticstoolbox [µs]"] = 1e6 * statistics.median(turns["theirs"])
        row["roboticstoolbox reached"] = reached / number
        row["ratio"] = row["roboticstoolbox [µs]"] / row["one [µs]"]
    many = chain.forward(random_configurations(chain, 10_000, 12))
    row["10,000 poses [s]"] = cpu(lambda: chain.solve(many))
    return row


def cpu(call: Any, turns: int = 5) -> float:
    """Return the median CPU time of a call [s]."""
    times = []
    for _ in range(turns):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return statistics.median(times)


def forward(chain: Chain) -> dict[str, float]:
    """Return microseconds per configuration of 100,000, and the difference from Pinocchio."""
    q = random_configurations(chain, 100_000, 13)
    expected = Reference(chain).poses(q[:1000])
    return {
        "forward [µs]": 10.0 * cpu(lambda: chain.forward(q)),
        "forward and Jacobian [µs]": 10.0 * cpu(lambda: chain.forward_and_jacobian(q)),
        "difference from Pinocchio": float(np.abs(chain.forward(q[:1000]) - expected).max()),
    }


def main() -> None:
    """Measure all arms and print a table, or JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--targets", type=int, default=1000)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        arms = chains(Path(folder))
        rows = []
        for name, chain in arms.items():
            rows.append(measured(name, chain, arguments.targets))
            if not arguments.json:
                cells = (f"{key} {value:.4g}" for key, value in rows[-1].items() if key != "arm")
                print(f"{name}: {', '.join(cells)}", flush=True)
        batched = forward(arms["Panda"])
    if arguments.json:
        print(json.dumps({"arms": rows, "forward": batched}))
    else:
        print(", ".join(f"{key} {value:.3g}" for key, value in batched.items()))


if __name__ == "__main__":
    main()
