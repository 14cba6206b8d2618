"""What `urdfkit new` shows in the browser while it asks: the robot as it would be, following each answer."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path

from urdfkit.app.page import NEEDED
from urdfkit.atomic import write_bytes
from urdfkit.errors import UrdfkitError
from urdfkit.resources import find_model
from urdfkit.scaffold import Template, computed, fill

PATIENCE = 6.0
"""Seconds to wait for the page before the first question is asked without it."""
STAND_IN = "robot"
"""What the robot is called until it has a name."""
_ENDING = 5.0


class Preview:
    """A folder with the robot that the answers so far make, and ``urdfkit view`` looking at it.

    Use it as a context; nothing of it is left afterwards.

    Args:
        template: which has a robot to look at (`Template.teleop`).

    Attributes:
        model: the file that the page looks at.
        url: of the page; empty while there is none.
    """

    def __init__(self, template: Template) -> None:
        self.template = template
        self.folder = Path(tempfile.mkdtemp(prefix="urdfkit-preview-"))
        self.url = ""
        self._view: subprocess.Popen[str] | None = None
        self.model = self.folder / "preview.urdf.xacro"
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
            found: answers by question.
        """
        try:
            self._write({"name": STAND_IN, **found})
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
                _put(self.folder / target, Path(place, target).read_bytes())
        home = self.folder / fill(self.template.teleop, answers, where="teleop")
        robot = find_model([str(home)]).path.relative_to(self.folder).as_posix()
        # The page looks at one file, whatever the robot is called.
        _put(self.model, _WINDOW.format(name=answers["name"], robot=robot).encode())

    def _start(self) -> None:
        self._view = subprocess.Popen(
            [sys.executable, "-m", "urdfkit", "view", str(self.model), "--port", "0", "--quiet"],
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


_WINDOW = """<robot name="{name}" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="{robot}"/>
</robot>
"""


def _put(path: Path, content: bytes) -> None:
    """Write a file that is not that already."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(path, content)


def can_preview(template: Template) -> bool:
    """Return whether there is something to look at, somebody who looks, and what it takes.

    Args:
        template: which asks.
    """
    from importlib.util import find_spec

    if not template.teleop or not all(stream.isatty() for stream in (sys.stdin, sys.stdout, sys.stderr)):
        return False
    return all(find_spec(module) is not None for module in (*NEEDED, "pinocchio", "rosbags"))
