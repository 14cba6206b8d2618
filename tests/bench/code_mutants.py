"""Random mutants of urdfkit's own code: do the tests that cover the changed line notice them?

First record which test covers which lines. The recording runs the tests once, in a copy of the checkout whose functions
mark the blocks that they reach; programs that a test starts count too. Further calls add tests or replace them::

    python tests/bench/code_mutants.py record -m "not slow and not browser and not catkin and not colcon"
    python tests/bench/code_mutants.py record tests/lint/test_catalogue.py

Then try mutants::

    python tests/bench/code_mutants.py try [COUNT] [SEED]

It draws expressions at random on the covered lines, changes one comparison, operator, constant, boolean or returned
value in another copy, and runs the tests that cover the line there, those of the module's own test file first. Modules
with compiled kernels are left out: a change would compile them again. Only tests that pass without a change are used,
and the tests that noticed a mutant run once more without one at the end. Prints each mutant that no test notices, and
the share noticed by package. Exits with status 1 below 90 %. Needs Linux.
"""

from __future__ import annotations

import ast
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

import hypothesis  # noqa: F401 - imported before the processes of the mutants start, which then share it
import numba  # noqa: F401
import numpy as np  # noqa: F401
import pytest

ROOT = Path(__file__).parents[2]
RECORDED = ROOT / ".covered_lines"
WANTED = 0.9
KERNEL_LISTS = ("urdfkit/scene/rays/compilation.py", "urdfkit/sim/engine/kernel_cache.py")
"""Modules that list the modules and folders with compiled kernels."""
MOST_SECONDS = 20.0
"""Time of the tests that run against a mutant, without changes: the tests of the module's own file come first [s]."""
MOST_TESTS = 120
TIME_LIMIT = 300
"""A mutant whose tests take more CPU time, or twice as long, hangs and counts as noticed [s]."""
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
Function = ast.FunctionDef | ast.AsyncFunctionDef

MARKS = '''"""Marks of the blocks that the current test has reached."""

import atexit
import json
import os

FOLDER = os.environ["COVERED_FOLDER"]
with open(os.path.join(FOLDER, "blocks.json")) as file:
    seen = bytearray(len(json.load(file)))


def write(test, seconds=None):
    """Append the blocks that were reached since the last call; without a time for a program that a test started."""
    found = [number for number, mark in enumerate(seen) if mark]
    for number in found:
        seen[number] = 0
    line = json.dumps([test, seconds, found]) + "\\n"
    file = os.open(os.path.join(FOLDER, "reached"), os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.write(file, line.encode())
    os.close(file)


if "COVERED_PROCESS" not in os.environ:
    os.environ["COVERED_PROCESS"] = str(os.getpid())
elif "PYTEST_CURRENT_TEST" in os.environ:
    atexit.register(write, os.environ["PYTEST_CURRENT_TEST"].rpartition(" (")[0])
'''
PLUGIN = '''"""A pytest plugin that writes the blocks that each test that passes has reached."""

import os
import time

import marks
import pytest

failed = set()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item):
    marks.seen[:] = bytes(len(marks.seen))
    start = sum(os.times()[:4])
    result = yield
    if item.nodeid not in failed:
        marks.write(item.nodeid, sum(os.times()[:4]) - start)
    return result


def pytest_runtest_logreport(report):
    if not report.passed:
        failed.add(report.nodeid)
'''


class Mutant(NamedTuple):
    """Change of one expression of a file."""

    file: str
    line: int
    start: int
    """Byte in the file."""
    end: int
    text: str


class Block(NamedTuple):
    """Statements of a function that run one after another."""

    file: str
    first: int
    last: int


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
                yield change(node, f"({text(left)} {COMPARISONS[type(operator)]} {text(right)})")
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
            yield node
            yield from code_nodes(node)


