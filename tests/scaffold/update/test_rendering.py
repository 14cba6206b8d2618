from pathlib import Path

import pytest

from urdfkit.errors import ResourceError
from urdfkit.scaffold import create, load_template


@pytest.fixture
def template(small_template):
    return load_template(small_template)


@pytest.fixture
def answers(template):
    return template.answers({"name": "box"}) | {"year": "2026", "into": "."}


@pytest.fixture
def place(tmp_path):
    folder = tmp_path / "place"
    folder.mkdir()
    return folder


def everything(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def test_writes_and_leaves_nothing_else(template, answers, place):
    assert create(template, answers, place) == [(place / "box/src/box.txt").resolve()]
    assert everything(place) == ["box", "box/src", "box/src/box.txt"]


def test_folders_are_made(template, answers, place):
    create(template, answers, place / "a/b")
    assert (place / "a/b/box/src/box.txt").is_file()


def test_the_checker_sees_the_whole_before_it_is_there(template, answers, place):
    seen = []

    def check(folder):
        seen.append((folder / "box/src/box.txt").read_text())
        assert not (place / "box").exists()
        return []

    create(template, answers, place, check=check)
    assert seen[0].startswith("box is")


def test_what_does_not_pass_is_not_written(template, answers, place):
    with pytest.raises(ResourceError, match=r"nothing was written .*: first \(and 1 more\)"):
        create(template, answers, place / "new", check=lambda folder: ["first", "second"])
    assert everything(place) == []


@pytest.mark.parametrize("kind", ["file", "folder", "dangling link"])
def test_nothing_is_overwritten(template, answers, place, kind):
    target = place / "box"
    if kind == "file":
        target.write_text("mine")
    elif kind == "folder":
        target.mkdir()
    else:
        target.symlink_to("nowhere")
    with pytest.raises(ResourceError, match="box already exists; nothing was overwritten"):
        create(template, answers, place)
    assert everything(place) == ["box"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError])
def test_an_interrupt_leaves_nothing(template, answers, place, error):
    def check(folder):
        raise error

    with pytest.raises(error):
        create(template, answers, place / "a/b", check=check)
    assert everything(place) == []


def test_a_full_disk_leaves_nothing(template, answers, place, monkeypatch):
    opened = Path.open

    def full(self, *args, **kwargs):
        if self.name == "box.txt":
            raise OSError(28, "No space left on device")
        return opened(self, *args, **kwargs)

    monkeypatch.setattr(Path, "open", full)
    with pytest.raises(ResourceError, match=r"cannot write .*box\.txt: No space left on device"):
        create(template, answers, place)
    assert everything(place) == []


def test_into_a_file(template, answers, place):
    (place / "file").write_text("")
    for folder in (place / "file", place / "file" / "below"):
        with pytest.raises(ResourceError, match=r"not a folder|Not a directory"):
            create(template, answers, folder)
    assert everything(place) == ["file"]


def test_into_a_folder_that_cannot_be_written(template, answers, place, monkeypatch):
    def refuse(*args, **kwargs):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.mkdtemp", refuse)
    with pytest.raises(ResourceError, match=r"cannot write into .*: Permission denied"):
        create(template, answers, place)


@pytest.mark.parametrize("name", ["hall.sdf", "hall.world"])
def test_the_name_of_a_world_is_no_folder(template, answers, place, name):
    with pytest.raises(ResourceError, match=r"has the name of a world file, but would be a folder; try "):
        create(template, answers, place / name)
    assert not (place / name).exists()
