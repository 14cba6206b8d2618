import os
from pathlib import Path

import pytest

from urdfkit.view.file_watch import FileWatch


def save(path: Path, text: str) -> None:
    path.write_text(text)
    stamp = save.stamp = getattr(save, "stamp", 1_000_000_000) + 1  # file systems may round times
    os.utime(path, (stamp, stamp))


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    paths = [tmp_path / "a.xacro", tmp_path / "b.xacro"]
    for path in paths:
        save(path, "one")
    return paths


def test_a_save_is_noticed_once_and_only_when_it_has_settled(files: list[Path]) -> None:
    watch = FileWatch(files)
    assert not watch.changed()
    save(files[1], "two")
    assert not watch.changed()  # may still be being written
    assert watch.changed()
    assert not watch.changed()


def test_a_file_still_growing_is_waited_for(files: list[Path]) -> None:
    watch = FileWatch(files)
    for text in ("x", "xx", "xxx"):
        save(files[0], text)
        assert not watch.changed()
    assert watch.changed()


def test_saving_by_renaming_counts_once(files: list[Path], tmp_path: Path) -> None:
    watch = FileWatch(files)
    files[0].unlink()
    assert not any(watch.changed() for _ in range(3))
    save(tmp_path / "new", "two")
    (tmp_path / "new").rename(files[0])
    assert [watch.changed() for _ in range(3)] == [False, True, False]


def test_a_file_that_is_gone_is_missing_once_that_has_settled(files: list[Path], tmp_path: Path) -> None:
    watch = FileWatch(files)
    files[0].rename(tmp_path / "aside")
    assert not watch.changed()
    assert watch.missing == ()  # somebody may be saving by renaming
    assert not watch.changed()
    assert watch.missing == (files[0],)
    (tmp_path / "aside").rename(files[0])
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    assert watch.missing == ()


def test_a_file_that_never_existed_does_not_hide_a_save(files: list[Path], tmp_path: Path) -> None:
    absent = tmp_path / "included.xacro"
    watch = FileWatch([*files, absent])
    assert [watch.changed() for _ in range(3)] == [False, False, False]
    assert watch.missing == ()
    save(files[0], "two")
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    save(absent, "one")
    assert [watch.changed() for _ in range(3)] == [False, True, False]


def test_files_can_come_and_go(files: list[Path], tmp_path: Path) -> None:
    watch = FileWatch(files[:1])
    watch.follow(files)
    save(files[1], "two")
    watch.changed()
    assert watch.changed()


def test_a_save_during_reading_is_not_lost(files: list[Path]) -> None:
    watch = FileWatch(files)
    save(files[0], "two")
    watch.changed()
    assert watch.changed()
    save(files[0], "three")  # while the robot of "two" is being read
    watch.follow(files)
    watch.changed()
    assert watch.changed()


def test_an_optional_file_counts_as_changed_when_it_disappears_and_when_it_appears(
    files: list[Path], tmp_path: Path
) -> None:
    mesh = tmp_path / "arm.stl"
    save(mesh, "mesh")
    watch = FileWatch(files, [mesh])
    mesh.unlink()
    assert [watch.changed() for _ in range(3)] == [False, True, False]
    assert watch.missing == ()
    save(mesh, "mesh again")
    assert [watch.changed() for _ in range(3)] == [False, True, False]
