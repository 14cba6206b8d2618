"""Separate process that compiles a kernel into the cache."""

from __future__ import annotations

import atexit
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = "from urdfkit.sim.engine.kernel_cache import main; main({!r})"
"""Program of the process, with the name of a kernel."""


class CompilingProcess:
    """Process that compiles one of the kernels: ``robot``, ``world`` or ``rays``.

    It ends when its standard input is closed, so at the latest with this process.
    """

    def __init__(self, kernel: str) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 (closed by `close`)
        self._process = subprocess.Popen(
            [sys.executable, "-c", PROGRAM.format(kernel)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=self._errors,
            cwd=Path(__file__).parents[3],
            start_new_session=True,  # Ctrl-C ends it by its input
        )
        atexit.register(self.close)

    @property
    def ended(self) -> bool:
        """Whether the process has ended, with or without success."""
        return self._process.poll() is not None

    @property
    def fault(self) -> str | None:
        """The last line that it wrote to standard error, or its signal, if it has failed; else None."""
        code = self._process.poll()
        if not code:
            return None
        if code < 0:
            return f"its process was ended by {signal.Signals(-code).name}"
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").split("\n")
        return next((line.strip() for line in reversed(lines) if line.strip()), f"its process ended with code {code}")

    def wait(self) -> None:
        """Wait until it has ended."""
        self._process.wait()

    def close(self) -> None:
        """End the process."""
        atexit.unregister(self.close)
        if self._process.stdin is not None:
            self._process.stdin.close()
        self._process.kill()
        self._process.wait()
        self._errors.close()
