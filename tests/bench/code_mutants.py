"""Random mutants of urdfkit's own code: do the tests that cover the changed line notice?

Record first which test covers which line (bench extra, once, about twice the time of the tests)::

    python -m coverage run --rcfile=tests/bench/coverage.ini -m pytest -m "not slow and not browser"

then run ``python tests/bench/code_mutants.py [COUNT] [SEED]``. It draws nodes of the syntax trees at random among the
covered lines outside the compiled kernels, changes one comparison, operator, constant, boolean or returned value in a
copy of the checkout, and runs the tests that cover the line there, the quickest module first. A mutant that no test
notices is printed with its place. Exits with status 1 below 90 in a hundred.
"""

from __future__ import annotations

import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import coverage

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "urdfkit"
WANTED = 0.9
MOST_TESTS = 40
"""Tests that are run against a mutant: those of the module that bears the name of the changed one come first."""
TIME_LIMIT = 300
"""A mutant whose tests take longer counts as noticed: it hangs [s]."""

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
KERNELS = {"compiled", "inlined", "njit", "entry"}
"""Decorators of compiled functions."""


class Mutant(NamedTuple):
    """Change of one expression of a file."""

    file: Path
    line: int
    start: int
    """Byte in the file."""
    end: int
    text: str


def mutants(file: Path) -> Iterator[Mutant]:
    """Return all mutants of a file."""
    source = file.read_bytes()
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def at(line: int, column: int) -> int:
        return starts[line - 1] + column

    def text(node: ast.expr) -> str:
        return ast.unparse(node)

    def change(node: ast.expr, new: str) -> Mutant:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        end = at(node.end_lineno, node.end_col_offset)
        return Mutant(file, node.lineno, at(node.lineno, node.col_offset), end, new)

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
    """Return the nodes of code that runs as Python: no annotations, defaults of kernels, docstrings or f-strings."""
    for name, field in ast.iter_fields(tree):
        if name in ("annotation", "returns", "decorator_list"):
            continue
        for node in field if isinstance(field, list) else [field]:
            if not isinstance(node, ast.AST) or isinstance(node, (ast.JoinedStr, ast.pattern)) or _is_kernel(node):
                continue
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                continue
            yield node
            yield from code_nodes(node)


def _is_kernel(node: ast.AST) -> bool:
    if not isinstance(node, ast.FunctionDef):
        return False
    words = {ast.unparse(decorator).partition("(")[0] for decorator in node.decorator_list}
    return not words.isdisjoint(KERNELS)


def function_lines(file: Path) -> set[int]:
    """Return the lines inside functions: what runs at import is covered by whatever test imports it first."""
    functions = [n for n in ast.walk(ast.parse(file.read_bytes())) if isinstance(n, (ast.FunctionDef, ast.Lambda))]
    return {
        line
        for n in functions
        for line in range(n.body[0].lineno if isinstance(n, ast.FunctionDef) else n.lineno, (n.end_lineno or 0) + 1)
    }


def covering(data: coverage.CoverageData, file: Path) -> dict[int, list[str]]:
    """Return the tests that cover each line of a file, those of its own test module first."""
    own = f"test_{file.stem}.py"
    return {
        line: sorted(
            {context for context in contexts if "::" in context}, key=lambda test: (f"/{own}::" not in f"/{test}", test)
        )
        for line, contexts in data.contexts_by_lineno(str(file)).items()
    }


def is_noticed(copy: Path, mutant: Mutant, tests: list[str]) -> bool:
    """Run tests in the copy of the checkout with the change; return whether one fails."""
    target = copy / mutant.file.relative_to(ROOT)
    source = target.read_bytes()
    target.write_bytes(source[: mutant.start] + mutant.text.encode() + source[mutant.end :])
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    environment = os.environ | {"PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1", "CI": "true"}
    try:
        done = subprocess.run(command, cwd=copy, env=environment, capture_output=True, timeout=TIME_LIMIT, check=False)
        return done.returncode != 0
    except subprocess.TimeoutExpired:
        return True
    finally:
        target.write_bytes(source)


def main(count: int = 200, seed: int = 0) -> int:
    """Try mutants; return the exit status."""
    data = coverage.CoverageData(str(ROOT / ".coverage"))
    data.read()
    drawn: list[tuple[Mutant, list[str]]] = []
    for file in sorted(PACKAGE.rglob("*.py")):
        tests, lines = covering(data, file), function_lines(file)
        drawn += [(m, tests[m.line]) for m in mutants(file) if m.line in lines and tests.get(m.line)]
    print(f"{len(drawn)} mutants on covered lines; trying {count} of them, seed {seed}")
    chosen = random.Random(seed).sample(drawn, count)
    noticed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "checkout"
        shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns(".venv", ".git", ".mypy_cache"))
        for number, (mutant, tests) in enumerate(chosen, 1):
            if is_noticed(copy, mutant, tests[:MOST_TESTS]):
                noticed += 1
                continue
            old = mutant.file.read_bytes()[mutant.start : mutant.end].decode()
            place = f"{mutant.file.relative_to(ROOT)}:{mutant.line}"
            print(f"{place}: `{old}` -> `{mutant.text}` not noticed by {len(tests)} tests, {tests[0]}", flush=True)
            if number % 20 == 0:
                print(f"{noticed} of {number}", file=sys.stderr)
    print(f"{noticed} of {count} noticed ({noticed / count:.1%})")
    return noticed < WANTED * count


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:3])))
