"""Runs cases in worker processes with limits of CPU time and memory."""

from __future__ import annotations

import os
import random
import resource
import shutil
import signal
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path

from tests.bench.fuzz.families import FAMILIES
from tests.bench.fuzz.seed_files import ROOT
from urdfkit.errors import UrdfkitError

BUDGET = 12.0
"""CPU time of a case [s]: the limit of 10 s of the commands, and the time to report that it is exceeded."""
BYTES = 10**9
"""Memory that a case may add to that of its process."""

Result = tuple[str, float]


class OverBudget(BaseException):
    """The budget of CPU time is used up; not an `Exception`, which the code under test might catch."""


def _stop(*_: object) -> None:
    raise OverBudget


def outcome(family: str, seed: int, folder: Path) -> Result:
    """Run one case.

    Returns:
        ``refused``, a word of the family for success, or a failure, which begins with ``FAILED``; and its CPU time [s].
    """
    signal.signal(signal.SIGVTALRM, _stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, BUDGET)
    start = time.process_time()
    try:
        word = FAMILIES[family](folder, random.Random(f"{family} {seed}"))
    except UrdfkitError as error:
        word = "refused" if "\n" not in str(error) else f"FAILED: a message of several lines: {error}"
    except OverBudget:
        word = f"FAILED: more than {BUDGET:g} s of CPU\n{traceback.format_exc(limit=-6)}"
    except MemoryError:
        word = f"FAILED: more than {BYTES / 1e9:g} GB\n{traceback.format_exc(limit=-6)}"
    except Exception:
        word = f"FAILED\n{traceback.format_exc(limit=-8)}"
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
    return word, time.process_time() - start


def limit_memory() -> None:
    """Limit the memory of this process to its current size plus `BYTES`."""
    warnings.simplefilter("ignore")
    used = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    resource.setrlimit(resource.RLIMIT_AS, (used + BYTES, used + BYTES))


def work(job: tuple[str, int, int]) -> tuple[Counter[str], list[tuple[int, str]], float]:
    """Run the cases of a range of seeds; return the outcomes, the failures and the longest CPU time."""
    family, first, last = job
    counts: Counter[str] = Counter()
    failures = []
    longest = 0.0
    for seed in range(first, last):
        with tempfile.TemporaryDirectory() as name:
            word, seconds = outcome(family, seed, Path(name))
            longest = max(longest, seconds)
            if word.startswith("FAILED"):
                failures.append((seed, word))
                kept = ROOT / "artifacts" / "fuzz" / family / str(seed)
                shutil.copytree(name, kept, dirs_exist_ok=True)
        counts[word if not word.startswith("FAILED") else "failed"] += 1
    return counts, failures, longest
