"""``urdfkit lint --watch``: lint, wait until a file changes, lint again."""

import os
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from urdfkit.lint.engine.run import Outcome

INTERVAL = 0.3
"""Seconds between two checks of the files."""

_SUFFIXES = (".urdf", ".xacro", ".gazebo", ".yaml", ".yml", ".xml", ".toml", ".stl", ".dae", ".obj")


def watch(lint: Callable[[], Outcome | None], paths: Iterable[Path]) -> None:
    """Lint whenever a file changes, until interrupted.

    Args:
        lint: lint and print; return the outcome, or None on failure.
        paths: files and folders named by the user; files created in the folders are watched too.
    """
    named = list(paths)
    files: set[Path] = set()
    while True:
        seen = _state(files, named)  # before the files are read: a file saved in the meantime is linted again
        if sys.stdout.isatty():
            print("\x1b[2J\x1b[3J\x1b[H", end="")
        before = time.time()
        outcome = lint()
        read = set(outcome.files.values()) if outcome is not None else set()
        print(f"[{time.strftime('%H:%M:%S')}] {time.time() - before:.2f} s; waiting for changes", file=sys.stderr)
        sys.stdout.flush()
        state = _state(read | files, named) | seen
        while _state(read | files, named) == state:
            time.sleep(INTERVAL)
        files = read


def _state(files: Iterable[Path], named: Iterable[Path]) -> dict[str, tuple[int, int]]:
    """Return size and modification time of every watched file."""
    every = {str(file) for file in files}
    for path in named:
        if path.is_dir():
            for folder, names, inside in os.walk(path):
                names[:] = [name for name in names if not name.startswith(".") and name not in ("build", "install")]
                every.update(os.path.join(folder, name) for name in inside if name.endswith(_SUFFIXES))  # noqa: PTH118
        else:
            every.add(str(path))
    found = {}
    for file in every:
        try:
            status = os.stat(file)  # noqa: PTH116 - thousands of these
        except OSError:
            continue
        found[file] = (status.st_size, status.st_mtime_ns)
    return found
