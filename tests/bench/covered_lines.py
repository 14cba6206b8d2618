"""Record which blocks of urdfkit's functions each test reaches; see `code_mutants`."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
RECORDED = ROOT / ".covered_lines"
SHARED = ROOT.parent / "shared"
"""Models of the tests, where they lie next to the checkout."""
KERNEL_LISTS = ("urdfkit/scene/rays/compilation.py", "urdfkit/sim/engine/kernel_cache.py")
"""Modules that list the modules and folders with compiled kernels."""
Function = ast.FunctionDef | ast.AsyncFunctionDef

MARKS = '''"""Marks of the blocks that the current test has reached."""

import atexit
import os

FOLDER = os.environ["COVERED_FOLDER"]
seen = bytearray(int(os.environ["COVERED_BLOCKS"]))
reached = os.open(os.path.join(FOLDER, "reached"), os.O_WRONLY | os.O_CREAT | os.O_APPEND)  # before any confinement


def write(test, seconds=None):
    """Append the blocks that were reached since the last call; without a time for a program that a test started."""
    import json  # here, because tests assert that a program does not load it

    found = [number for number, mark in enumerate(seen) if mark]
    for number in found:
        seen[number] = 0
    line = json.dumps([test, seconds, found]) + "\\n"
    os.write(reached, line.encode())


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


class Block(NamedTuple):
    """Statements of a function that run one after another."""

    file: str
    first: int
    last: int


def python_files() -> Iterator[tuple[str, bytes]]:
    """Return the modules of the package without compiled functions, with their sources."""
    left_out = tuple(compiled_modules())
    for path in sorted((ROOT / "urdfkit").rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if not name.startswith(left_out):
            yield name, path.read_bytes()


def compiled_modules() -> Iterator[str]:
    """Return the modules and folders whose change compiles kernels again, without suffix."""
    yield from ("urdfkit/compilation/", "urdfkit/kinematics/serial/kernel/")
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
    """Copy the checkout, with the compiled kernels; the shared models next to it stay where they are.

    Kernels that are not compiled yet are compiled first: in the copy, each test that needs them would compile them.
    """
    subprocess.run([sys.executable, "-m", "urdfkit", "sim", "warmup"], cwd=ROOT, check=True)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "checkout"
        left_out = shutil.ignore_patterns(".venv", ".git", ".*_cache", RECORDED.name, "node_modules")
        shutil.copytree(ROOT, copy, symlinks=True, ignore=left_out)
        if SHARED.is_dir():
            (Path(folder) / SHARED.name).symlink_to(SHARED)
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
        own = {"PYTHONPATH": str(copy), "COVERED_FOLDER": folder, "COVERED_BLOCKS": str(len(table))}
        command = [sys.executable, "-m", "pytest", "-p", "marks_plugin", "-p", "no:cacheprovider", "-q", *arguments]
        status = subprocess.run(command, cwd=copy, env=os.environ | own, check=False).returncode
        reached: dict[str, set[int]] = defaultdict(set)
        shared: dict[str, set[int]] = defaultdict(set)
        seconds: dict[str, float] = {}
        for line in (Path(folder) / "reached").read_text().splitlines():
            test, time_taken, found = json.loads(line)
            reached[test].update(found)
            if test in seconds:  # a program that outlived the test that started it: later tests of the file share it
                shared[test.partition("::")[0]].update(found)
            if time_taken is not None:
                seconds[test] = time_taken
        with RECORDED.open("a") as file:
            for test, time_taken in seconds.items():
                places = sorted(
                    f"{table[number].file}:{table[number].first}"
                    for number in reached[test] | shared[test.partition("::")[0]]
                )
                file.write(json.dumps([test, time_taken, places]) + "\n")
    return status
