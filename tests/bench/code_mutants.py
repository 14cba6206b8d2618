"""Random mutants of urdfkit's own code: do the tests that cover the changed line notice them?

First record which test covers which lines. The recording runs the tests once, in a copy of the checkout whose functions
mark the blocks that they reach, in about 1.4 times the CPU time of the tests; programs that a test starts count too. A
program that outlives the test that starts it, such as a server of a fixture, counts for each test of the file.
Further calls add tests or replace them::

    python -m tests.bench.code_mutants record -m "not slow and not browser and not catkin and not colcon"
    python -m tests.bench.code_mutants record tests/lint/test_rules.py

Then try mutants::

    python -m tests.bench.code_mutants try [COUNT] [SEED] [FOLDER…]

It draws expressions at random on the covered lines of these folders (such as `urdfkit/sim`; without any, of the
package), changes one comparison, operator, constant, boolean or returned value in another copy, and runs the tests
that cover the line there, those of the module's own test file first, for up to a minute of CPU time. Modules with
compiled kernels are ignored: a change would compile them again. Only tests that pass without a change are used, and the
tests that noticed a mutant run once more without one at the end. Prints each mutant that no test notices, and the share
noticed by package. Exits with status 1 below 90 %. Needs Linux.
"""

from __future__ import annotations

import ast
import gc
import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import hypothesis  # noqa: F401 - imported before the processes of the mutants start, which then share it
import numba  # noqa: F401
import numpy as np  # noqa: F401
import pytest

from tests.bench.covered_lines import RECORDED, ROOT, blocks, copied, python_files, record

WANTED = 0.9
BATCH_SECONDS = 20.0
"""Time of the tests that run against a mutant in one process, without changes [s]."""
BATCH_TESTS = 400
MOST_BATCHES = 3
TIME_LIMIT = 60
"""A mutant whose tests take more CPU time hangs and counts as noticed [s]."""
WAITING_LIMIT = 240
"""A mutant whose tests wait longer counts as noticed, too [s]."""
MEMORY_LIMIT = 6 << 30
"""A mutant that needs more memory counts as noticed [bytes]."""

COMPARISONS: dict[type[ast.cmpop], str] = {
    ast.Lt: "<=",
    ast.LtE: "<",
    ast.Gt: ">=",
    ast.GtE: ">",
    ast.Eq: "!=",
    ast.NotEq: "==",
    ast.In: "not in",
    ast.NotIn: "in",
    ast.Is: "is not",
    ast.IsNot: "is",
}
OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "-",
    ast.Sub: "+",
    ast.Mult: "/",
    ast.Div: "*",
    ast.FloorDiv: "*",
    ast.Mod: "*",
    ast.Pow: "*",
    ast.BitOr: "&",
    ast.BitAnd: "|",
}


class Mutant(NamedTuple):
    """Change of one expression of a file."""

    file: str
    line: int
    start: int
    """Byte in the file."""
    end: int
    text: str


def mutants(file: str, source: bytes) -> Iterator[Mutant]:
    """Return all mutants of a file."""
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def text(node: ast.expr) -> str:
        return ast.unparse(node)

    def change(node: ast.expr, new: str) -> Mutant:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        start, end = starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset
        return Mutant(file, node.lineno, start, end, new)

    for node in code_nodes(ast.parse(source)):
        match node:
            case ast.Compare(left, [operator], [right]) if type(operator) in COMPARISONS:
                yield change(node, f"(({text(left)}) {COMPARISONS[type(operator)]} ({text(right)}))")
            case ast.BinOp(left, operator, right) if type(operator) in OPERATORS:
                yield change(node, f"(({text(left)}) {OPERATORS[type(operator)]} ({text(right)}))")
            case ast.BoolOp(operator, values):
                other = " or " if isinstance(operator, ast.And) else " and "
                yield change(node, f"({other.join(f'({text(value)})' for value in values)})")
            case ast.UnaryOp(ast.Not(), operand):
                yield change(node, f"bool({text(operand)})")
            case ast.Constant(bool() as value):
                yield change(node, str(not value))
            case ast.Constant(int() | float() as value):
                yield change(node, f"({value + 1!r})")
            case ast.Return(ast.expr() as value) if not isinstance(value, ast.Constant):
                yield change(value, "None")


