"""The simulator around the engine, beside the engine alone: simulated seconds per CPU second, in turns.

Run it as ``python tests/bench/bench_sim.py [ROBOT] [SECONDS] [RUNS]``. The robot drives a circle at 0.5 m/s.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable

from urdfkit.messages import JOINT_STATE, ODOMETRY, TF
from urdfkit.sim import Simulator


def main() -> int:
    robot = sys.argv[1] if len(sys.argv) > 1 else "simpleton"
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 9
    quiet, heard = (Simulator(robot, note=lambda text: None) for _ in range(2))
    for topic, kind in (("/joint_states", JOINT_STATE), ("/tf", TF), ("/simpleton/odom", ODOMETRY)):
        heard.subscribe(topic, kind, lambda message: None)
    for simulator in (quiet, heard):
        simulator.command((0.5, 0.0, 0.0), (0.0, 0.0, 0.5))
        simulator.run(1.0)
    engine = quiet._engine
    steps = round(seconds / engine.dt)
    cases: dict[str, Callable[[], None]] = {
        "engine alone, one call": lambda: engine.step(steps),
        "simulator, nobody listens": lambda: quiet.run(seconds),
        "simulator, three topics heard": lambda: heard.run(seconds),
    }
    timings: dict[str, list[float]] = {name: [] for name in cases}
    for _ in range(runs):
        for name, case in cases.items():
            begin = time.process_time()
            case()
            timings[name].append(seconds / (time.process_time() - begin))
    for name, rates in timings.items():
        print(f"{name:30s} {statistics.median(rates):6.0f} × real time")
    return 0


if __name__ == "__main__":
    sys.exit(main())
