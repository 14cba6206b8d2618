"""Every robot driven at random through a house for a long time, and what must hold all the while.

Run it: ``python tests/bench/soak [ROBOT …] [--minutes 30] [--jobs 1] [--seed 0] [--json]`` (``make soak``). A new
command every 0.5 to 3 s, with a rest every minute; a robot that fell over or drove away is put back, as a driver would.
Legged robots, whose joints get random positions, may lie. Each robot runs in a process of its own, so that memory is
measured by itself. Ctrl-C ends it with a report of what was covered. Exit code 1 where something did not hold.
"""

from __future__ import annotations

import argparse
import json
import signal
import subprocess
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[3]))

from soak.found import line
from soak.run import ENOUGH, LEGGED, soak
from urdfkit.resources import robot_names


def in_processes(robots: list[str], arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Run each robot in a process of its own, some at a time; its first minute twice, which must be the same."""
    waiting, running, done = list(robots), {}, []
    while running or (waiting and not ENOUGH.is_set()):
        if ENOUGH.is_set():
            for process in running.values():
                process.terminate()
        while waiting and len(running) < arguments.jobs and not ENOUGH.is_set():
            robot = waiting.pop(0)
            command = [sys.executable, str(Path(__file__).parent), robot, "--here", "--seed", str(arguments.seed)]
            command += ["--minutes", str(arguments.minutes)]
            running[robot] = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        for robot, process in list(running.items()):
            if process.poll() is None:
                continue
            del running[robot]
            out = process.stdout.read() if process.stdout else ""
            result = json.loads(out) if out else {"robot": robot, "wrong": {"crashed": 1}}
            done.append(result)
            print(line(result), file=sys.stderr, flush=True)
        time.sleep(0.2)
    return done


def main() -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="all when left out")
    parser.add_argument("--minutes", type=float, default=30.0, help="simulated, each (default: 30)")
    parser.add_argument("--jobs", type=int, default=1, help="robots at a time (default: 1)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ENOUGH.set())
    if arguments.here:
        found = soak(arguments.robots[0], minutes=arguments.minutes, seed=arguments.seed)
        if not found.wrong and not ENOUGH.is_set():
            again = soak(arguments.robots[0], minutes=min(1.0, arguments.minutes), seed=arguments.seed)
            if again.digest != found.digest and not ENOUGH.is_set():
                found.fault("not deterministic", 60.0, "the first minute, run again, is another")
        print(json.dumps(asdict(found)))
        return 1 if found.wrong else 0
    results = in_processes(arguments.robots or [*robot_names(), *LEGGED], arguments)
    if arguments.json:
        print(json.dumps(results, indent=1))
    return 1 if any(result["wrong"] for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