def code_nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """Return the nodes of code, without annotations, decorators, f-strings and the strictness of `zip`."""
    for name, field in ast.iter_fields(tree):
        if name in ("annotation", "returns", "decorator_list"):
            continue
        for node in field if isinstance(field, list) else [field]:
            if not isinstance(node, ast.AST) or isinstance(node, (ast.JoinedStr, ast.pattern)):
                continue
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                continue
            if isinstance(node, ast.keyword) and node.arg == "strict":  # an assertion of `zip` that never fails
                continue
            if (
                isinstance(node, ast.UnaryOp)
                and isinstance(tree, ast.Call)
                and ast.unparse(tree.func).endswith(".reshape")
            ):
                continue  # each negative length means the same
            yield node
            yield from code_nodes(node)


def covering_tests() -> tuple[dict[str, list[str]], dict[str, float]]:
    """Return the tests that reach each block, by the place of its first line, and the CPU time of each test.

    Recorded tests that exist no longer are left out: pytest fails if it is asked for one.
    """
    places: dict[str, list[str]] = {}
    seconds: dict[str, float] = {}
    for line in RECORDED.read_text().splitlines():
        test, seconds[test], places[test] = json.loads(line)
    files = sorted({test.partition("::")[0] for test in places})
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:cacheprovider"]
    command += [file for file in files if (ROOT / file).exists()]
    listed = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    tests: dict[str, list[str]] = defaultdict(list)
    for test in places.keys() & set(listed.splitlines()):
        for place in places[test]:
            tests[place].append(test)
    return {place: sorted(found) for place, found in tests.items()}, seconds


def covered_mutants(tests: dict[str, list[str]], folders: tuple[str, ...]) -> list[tuple[Mutant, list[str]]]:
    """Return the mutants on covered lines of the folders, each with its tests."""
    found: list[tuple[Mutant, list[str]]] = []
    for file, source in python_files():
        if not file.startswith(folders):
            continue
        block_of = {
            line: f"{file}:{block.first}"
            for block in sorted(blocks(file, ast.parse(source)), key=lambda block: (block.first, -block.last))
            for line in range(block.first, block.last + 1)
        }
        for mutant in mutants(file, source):
            if place_tests := tests.get(block_of.get(mutant.line, "")):
                found.append((mutant, place_tests))
    return found


def batches(file: str, tests: list[str], seconds: dict[str, float]) -> list[list[str]]:
    """Return the tests to run for a change of a file, those that may notice it soonest first.

    First come those of its own test file, then cases with its name (such as those of a rule). Then comes one case of a
    test function of each test file, those of near folders first, then of a second function of each file, and so on;
    then second cases.
    """
    path = Path(file)
    folders = path.parent.parts[1:]

    cases: Counter[str] = Counter()
    functions: Counter[tuple[int, str]] = Counter()
    number: dict[str, tuple[int, int]] = {}
    for test in sorted(tests, key=seconds.__getitem__):
        function = test.partition("[")[0]
        turn = cases[function], test.partition("::")[0]
        number[test] = cases[function], functions[turn]
        cases[function] += 1
        functions[turn] += 1

    def distance(test: str) -> tuple[bool, bool, tuple[int, int], int, float]:
        place = Path(test.partition("::")[0])
        common = sum(a == b for a, b in zip(folders, place.parent.parts[1:], strict=False))
        is_own = place.name == f"test_{path.stem}.py"
        return not is_own, f"[{path.stem.replace('_', '-')}" not in test, number[test], -common, seconds[test]

    found: list[list[str]] = [[]]
    total = 0.0
    for test in sorted(tests, key=distance):
        total += seconds[test]
        if found[-1] and (total > BATCH_SECONDS or len(found[-1]) == BATCH_TESTS):
            found.append([])
            total = seconds[test]
        found[-1].append(test)
    return found[:MOST_BATCHES]


def first_failure(copy: Path, tests: list[str]) -> str | None:
    """Run tests in a copy of the checkout until one fails; return its name, or what else went wrong."""
    read, write = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(read)
        try:
            os._exit(_run(copy, tests, write))
        finally:
            os._exit(pytest.ExitCode.INTERNAL_ERROR)  # leave without the clean-up of the parent process
    os.close(write)
    end = time.monotonic() + WAITING_LIMIT
    while not (ended := os.waitpid(process, os.WNOHANG))[0] and time.monotonic() < end:
        time.sleep(0.05)
    with suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)  # processes that the tests left running, or all after the time limit
    if not ended[0]:
        ended = os.waitpid(process, 0)
    with os.fdopen(read) as pipe:
        name = pipe.readline().strip()
    status = os.waitstatus_to_exitcode(ended[1])
    if status == pytest.ExitCode.INTERNAL_ERROR:
        raise RuntimeError(f"pytest cannot run {tests}")
    return name or (f"exit status {status}" if status else None)


