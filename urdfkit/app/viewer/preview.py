"""Preview of `urdfkit new` in the browser: the robot of the answers so far."""

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
"""Seconds to wait for the page before the first question."""
STAND_IN = "robot"
"""Name of the robot until the user has entered one."""
_ENDING = 5.0


class Preview:
    """A folder with the robot of the answers so far, and ``urdfkit view`` that shows it.

    Use it as a context manager; the folder is removed at its end.

    Args:
        template: a template with a robot (`Template.teleop`).

    Attributes:
        model: the file that the page shows.
        url: address of the page; empty until it is served.
    """

    def __init__(self, template: Template) -> None:
        self.template = template
        self._place = Path(tempfile.mkdtemp(prefix="urdfkit-preview-"))
        self.folder = self._place / "shown"
        self.folder.mkdir()
        self.url = ""
        self._view: subprocess.Popen[str] | None = None
        self.model = self.folder / "preview.urdf.xacro"
        self._ready = threading.Event()
        self._announced = False

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
        shutil.rmtree(self._place, ignore_errors=True)

    def follow(self, answers: Mapping[str, str]) -> None:
        """Show the robot of these answers and the defaults of the others; keep the last robot on a contradiction.

        Args:
            answers: answers by question.
        """
        try:
            self._write({"name": STAND_IN, **answers})
        except UrdfkitError:  # sizes that contradict each other
            return
        if self._view is None:
            self._start()
        self._announce()

    def _write(self, chosen: Mapping[str, str]) -> None:
        names = {question.name for question in self.template.questions}
        answers = self.template.answers({name: answer for name, answer in chosen.items() if name in names})
        answers |= computed(self.template.name, answers)
        # In a folder of its own, an interrupt while it is removed would leave it.
        with tempfile.TemporaryDirectory(dir=self._place) as place:
            targets = self.template.render({**answers, "year": "", "into": "."}, Path(place))
            # Files that include others are written last: the page reloads when they change.
            for target in sorted(targets, key=lambda path: (".urdf." in path.name, path)):
                _put(self.folder / target, Path(place, target).read_bytes())
        home = self.folder / fill(self.template.teleop, answers, where="teleop")
        robot = find_model([str(home)]).path.relative_to(self.folder).as_posix()
        # The file has the same name whatever the robot is called.
        _put(self.model, _WINDOW.format(name=answers["name"], robot=robot).encode())

    def _start(self) -> None:
        self._view = subprocess.Popen(
            [sys.executable, "-m", "urdfkit", "view", str(self.model), "--port", "0", "--quiet"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,  # Ctrl-C interrupts the questions only
        )
        threading.Thread(target=self._read, daemon=True, name="preview-address").start()
        self._ready.wait(PATIENCE)

    def _read(self) -> None:
        """Read the address of the page."""
        if self._view is not None and self._view.stdout is not None:
            self.url = self._view.stdout.readline().strip()
        self._ready.set()

    def _announce(self) -> None:
        """Print the address of the page once."""
        if self.url and not self._announced:
            self._announced = True
            print(f"preview: {self.url}", file=sys.stderr, flush=True)


_WINDOW = """<robot name="{name}" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="{robot}"/>
</robot>
"""


def _put(path: Path, content: bytes) -> None:
    """Write a file unless it has this content already."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(path, content)


def can_preview(template: Template) -> bool:
    """Return whether the template has a robot, the session is interactive, and the required modules are installed.

    Args:
        template: the template of the questions.
    """
    from importlib.util import find_spec

    if not template.teleop or not all(stream.isatty() for stream in (sys.stdin, sys.stdout, sys.stderr)):
        return False
    return all(find_spec(module) is not None for module in (*NEEDED, "pinocchio", "rosbags"))
