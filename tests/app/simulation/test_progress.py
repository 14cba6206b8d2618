import time

import pytest

pytest.importorskip("meshcat")

from urdfkit.app.simulation import progress as compiling
from urdfkit.app.simulation.progress import progress


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
