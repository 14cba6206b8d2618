"""Compare random xacro files with stock xacro: ``python -m tests.bench.fuzz_xacro FIRST_SEED COUNT``."""

from __future__ import annotations

import os
import sys
import tempfile
import warnings
from collections import Counter
from pathlib import Path

from tests.description.xacro.evaluation.random_files import write_files
from tests.description.xacro.evaluation.test_random_files import compare


def main() -> int:
    """Print the differences and how many files were compared."""
    first, count = map(int, sys.argv[1:3])
    warnings.simplefilter("ignore")
    found: Counter[str] = Counter()
    differences = 0
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        write_files(Path(name))
        for seed in range(first, first + count):
            if different := compare(seed, Path(name), found):
                differences += 1
                print(different)
    print(f"{found['expanded']} files expanded, {found['refused']} refused, {differences} differences")
    return bool(differences)


if __name__ == "__main__":
    sys.exit(main())
