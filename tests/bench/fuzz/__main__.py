"""Read changed files by the thousand: ``python -m tests.bench.fuzz FAMILY [COUNT] [SEED]``.

Each seed is one case of a family (`families.FAMILIES`). The cases run in two worker processes with limits of CPU time
and memory. A traceback, a message of several lines, more CPU than the budget or more than 1 GB of memory is a failure;
its file is kept in ``artifacts/fuzz/FAMILY/SEED`` and ``python -m tests.bench.fuzz FAMILY 1 SEED`` repeats it.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
from collections import Counter

from tests.bench.fuzz.families import FAMILIES
from tests.bench.fuzz.runner import prepare, work


def main() -> int:
    """Run the cases and print the counts and the failures."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.fuzz", description=__doc__)
    parser.add_argument("family", choices=FAMILIES)
    parser.add_argument("count", type=int, nargs="?", default=1000)
    parser.add_argument("seed", type=int, nargs="?", default=0)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    end = options.seed + options.count
    jobs = [(options.family, n, min(n + 50, end)) for n in range(options.seed, end, 50)]
    counts: Counter[str] = Counter()
    longest = 0.0
    context = multiprocessing.get_context("spawn")
    with context.Pool(options.jobs, prepare, (options.family,), maxtasksperchild=10) as pool:
        for some, failures, slowest in pool.imap_unordered(work, jobs):
            counts += some
            longest = max(longest, slowest)
            for seed, what in failures:
                print(f"seed {seed}: {what}", flush=True)
    print(f"{options.family}: {options.count} cases from seed {options.seed}: {dict(counts)}; longest {longest:.2f} s")
    return 1 if counts["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
