"""Check that the Debian packages that the tests use are installed: ``python3 tests/system_packages.py``.

Prints one line that names each missing package, what it provides and the tests that use it, and exits with status 1;
exits with status 0 if nothing is missing. The list is `system_packages.txt`. Needs only Python's standard library.
"""

from __future__ import annotations

import ctypes
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

TESTS = Path(__file__).parent
TABLE = TESTS / "system_packages.txt"
SETUP = "setup"  # the group of what `make test` itself needs
INSTALL = "apt-get install --no-install-recommends"


class Package(NamedTuple):
    """Row of the table: a Debian package, the groups of tests that need it, and what they use of it."""

    name: str
    groups: frozenset[str]
    kind: str
    provided: str

    @property
    def is_missing(self) -> bool:
        return not _is_installed(self.kind, self.provided)


def read_table(text: str) -> tuple[Package, ...]:
    """Return the packages that the text of a table lists."""
    rows = [line.split() for line in text.splitlines() if line and not line.startswith("#")]
    return tuple(Package(name, frozenset(groups.split(",")), *use.split(":", 1)) for name, groups, use in rows)


def _is_command(name: str) -> bool:
    return shutil.which(name) is not None


def _is_file(pattern: str) -> bool:
    return any(Path("/").glob(pattern.lstrip("/")))


def _is_python_module(name: str) -> bool:
    return _succeeds("/usr/bin/python3", "-c", f"import {name}")


def _is_cmake_package(name: str) -> bool:
    folders = (f"share/{name}/cmake", f"lib/cmake/{name}", f"lib/*/cmake/{name}")
    return any(_is_file(f"/usr/{folder}/{name}Config.cmake") for folder in folders)


def _is_pkg_config_module(name: str) -> bool:
    return _succeeds("pkg-config", "--exists", name)


def _is_library(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True


def _succeeds(*command: str) -> bool:
    try:
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


KINDS: dict[str, tuple[str, Callable[[str], bool]]] = {
    "command": ("command", _is_command),
    "file": ("file", _is_file),
    "python": ("Python module", _is_python_module),
    "cmake": ("CMake package", _is_cmake_package),
    "pkg-config": ("pkg-config module", _is_pkg_config_module),
    "library": ("shared library", _is_library),
}
"""Kind of what a package provides: its name in messages, and the function that looks for it."""


@cache
def _is_installed(kind: str, provided: str) -> bool:
    return KINDS[kind][1](provided)


PACKAGES = read_table(TABLE.read_text(encoding="utf-8"))
GROUPS = tuple(sorted({group for package in PACKAGES for group in package.groups} - {SETUP}))


def missing(groups: Iterable[str]) -> list[Package]:
    """Return the packages of these groups that are not installed, in the order of the table."""
    wanted = frozenset(groups)
    return [package for package in PACKAGES if package.groups & wanted and package.is_missing]


def message(packages: Iterable[Package], *, with_users: bool = False) -> str:
    """Return the line that reports missing packages and the command that installs them.

    Args:
        packages: the missing packages.
        with_users: whether to name the test files that use each package.
    """
    listed = list(packages)
    parts = []
    for groups, of_groups in groupby(listed, key=lambda package: package.groups):
        part = ", ".join(f"{package.name} ({KINDS[package.kind][0]} {package.provided})" for package in of_groups)
        parts.append(f"{part}, used by {', '.join(used_by(groups))}" if with_users else part)
    return f"missing system packages: {'; '.join(parts)}; install: {INSTALL} {' '.join(p.name for p in listed)}"


def used_by(groups: Iterable[str]) -> list[str]:
    """Return the test files that have a marker of one of these groups."""
    marker = re.compile(rf"^(?:\s*@|pytestmark = )pytest\.mark\.(?:{'|'.join(groups)})\b", re.MULTILINE)
    files = [path for path in sorted(TESTS.rglob("test_*.py")) if marker.search(path.read_text(encoding="utf-8"))]
    named = [path.relative_to(TESTS.parent).as_posix() for path in files]
    return ["make test", *named] if SETUP in groups else named


def main() -> int:
    found = missing([SETUP, *GROUPS])
    if found:
        print(message(found, with_users=True))
        return 1
    print(f"all {len(PACKAGES)} system packages that the tests use are installed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
