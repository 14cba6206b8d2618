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
from typing import NamedTuple

from tests.bench.fuzz.families import FAMILIES, PREPARATIONS
from tests.bench.fuzz.seed_files import ROOT
from urdfkit.errors import UrdfkitError

BUDGET = 12.0
"""CPU time of a case [s]: the limit of 10 s of the commands, and the time to report that it is exceeded."""
BYTES = 10**9
"""Memory that a case may add to that of its process."""


class Outcome(NamedTuple):
    """The outcome of a case: counts by their names, the traceback of a failure or "", and the CPU time [s]."""

    counts: Counter[str]
    failure: str
    seconds: float


class OverBudget(BaseException):
    """The budget of CPU time is used up; not an `Exception`, which the code under test might catch."""


def _stop(*_: object) -> None:
    raise OverBudget


def outcome(family: str, seed: int, folder: Path) -> Outcome:
    """Run one case."""
    signal.signal(signal.SIGVTALRM, _stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, BUDGET)
    start = time.process_time()
    counts, failure = Counter({"failed": 1}), ""
    try:
        found = FAMILIES[family](folder, random.Random(f"{family} {seed}"))
        counts = Counter({found: 1}) if isinstance(found, str) else found
    except UrdfkitError as error:
        if "\n" in str(error):
            failure = f"a message of several lines: {error}"
        elif isinstance(error.__cause__, MemoryError):
            failure = f"more than {BYTES / 1e9:g} GB: {error}"
        else:
            counts = Counter({"refused": 1})
    except OverBudget:
        failure = f"more than {BUDGET:g} s of CPU\n{traceback.format_exc(limit=-6)}"
    except MemoryError:
        failure = f"more than {BYTES / 1e9:g} GB\n{traceback.format_exc(limit=-6)}"
    except Exception:
        failure = traceback.format_exc(limit=-8)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
    return Outcome(counts, failure, time.process_time() - start)


def prepare(family: str) -> None:
    """Prepare this process for a family, and limit its memory to its size then plus `BYTES`."""
    warnings.simplefilter("ignore")
    PREPARATIONS.get(family, lambda: None)()
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
            result = outcome(family, seed, Path(name))
            if result.failure:
                failures.append((seed, result.failure))
                kept = ROOT / "artifacts" / "fuzz" / family / str(seed)
                shutil.copytree(name, kept, dirs_exist_ok=True)
        longest = max(longest, result.seconds)
        counts += result.counts
    return counts, failures, longest