def _run(copy: Path, tests: list[str], report_to: int) -> int:
    """Run tests in the process of a mutant; return the exit status."""
    os.setsid()
    resource.setrlimit(resource.RLIMIT_CPU, (TIME_LIMIT, TIME_LIMIT))
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY_LIMIT, MEMORY_LIMIT))
    with Path(os.devnull).open("r+b") as nothing:
        for stream in (0, 1, 2):
            os.dup2(nothing.fileno(), stream)
    os.chdir(copy)
    os.environ.update({"PYTHONPATH": str(copy), "CI": "true"})
    sys.path[:] = [str(copy), *(path for path in sys.path if path and not Path(path).is_relative_to(ROOT / "tests"))]

    class FailureReport:
        def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
            if report.failed:
                os.write(report_to, f"{report.nodeid}\n".encode())

    ignored = "ignore::pytest.PytestAssertRewriteWarning"  # hypothesis is imported before pytest starts
    return int(pytest.main(["-x", "-q", "-W", ignored, "-p", "no:cacheprovider", *tests], plugins=[FailureReport()]))


def is_noticed_by(copy: Path, mutant: Mutant, chosen: list[list[str]], number: int) -> str | None:
    """Return the test that fails with the change, or None.

    Args:
        copy: the copy of the checkout.
        mutant: the change.
        chosen: see `batches`.
        number: differs between mutants; becomes the time of the file, so that Python compiles it again.
    """
    target = copy / mutant.file
    source, status = target.read_bytes(), target.stat()
    target.write_bytes(source[: mutant.start] + mutant.text.encode() + source[mutant.end :])
    os.utime(target, (number, number))
    try:
        return next(filter(None, (first_failure(copy, tests) for tests in chosen)), None)
    finally:
        target.write_bytes(source)
        os.utime(target, ns=(status.st_atime_ns, status.st_mtime_ns))


def try_mutants(count: int = 200, seed: int = 0, folders: tuple[str, ...] = ("urdfkit",)) -> int:
    """Try mutants; return the exit status."""
    tests, seconds = covering_tests()
    drawn = covered_mutants(tests, tuple(f"{folder.rstrip('/')}/" for folder in folders))
    print(f"{len(drawn)} mutants on covered lines; trying {count} of them, seed {seed}", flush=True)
    sample = [
        (mutant, batches(mutant.file, all_tests, seconds), len(all_tests))
        for mutant, all_tests in random.Random(seed).sample(drawn, count)
    ]
    del drawn, tests, seconds
    gc.collect()
    gc.freeze()  # the processes of the mutants leave what is there out of their garbage collections
    tried: Counter[str] = Counter()
    noticed: Counter[str] = Counter()
    failures: set[str] = set()
    with copied() as copy:
        for mutant, chosen, total in sample:
            package = mutant.file.split("/")[1]
            tried[package] += 1
            if failure := is_noticed_by(copy, mutant, chosen, tried.total()):
                noticed[package] += 1
                failures.add(failure)
            else:
                source = (ROOT / mutant.file).read_bytes()
                old, column = (
                    source[mutant.start : mutant.end].decode(),
                    mutant.start - source.rfind(b"\n", 0, mutant.start),
                )
                print(f"{mutant.file}:{mutant.line}:{column}: `{old}` -> `{mutant.text}`")
                print(f"  not noticed by {sum(map(len, chosen))} of {total} tests, {chosen[0][0]}", flush=True)
            if tried.total() % 20 == 0:
                print(f"{noticed.total()} of {tried.total()}", flush=True)
        print(f"without a change: {first_failure(copy, sorted(f for f in failures if '::' in f)) or 'all tests pass'}")
        print(f"noticed otherwise: {sorted(f for f in failures if '::' not in f)}")
    for package in sorted(tried):
        print(f"{package}: {noticed[package]} of {tried[package]}")
    print(f"{noticed.total()} of {count} noticed ({noticed.total() / count:.1%})")
    return noticed.total() < WANTED * count


if __name__ == "__main__":
    if sys.argv[1] == "record":
        sys.exit(record(sys.argv[2:]))
    sys.exit(try_mutants(*map(int, sys.argv[2:4]), tuple(sys.argv[4:]) or ("urdfkit",)))
