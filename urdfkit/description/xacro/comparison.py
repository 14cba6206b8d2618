"""Comparison with the xacro package: run it in a process of its own and find the first line that differs.

Packages are found by urdfkit in both, so that a difference is one of the language and ROS need not be installed.
"""

import json
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import MissingDependencyError, XacroError
from urdfkit.record import record

TIME_LIMIT = 60.0
"""Seconds for the xacro package."""
MAX_MEMORY = 4 * 2**30
"""Bytes of memory for the xacro package."""


@record
class LineDifference:
    """First difference of two texts.

    Attributes:
        line: number of the line, from 1.
        column: number of the first character that differs, from 1.
        first: the line of the first text; None after its end.
        second: the line of the second text; None after its end.
    """

    line: int
    column: int
    first: str | None
    second: str | None


def first_difference(first: str, second: str) -> LineDifference | None:
    """Return the first line in which two texts differ; None if they are equal."""
    if first == second:
        return None
    a, b = first.split("\n"), second.split("\n")
    line = _common(a, b)
    left, right = (lines[line] if line < len(lines) else None for lines in (a, b))
    return LineDifference(line + 1, _common(left or "", right or "") + 1, left, right)


def _common(first: Sequence[str], second: Sequence[str]) -> int:
    """Return how many items at the beginning of two sequences are equal."""
    pairs = enumerate(zip(first, second, strict=False))
    return next((index for index, (a, b) in pairs if a != b), min(len(first), len(second)))


def version() -> str:
    """Return the version of the xacro package.

    Raises:
        MissingDependencyError: it is not installed.
    """
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as installed

    try:
        return installed("xacro")
    except PackageNotFoundError:
        raise MissingDependencyError("the xacro package is not installed; run `pip install xacro`") from None


def text_of_xacro(
    path: str | Path, arguments: Mapping[str, str], packages: Packages, *, time_limit: float = TIME_LIMIT
) -> str:
    """Return the output of the xacro package for a file.

    Args:
        path: as the user named it; appears in the banner of the output.
        arguments: values of ``$(arg …)``.
        packages: resolves ``$(find …)``.
        time_limit: seconds after which the process is stopped.

    Raises:
        XacroError: the package reports an error, or exceeds the limits of time or memory.
    """
    near = None if packages.near is None else str(packages.near)
    request = json.dumps([str(path), dict(arguments), [str(folder) for folder in packages.search], near])
    script = f"import sys; sys.path[:] = {sys.path!r}; from {__name__} import _run; _run()"
    command = [sys.executable, "-X", "utf8", "-c", script]
    try:
        done = subprocess.run(command, input=request, capture_output=True, text=True, timeout=time_limit, check=False)
    except subprocess.TimeoutExpired:
        raise XacroError(f"no result within {time_limit:g} s") from None
    if done.returncode != 0:
        raise XacroError(done.stderr.strip().rpartition("\n")[2] or f"exit status {done.returncode}")
    text, error = json.loads(done.stdout)
    if error is not None:
        raise XacroError(error)
    return str(text)


def _run() -> None:
    """Read a request from standard input and write the text or the error to standard output."""
    path, arguments, search, near = json.load(sys.stdin)
    _limit_memory()
    packages = Packages(search, near)

    def find(name: str) -> str:
        return str(packages.find(name))

    import xacro
    from xacro import substitution_args

    substitution_args._eval_find = substitution_args._eval_dict["find"] = find
    answer: tuple[Any, Any]
    try:
        answer = str(xacro.process_file(path, mappings=arguments).toprettyxml(indent="  ")), None
    except Exception as error:
        innermost: Any = error  # an exception of xacro holds the exception that caused it
        while getattr(innermost, "exc", None) is not None:
            innermost = innermost.exc
        answer = None, f"{type(innermost).__name__}: {' '.join(str(error).split())}"
    json.dump(answer, sys.stdout)


def _limit_memory() -> None:
    try:
        import resource
    except ImportError:  # Windows
        return
    resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))
