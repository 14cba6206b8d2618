import time
from typing import ClassVar

import pytest

pytest.importorskip("meshcat")

from urdfkit.app.simulation import progress as compiling
from urdfkit.app.simulation.progress import RAYS, Compilation, progress
from urdfkit.sim.engine import compiling_process


class Page:
    def __init__(self) -> None:
        self.reported: list[str | None] = []

    def publish_latched(self, type: str, **values: str | None) -> None:
        assert type == "progress"
        self.reported.append(values["label"])


def test_what_is_quick_is_not_mentioned(capfd) -> None:
    page = Page()
    with progress(page, "drawing …"):
        pass
    assert (page.reported, capfd.readouterr().err) == ([], "")


def test_long_operations_are_reported_on_the_page_and_in_the_terminal_until_they_end(capfd, monkeypatch, until) -> None:
    monkeypatch.setattr(compiling, "PATIENCE", 0.01)
    page = Page()
    with progress(page, "drawing …"):
        until(lambda: page.reported)
    assert page.reported == ["drawing …", None]
    assert capfd.readouterr().err == "drawing …\n"
    time.sleep(0.05)
    assert page.reported == ["drawing …", None]


def test_an_error_ends_it_too(monkeypatch, until) -> None:
    monkeypatch.setattr(compiling, "PATIENCE", 0.01)
    page = Page()

    def break_down() -> None:
        with progress(page, "loading …"):
            until(lambda: page.reported)
            raise ValueError("broken")

    with pytest.raises(ValueError, match="broken"):
        break_down()
    assert page.reported == ["loading …", None]


class Compiling:
    """A process that compiles, of which the test decides when and how it ends."""

    started: ClassVar[list[str]] = []

    def __init__(self, kernel: str) -> None:
        self.ended, self.fault = False, None
        Compiling.started.append(kernel)
        Compiling.last = self


def test_rays_are_compiled_after_the_physics_and_a_failure_is_one_line(capfd, monkeypatch, until) -> None:
    pytest.importorskip("numba")
    monkeypatch.setattr("urdfkit.scene.rays.warmup", lambda: None)
    monkeypatch.setattr(compiling_process, "CompilingProcess", Compiling)
    page = Page()
    page.broadcast = lambda _, **values: page.reported.append(values["text"])
    compilation = Compilation(page, "ray")
    compilation._report("physics")
    assert not compilation.rays_are_compiled()
    assert Compiling.started == []
    compilation._report(None)
    assert not compilation.rays_are_compiled()
    assert Compiling.started == ["rays"]
    assert page.reported == ["physics", None, RAYS]
    Compiling.last.ended, Compiling.last.fault = True, "OSError: no space left"
    until(compilation.rays_are_compiled)
    failure = "the ray kernels cannot be compiled in another process: OSError: no space left"
    assert page.reported[3:] == [failure, None]
    assert capfd.readouterr().err.splitlines() == ["physics", RAYS, failure]