def python_files() -> Iterator[tuple[str, bytes]]:
    """Return the modules of the package without compiled functions, with their sources."""
    left_out = tuple(compiled_modules())
    for path in sorted((ROOT / "urdfkit").rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if not name.startswith(left_out):
            yield name, path.read_bytes()


def compiled_modules() -> Iterator[str]:
    """Return the modules and folders whose change compiles kernels again, without suffix."""
    yield "urdfkit/compilation/"
    for file in KERNEL_LISTS:
        for node in ast.parse((ROOT / file).read_bytes()).body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) in ("KERNEL_MODULES", "WORLD_FOLDERS"):
                yield from (f"{file.rpartition('/')[0]}/{name}" for name in ast.literal_eval(node.value))


def blocks(file: str, tree: ast.Module, *, mark: int | None = None) -> Iterator[Block]:
    """Return the blocks of the functions of a file, outer ones first.

    Args:
        mark: number of the first block; each block then begins with a statement that marks its number.
    """
    number = mark or 0
    waiting: list[ast.AST] = [node for node in ast.walk(tree) if isinstance(node, Function)]
    done: set[int] = set()
    while waiting:
        node = waiting.pop(0)
        if id(node) in done:
            continue
        done.add(id(node))
        for field in ("body", "orelse", "finalbody", "handlers", "cases"):
            children = getattr(node, field, [])
            if field in ("handlers", "cases") or isinstance(node, ast.ClassDef):
                waiting += children
                continue
            marked: list[ast.stmt] = []
            begins = True
            for index, child in enumerate(children):
                is_docstring = isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant)
                if begins and not is_docstring:
                    last = next((c for c in children[index:] if _may_leave(c)), children[-1])
                    yield Block(file, child.lineno, last.end_lineno)
                    marked += ast.parse(f"_seen_[{number}] = 1").body
                    number, begins = number + 1, False
                marked.append(child)
                if _may_leave(child):
                    waiting.append(child)
                    begins = True
            if mark is not None and children:
                setattr(node, field, marked)


def _may_leave(statement: ast.stmt) -> bool:
    """Return whether a statement contains others, which may return, break or continue."""
    return hasattr(statement, "body") or hasattr(statement, "cases")


