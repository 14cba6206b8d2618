"""Memory of a running simulation, measured in a process of its own: ``python -m tests.bench.peers.memory_use``."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from urdfkit.errors import SimulationError

ROBOT, WORLD = "simpleton", "house"
SECONDS = 10.0
"""Simulated time after which it is read [s]."""
MOST = 350e6
"""What it may be [bytes]."""
ROOT = Path(__file__).parents[3]
"""Folder from which the modules of tests/ can be imported."""
PATIENCE = 300.0
"""Wall seconds the process may take."""


@dataclass(frozen=True, slots=True)
class Memory:
    """Memory of a process [bytes]: what it holds, and the most it ever held."""

    resident: int
    peak: int


def measure() -> Memory:
    """Drive through the house in a fresh process and return its memory.

    Raises:
        SimulationError: the process failed, or the system does not tell.
    """
    done = subprocess.run(
        [sys.executable, "-m", "tests.bench.peers.memory_use"],
        capture_output=True,
        text=True,
        cwd=ROOT,
        timeout=PATIENCE,
        check=False,
    )
    if done.returncode:
        reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        raise SimulationError(f"the process whose memory was to be measured failed: {reason}")
    return Memory(**json.loads(done.stdout))


def drive() -> None:
    """Drive in a slow circle for a while."""
    from urdfkit.sim import Simulator

    simulator = Simulator(ROBOT, world=WORLD, note=lambda text: None)
    simulator.command((0.3, 0.0, 0.0), (0.0, 0.0, 0.5))
    simulator.run(SECONDS)


def own() -> Memory:
    """Return the memory of this process.

    Raises:
        SimulationError: the system does not tell.
    """
    status = Path("/proc/self/status")
    if status.exists():  # Linux
        lines = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
        return Memory(*(int(lines[name].split()[0]) * 1024 for name in ("VmRSS", "VmHWM")))
    if sys.platform == "darwin":
        import resource

        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # in bytes there; the present is not told
        return Memory(peak, peak)
    raise SimulationError("this system does not tell how much memory a process holds; Linux and macOS do")


if __name__ == "__main__":
    drive()
    memory = own()
    print(json.dumps({"resident": memory.resident, "peak": memory.peak}))
