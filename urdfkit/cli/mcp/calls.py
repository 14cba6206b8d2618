"""Calls of commands in confined processes, with limits of time, memory and output."""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from urdfkit.errors import ResourceError, SimulationError, UsageError

MAX_OUTPUT = 1_000_000
"""Maximum number of characters in the output of one call."""

COMPILING = 600.0
"""Maximum wall time of compiling the kernels [s]."""

_VARIABLES = (
    "PATH HOME LANG LC_ALL PYTHONPATH VIRTUAL_ENV XDG_CACHE_HOME NUMBA_CACHE_DIR URDFKIT_CACHE_DIR SYSTEMROOT "
    "LOCALAPPDATA"
)
"""Environment variables of the processes; ``$(env …)`` in a description finds no others."""


class ToolCalls:
    """Runs commands of urdfkit for an assistant.

    Args:
        root: the only folder that the commands may read, besides urdfkit, Python and the caches.
        time_limit: maximum wall time of one call [s].
    """

    def __init__(self, root: Path, time_limit: float) -> None:
        self.root, self.time_limit = root, time_limit
        self._is_warm = False

    def path(self, text: str) -> str:
        """Return a path in the root, or the name of a bundled robot or world.

        Raises:
            UsageError: the path is an option, or leads out of the root.
        """
        if text.startswith("-") or "\0" in text or ":=" in text or not text:
            raise UsageError(f"`{text}` is not a path")
        path = self.root / text
        if re.fullmatch(r"[A-Za-z]\w*", text) and not path.exists():
            return text
        if not path.resolve().is_relative_to(self.root):
            raise UsageError(f"`{text}` is outside the folder {self.root}; the server reads no other folder")
        return str(path)

    def robot(self, text: str, arguments: dict[str, str] | None) -> list[str]:
        """Return the words for a robot and its xacro arguments.

        Raises:
            UsageError: see `path`, or the name of an argument is invalid.
        """
        words = [self.path(text)]
        for name, value in (arguments or {}).items():
            if not re.fullmatch(r"[A-Za-z_][\w-]*", name):
                raise UsageError(f"`{name}` is not the name of a xacro argument")
            words.append(f"{name}:={value}")
        return words

    def warm_up(self) -> None:
        """Compile the kernels of the simulator, once after an installation; not limited like the calls."""
        if not self._is_warm:
            self.run("sim", "warmup", seconds=max(self.time_limit, COMPILING))
            self._is_warm = True

    def run(self, *words: str, statuses: tuple[int, ...] = (0, 1), seconds: float | None = None) -> str:
        """Run one command and return its output.

        Args:
            words: the command line, without the program.
            statuses: the exit codes of success.
            seconds: limit of the wall time [s]; that of the server when None.

        Raises:
            ResourceError: the command failed, or its output is too long.
            SimulationError: the command took too long.
        """
        limit = seconds if seconds is not None else self.time_limit
        with tempfile.TemporaryDirectory(prefix="urdfkit-mcp-") as scratch:
            job = {"root": str(self.root), "scratch": scratch, "seconds": limit, "words": words}
            environment = {name: os.environ[name] for name in _VARIABLES.split() if name in os.environ}
            try:
                done = subprocess.run(
                    [sys.executable, "-m", "urdfkit.cli.mcp.confined_command"],
                    input=json.dumps(job),
                    capture_output=True,
                    cwd=self.root,
                    encoding="utf-8",
                    errors="replace",
                    env={**environment, "TMPDIR": scratch},
                    timeout=limit,
                    check=False,
                )
            except subprocess.TimeoutExpired:
                hint = "shorten the simulation, or start the server with a longer --time-limit"
                raise SimulationError(f"{words[0]} took longer than {limit:g} s; {hint}") from None
        if done.returncode not in statuses:
            lines = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
            raise ResourceError(lines[-1].removeprefix("urdfkit: ")[:2000])
        if len(done.stdout) > MAX_OUTPUT:
            raise ResourceError(f"the output has {len(done.stdout)} characters; the limit is {MAX_OUTPUT}")
        return done.stdout

    def value(self, *words: str) -> Any:
        """Run one command and return the JSON value that it prints; see `run`."""
        return json.loads(self.run(*words))