@contextmanager
def copied() -> Iterator[Path]:
    """Copy the checkout, with the compiled kernels."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "checkout"
        left_out = shutil.ignore_patterns(".venv", ".git", ".*_cache", RECORDED.name, "node_modules")
        shutil.copytree(ROOT, copy, symlinks=True, ignore=left_out)
        yield copy


def record(arguments: list[str]) -> int:
    """Run tests and keep the blocks that they reach; return the exit status of pytest."""
    with copied() as copy, tempfile.TemporaryDirectory() as folder:
        table: list[Block] = []
        for file, source in python_files():
            tree = ast.parse(source)
            table += blocks(file, tree, mark=len(table))
            first = next(
                (i for i, node in enumerate(tree.body) if not isinstance(node, (ast.Expr, ast.ImportFrom))), None
            )
            if first is not None:
                tree.body.insert(first, ast.parse("from marks import seen as _seen_").body[0])
            (copy / file).write_text(ast.unparse(ast.fix_missing_locations(tree)))
        (copy / "marks.py").write_text(MARKS)
        (copy / "marks_plugin.py").write_text(PLUGIN)
        (Path(folder) / "blocks.json").write_text(json.dumps(table))
        environment = os.environ | {"PYTHONPATH": str(copy), "COVERED_FOLDER": folder}
        command = [sys.executable, "-m", "pytest", "-p", "marks_plugin", "-p", "no:cacheprovider", "-q", *arguments]
        status = subprocess.run(command, cwd=copy, env=environment, check=False).returncode
        reached: dict[str, set[int]] = defaultdict(set)
        seconds: dict[str, float] = {}
        for line in (Path(folder) / "reached").read_text().splitlines():
            test, time_taken, found = json.loads(line)
            reached[test].update(found)
            if time_taken is not None:
                seconds[test] = time_taken
        with RECORDED.open("a") as file:
            for test, time_taken in seconds.items():
                places = sorted(f"{table[number].file}:{table[number].first}" for number in reached[test])
                file.write(json.dumps([test, time_taken, places]) + "\n")
    return status


def covering_tests() -> tuple[dict[str, list[str]], dict[str, float]]:
    """Return the tests that reach each block, by the place of its first line, and the CPU time of each test."""
    places: dict[str, list[str]] = {}
    seconds: dict[str, float] = {}
    for line in RECORDED.read_text().splitlines():
        test, seconds[test], places[test] = json.loads(line)
    tests: dict[str, list[str]] = defaultdict(list)
    for test, reached in places.items():
        for place in reached:
            tests[place].append(test)
    return tests, seconds


def covered_mutants(tests: dict[str, list[str]]) -> list[tuple[Mutant, list[str]]]:
    """Return the mutants on covered lines, each with its tests."""
    found: list[tuple[Mutant, list[str]]] = []
    for file, source in python_files():
        block_of = {
            line: f"{file}:{block.first}"
            for block in sorted(blocks(file, ast.parse(source)), key=lambda block: (block.first, -block.last))
            for line in range(block.first, block.last + 1)
        }
        for mutant in mutants(file, source):
            if place_tests := tests.get(block_of.get(mutant.line, "")):
                found.append((mutant, place_tests))
    return found


def chosen_tests(file: str, tests: list[str], seconds: dict[str, float]) -> list[str]:
    """Return the tests to run for a change of a file, at most `MOST_SECONDS`.

    First come those of its own test file, then cases with its name (such as those of a rule), then those of near
    folders.
    """
    path = Path(file)
    folders = path.parent.parts[1:]

    def distance(test: str) -> tuple[bool, bool, int, float]:
        place = Path(test.partition("::")[0])
        common = sum(a == b for a, b in zip(folders, place.parent.parts[1:], strict=False))
        is_own = place.name == f"test_{path.stem}.py"
        return not is_own, f"[{path.stem.replace('_', '-')}" not in test, -common, seconds[test]

    chosen: list[str] = []
    total = 0.0
    for test in sorted(tests, key=distance)[:MOST_TESTS]:
        total += seconds[test]
        if chosen and total > MOST_SECONDS:
            break
        chosen.append(test)
    return chosen


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
    end = time.monotonic() + 2 * TIME_LIMIT
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


def is_noticed_by(copy: Path, mutant: Mutant, tests: list[str], number: int) -> str | None:
    """Return the test that fails with the change, or None.

    Args:
        number: differs between mutants; becomes the time of the file, so that Python compiles it again.
    """
    target = copy / mutant.file
    source, status = target.read_bytes(), target.stat()
    target.write_bytes(source[: mutant.start] + mutant.text.encode() + source[mutant.end :])
    os.utime(target, (number, number))
    try:
        return first_failure(copy, tests)
    finally:
        target.write_bytes(source)
        os.utime(target, ns=(status.st_atime_ns, status.st_mtime_ns))


def try_mutants(count: int = 200, seed: int = 0) -> int:
    """Try mutants; return the exit status."""
    tests, seconds = covering_tests()
    drawn = covered_mutants(tests)
    print(f"{len(drawn)} mutants on covered lines; trying {count} of them, seed {seed}", flush=True)
    tried: Counter[str] = Counter()
    noticed: Counter[str] = Counter()
    failures: set[str] = set()
    with copied() as copy:
        for mutant, all_tests in random.Random(seed).sample(drawn, count):
            package = mutant.file.split("/")[1]
            tried[package] += 1
            chosen = chosen_tests(mutant.file, all_tests, seconds)
            if failure := is_noticed_by(copy, mutant, chosen, tried.total()):
                noticed[package] += 1
                failures.add(failure)
            else:
                old = (ROOT / mutant.file).read_bytes()[mutant.start : mutant.end].decode()
                print(f"{mutant.file}:{mutant.line}: `{old}` -> `{mutant.text}`")
                print(f"  not noticed by {len(chosen)} of {len(all_tests)} tests, {chosen[0]}", flush=True)
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
    sys.exit(try_mutants(*map(int, sys.argv[2:4])))
