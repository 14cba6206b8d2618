"""Threads with which a driver draws on the processor: they leave time to the simulation.

Mesa's llvmpipe draws with a thread for each core, and commands and odometry wait until an image is drawn. With one
thread less and a lower priority, 99 of 100 commands to a robot with a camera of 800 × 800 pixels at 30 Hz showed their
effect within 8.9 instead of 12.1 ms (Foxglove) and 11.7 instead of 14.7 ms (rosbridge; two cores).
"""

import os
from contextlib import suppress
from pathlib import Path

COUNT = "LP_NUM_THREADS"
"""Variable of Mesa with the number of threads."""
NICENESS = 10
"""Niceness of the threads; that of a process is 0, and 19 is the lowest priority."""


def leave_a_core() -> None:
    """Let contexts that are made from now on draw with one thread less than there are cores.

    A number that the user has set is kept.
    """
    os.environ.setdefault(COUNT, str(max(1, (os.cpu_count() or 1) - 1)))


def lower_priority(threads: Path = Path("/proc/self/task")) -> None:
    """Lower the priority of the drawing threads of this process; without ``/proc``, nothing happens."""
    with suppress(OSError):
        for thread in threads.iterdir():
            with suppress(OSError):  # a thread has ended
                if (thread / "comm").read_text().startswith("llvmpipe"):
                    os.setpriority(os.PRIO_PROCESS, int(thread.name), NICENESS)
