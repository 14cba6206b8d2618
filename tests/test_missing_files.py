"""One wording for a path that does not exist, with a suggestion that can be entered."""

from pathlib import Path

import pytest

from urdfkit.missing_files import expanded_path, missing_path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "robots" / "arm").mkdir(parents=True)
    (tmp_path / "robots" / "arm" / "arm.urdf").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("written", "suggested"),
    [
        ("robots/arm/amr.urdf", "robots/arm/arm.urdf"),
        ("robotts/arm/arm.urdf", "robots/arm/arm.urdf"),  # the rest of the path exists
        ("robotts/leg/leg.urdf", "robots"),
        ("robots/../robots/am", "robots/../robots/arm"),
    ],
)
def test_the_suggestion_is_a_path_in_the_form_that_was_written(folder: Path, written: str, suggested: str) -> None:
    assert missing_path(written) == f"no such file: {written}; did you mean `{suggested}`?"
    absolute = f"no such folder: {folder}/{written}; did you mean `{folder}/{suggested}`?"
    assert missing_path(folder / written, "folder") == absolute


def test_no_path_is_suggested_without_a_similar_name(folder: Path) -> None:
    assert missing_path("leg.urdf") == "no such file: leg.urdf"


def test_a_home_folder_of_nobody_is_a_missing_path(folder: Path) -> None:
    assert missing_path("~nobody_of_this_name/arm.urdf") == "no such file: ~nobody_of_this_name/arm.urdf"
    assert expanded_path("~") == Path.home()
