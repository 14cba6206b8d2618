"""Handles of `urdfkit.view` and `urdfkit.teleop`: served in the background, closed without leftovers."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
import urllib.request
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from urllib.error import HTTPError, URLError
from urllib.parse import urlsplit

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

import urdfkit
from urdfkit.app.page_handle import PageHandle
from urdfkit.errors import SimulationError
from urdfkit.view.server.running_simulations import all_running
from urdfkit.view.server.server import Server

ARM = """<robot name="arm">
  <link name="base"/><link name="hand"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="hand"/></joint>
</robot>
"""


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the notes of running simulations out of the user's folder."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))


@pytest.fixture(autouse=True)
def no_thread_is_left() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    assert set(threading.enumerate()) <= before


def status(url: str) -> int:
    try:
        with urllib.request.urlopen(url) as answer:
            return int(answer.status)
    except HTTPError as error:
        return error.code


def frame_of(handle: PageHandle) -> str:
    return handle._repr_html_().split('src="')[1].split('"')[0]


@pytest.mark.slow
def test_view_serves_until_closed(tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text(ARM)
    page = urdfkit.view(urdfkit.load(tmp_path / "arm.urdf"))
    assert page.url in repr(page)
    assert not page.closed
    assert status(page.url) == 403  # the redirect lost the cookie, as urllib keeps none
    assert status(frame_of(page)) == 200
    page.close()
    page.close()
    assert page.closed
    assert repr(page) == "<PageHandle closed>"
    assert "closed" in page._repr_html_()
    with pytest.raises(URLError):
        status(page.url)


def test_the_page_outlives_the_handle(tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text(ARM)
    page = urdfkit.view(tmp_path / "arm.urdf")
    frame, close = frame_of(page), page.close
    del page
    gc.collect()
    assert status(frame) == 200
    close()


def test_a_frame_needs_the_token_and_may_be_embedded() -> None:
    with Server("view", port=0) as server:
        parts = urlsplit(server.url)
        frame = f"http://{parts.netloc}/frame"
        assert status(frame) == 403
        assert status(f"{frame}?token=wrong") == 403
        assert status(f"{frame}?{parts.query}&{parts.query}") == 403
        assert status(f"http://{parts.netloc}/geometry/{'0' * 64}") == 403
        assert status(f"http://{parts.netloc}/geometry/{'0' * 64}?{parts.query}") == 404
        with urllib.request.urlopen(f"{frame}?{parts.query}") as answer:
            assert "frame-ancestors *" in answer.headers["Content-Security-Policy"]
            assert answer.headers["X-Frame-Options"] is None
        with urllib.request.urlopen(f"http://{parts.netloc}/app/app.js") as answer:
            assert answer.headers["X-Frame-Options"] == "DENY"


@pytest.mark.slow
def test_errors_reach_the_caller_and_leave_no_server(tmp_path: Path) -> None:
    with pytest.raises(urdfkit.UrdfkitError, match="did you mean `simpleton`"):
        urdfkit.view("simpelton")
    with pytest.raises(urdfkit.UrdfkitError, match="did you mean `house`"):
        urdfkit.teleop("simpleton", world="hause")
    (tmp_path / "arm.urdf").write_text(ARM)
    with pytest.raises(urdfkit.UrdfkitError, match="no link of the robot has a mass, but joints move `hand`"):
        urdfkit.teleop(tmp_path / "arm.urdf", strict=True)


def test_an_error_of_the_loop_is_raised_by_wait() -> None:
    def fail(stop: threading.Event) -> None:
        raise SimulationError("the simulation diverged")

    server = Server("sim", port=0)
    server.start()
    with ExitStack() as stack:
        stack.callback(server.stop)
        handle = PageHandle(server, fail, stack.pop_all())
    with pytest.raises(urdfkit.UrdfkitError, match="the simulation diverged"):
        handle.wait()
    assert handle.closed


@pytest.mark.slow
def test_teleop_simulates_in_the_background(until) -> None:
    pytest.importorskip("numba")
    with urdfkit.teleop("simpleton", world="house") as page:
        until(lambda: page.simulator.t > 0.05)
        assert [running.robot for running in all_running()] == ["simpleton"]
        assert page.simulator.world.name == "house"
    assert all_running() == []
    stopped = page.simulator.t
    page.simulator.step()  # no other thread steps it now
    assert page.simulator.t == pytest.approx(stopped + page.simulator.dt)


@pytest.mark.slow
def test_a_script_that_does_not_close_its_page_ends(tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text(ARM)
    code = "import urdfkit; page = urdfkit.view('arm.urdf'); print(page.url)"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("http://127.0.0.1:")
