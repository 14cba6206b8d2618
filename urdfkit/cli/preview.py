"""What `urdfkit new` shows in the browser while it asks: the robot as it would be, following each answer."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path

from urdfkit.atomic import write_bytes
from urdfkit.cli.page import NEEDED
from urdfkit.errors import UrdfkitError
from urdfkit.scaffold import Template, computed, fill

PATIENCE = 6.0
"""Seconds to wait for the page before the next question is asked without it."""
_ENDING = 5.0


class Preview:
    """A folder with the robot that the answers so far make, and ``urdfkit view`` looking at it.

    Use it as a context; nothing of it is left afterwards.

    Args:
        template: which has a robot to look at (`Template.teleop`).
    """

    def __init__(self, template: Template) -> None:
        self.template = template
        self.folder = Path(tempfile.mkdtemp(prefix="urdfkit-preview-"))
        self.url = ""
        self._view: subprocess.Popen[str] | None = None
        self._name: str | None = None
        self._ready = threading.Event()
        self._told = False

    def __enter__(self) -> Preview:
        return self

    def __exit__(self, *_: object) -> None:
        if self._view is not None:
            self._view.terminate()
            try:
                self._view.wait(_ENDING)
            except subprocess.TimeoutExpired:
                self._view.kill()
                self._view.wait()
            if self._view.stdout is not None:
                self._view.stdout.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def follow(self, found: Mapping[str, str]) -> None:
        """Show the robot of these answers, the others by default; where they make none, that of before stays.

        Args:
            found: answers by question; without a name nothing is shown yet.
        """
        if "name" not in found:
            return
        # Files keep their names while the page looks at them.
        self._name = self._name or found["name"]
        try:
            self._write({**found, "name": self._name})
        except UrdfkitError:  # sizes that do not go together, yet
            return
        if self._view is None:
            self._start()
        self._tell()

    def _write(self, found: Mapping[str, str]) -> None:
        known = {question.name for question in self.template.questions}
        answers = self.template.answers({name: answer for name, answer in found.items() if name in known})
        answers |= computed(self.template.name, answers)
        with tempfile.TemporaryDirectory() as place:
            targets = self.template.render({**answers, "year": "", "into": "."}, Path(place))
            # What includes others comes last: the page looks again when that changes.
            for target in sorted(targets, key=lambda path: (".urdf." in path.name, path)):
                content, old = Path(place, target).read_bytes(), self.folder / target
                if not old.exists() or old.read_bytes() != content:
                    old.parent.mkdir(parents=True, exist_ok=True)
                    write_bytes(old, content)

    def _start(self) -> None:
        model = self.folder / fill(self.template.teleop, {"name": self._name or ""}, where="teleop")
        self._view = subprocess.Popen(
            [sys.executable, "-m", "urdfkit", "view", str(model), "--port", "0", "--quiet"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,  # Ctrl-C is for the questions; the page ends with them
        )
        threading.Thread(target=self._read, daemon=True, name="preview-address").start()
        self._ready.wait(PATIENCE)

    def _read(self) -> None:
        """Wait for the address of the page."""
        if self._view is not None and self._view.stdout is not None:
            self.url = self._view.stdout.readline().strip()
        self._ready.set()

    def _tell(self) -> None:
        """Say once where the page is."""
        if self.url and not self._told:
            self._told = True
            print(f"preview: {self.url}", file=sys.stderr, flush=True)


def can_preview(template: Template) -> bool:
    """Return whether there is something to look at, somebody who looks, and what it takes.

    Args:
        template: which asks.
    """
    from importlib.util import find_spec

    if not template.teleop or not all(stream.isatty() for stream in (sys.stdin, sys.stdout, sys.stderr)):
        return False
    return all(find_spec(module) is not None for module in (*NEEDED, "pinocchio", "rosbags"))
