"""Controls of the page that have no effect are switched off visibly, and the browser's command line has no token."""

from __future__ import annotations

import argparse
import stat
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

pytest.importorskip("meshcat")

from tests.view.conftest import show
from urdfkit.cli import page_options
from urdfkit.description.urdf.robot import Box
from urdfkit.scene import Scene, Shape
from urdfkit.view.server.server import Server

POSE = {"x": 0.0, "y": 0.0, "yaw": 0.0}


class Served(Server):
    """The page of a simulation, whose status messages the test sends."""

    def status(self, driver: int | None = None) -> None:
        self.broadcast(
            "status", time=1.0, paused=False, real_time_factor=1.0, factor=1.0, dt=0.001, pose=POSE, speed=0.0,
            fixed=False, tip=None, robots={"toy": {**POSE, "speed": 0.0, "turn": 0.0}}, odometry={}, driver=driver,
            watchers=1,
        )  # fmt: skip


@pytest.fixture(params=[()])
def served(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Served]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    shape = Shape("base/visual/0", "base", "visual", Box((1, 1, 1)), np.eye(4))
    with Served("sim", port=0, watchers_may=request.param) as running:
        show(running, Scene(("base", "mast"), (shape,)))
        running.publish_latched("teleop", drives=True, moves={"w": [1, 0, 0, 0]}, factors={}, speed=0.5, turn=1.0)
        running.publish(0.0, np.tile([0, 0, 0, 0, 0, 0, 1.0], (2, 1)))
        running.status()
        yield running


def off(page) -> str:
    """Return the reason why the controls are switched off; empty if they are not."""
    line = page.locator("#driver-other")
    return line.inner_text() if page.evaluate("document.querySelector('.transport').inert") else ""


@pytest.mark.browser
def test_the_controls_are_switched_off_while_the_simulation_does_not_respond(served, visits, until) -> None:
    page = visits.open(served.url, ready=False)
    until(lambda: "does not respond" in off(page))
    assert page.evaluate("document.getElementById('pad').inert")

    def responds() -> bool:
        served.status()
        return not off(page)

    until(responds)
    served.stop()
    until(lambda: "No connection" in off(page))
    visits.problems.clear()  # the browser reports the closed connection


@pytest.mark.browser
@pytest.mark.parametrize(("served", "disabled"), [((), [True, True]), (("reset",), [True, False])], indirect=["served"])
def test_a_watcher_has_only_the_controls_that_it_may_use(served, visits, until, disabled) -> None:
    page = visits.open(served.url, ready=False)

    def state(driver: int | None) -> list[bool]:
        served.status(driver)
        return [page.locator(f"#{name}").is_disabled() for name in ("pause", "reset")]

    said = page.locator("#driver-other")
    until(lambda: state(999_999) == disabled and said.inner_text() == "Another page is driving.")
    until(lambda: state(None) == [False, False])


@pytest.mark.browser
def test_the_browser_opens_a_private_file_that_leads_to_the_page(served, visits, until, monkeypatch) -> None:
    opened = []
    monkeypatch.setattr(page_options, "_has_screen", lambda: True)
    monkeypatch.setattr(page_options.webbrowser, "open", opened.append)
    page_options.announce(argparse.Namespace(host="127.0.0.1", no_browser=False))(served)
    (address,) = until(lambda: opened)
    assert served.access.token not in address
    file = Path(unquote(urlsplit(address).path))
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    page = visits.open(address, ready=False)
    until(lambda: page.locator("#robot-name").count() and page.locator("#robot-name").inner_text() == "toy")
    assert urlsplit(page.url).query == ""


@pytest.mark.browser
def test_input_is_repeated_while_the_page_draws_slowly_but_not_when_it_hangs(served, visits, until) -> None:
    page = visits.open(served.url, ready=False)
    until(lambda: page.locator("#pad").is_visible())
    received = []
    update = served.drive_lock.update

    def receive(client, axes) -> bool:
        received.append(axes.axes[0])
        served.status()
        return update(client, axes)

    served.drive_lock.update = receive
    page.keyboard.down("w")
    until(lambda: received)
    frames = page.evaluate(
        """() => new Promise((done) => {
          let frames = 0;
          const slow = () => {
            const end = performance.now() + 300;
            while (performance.now() < end);
            frames += 1;
            if (frames < 5) requestAnimationFrame(slow);
            else done(frames);
          };
          requestAnimationFrame(slow);
        })"""
    )
    assert all(received)
    assert len(received) >= 3 * frames  # the page itself sends once in a frame

    def hangs(dialog) -> None:
        counts = []
        until(lambda: counts.append(len(received)) or (len(counts) > 30 and counts[-1] == counts[-30]))
        dialog.accept()

    page.on("dialog", hangs)
    page.evaluate("alert('the page hangs')")
    page.keyboard.up("w")
    until(lambda: received[-1] == 0.0)
