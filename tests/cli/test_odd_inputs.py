"""Names and contents of files that are no robots: one line with the reason, without control characters."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description.xml.source import Source
from urdfkit.errors import UrdfkitError

ROBOT = '<?xml version="1.0"?>\n<robot name="r"><link name="a"/></robot>\n'
COMMANDS = ["lint", "tf", "info", "expand"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("", "the name of the robot is empty; pass a file, a package folder or a robot name"),
        ("https://e.org/r.urdf", "https://e.org/r.urdf is a URI, not a path; download it, and name the file"),
        ("package://a/r.urdf", "package://a/r.urdf is a URI, not a path; name the file by its path"),
        ("lost.urdf", "lost.urdf is a symbolic link to gone.urdf, which does not exist or leads back to the link"),
        ("loop.urdf", "loop.urdf is a symbolic link to loop.urdf, which does not exist or leads back to the link"),
        ("none\x1b[31m\n.urdf", r"no such file or folder: none\x1b[31m\n.urdf"),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="symbolic links need a privilege on Windows")
def test_names_that_are_no_files(command, name, message, folder, capsys) -> None:
    (folder / "lost.urdf").symlink_to("gone.urdf")
    (folder / "loop.urdf").symlink_to("loop.urdf")
    assert main([command, name]) == 2
    assert capsys.readouterr().err == f"urdfkit: {message}\n"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names")
def test_control_characters_of_names_are_escaped(folder, capsys) -> None:
    name = "a\n\x1b[31m\u202e.urdf"
    (folder / name).write_text(ROBOT.replace("<link", "<lnk"))
    assert main(["tf", name]) == 2
    err = capsys.readouterr().err
    assert err.startswith(r"urdfkit: a\n\x1b[31m\u202e.urdf:2:1: ")
    assert err.count("\n") == 1
    assert err[:-1].isprintable()


def test_control_characters_of_links_are_escaped(folder, capsys) -> None:
    (folder / "r.urdf").write_text(ROBOT.replace("</robot>", '<link name="b&#10;urdfkit: no error"/></robot>'))
    assert main(["tf", "r.urdf"]) == 0
    assert r"`b\nurdfkit: no error`" in (err := capsys.readouterr().err)
    assert err.count("\n") == 1


def test_an_error_is_one_line() -> None:
    assert str(UrdfkitError("no link `a\nb\x9b`")) == r"no link `a\nb\x9b`"


@pytest.mark.parametrize("codec", ["utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-le", "utf-32-be"])
def test_wide_encodings_are_named(codec, folder, capsys) -> None:
    (folder / "r.urdf").write_bytes(ROBOT.encode(codec))
    assert main(["lint", "--no-cache", "r.urdf"]) == 1
    assert f"r.urdf:1:1: E001 the file is in {codec[:6].upper()}: urdfdom rejects the file\n" in capsys.readouterr().out
    assert Source.read(folder / "r.urdf").text == ROBOT


def test_a_pointer_of_git_lfs_is_named(folder, capsys) -> None:
    (folder / "r.urdf").write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
    assert main(["tf", "r.urdf"]) == 2
    assert "r.urdf:1:1: this is a Git LFS pointer, not the file itself: run `git lfs pull`" in capsys.readouterr().err


def test_a_name_with_a_dash_follows_two_dashes(folder, capsys) -> None:
    (folder / "-q.urdf").write_text(ROBOT)
    for words in (["lint", "--no-cache", "--", "-q.urdf"], ["tf", "--", "-q.urdf"]):
        assert main(words) == 0
    assert "frames in `a`" in capsys.readouterr().out


def test_files_around_a_fragment_are_read_in_part(folder, monkeypatch) -> None:
    from urdfkit.lint.project import description_files, entry_files

    read = []
    decode = Source.decode
    monkeypatch.setattr(Source, "decode", lambda file, content: read.append(len(content)) or decode(file, content))
    monkeypatch.setattr(description_files, "_MAX_BYTES", 300)
    (folder / "large.urdf").write_text(ROBOT + " " * 10_000)
    (folder / "m.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m" params=""/></robot>'
    )
    assert [entry.path for entry in entry_files.find_entries(["m.xacro"])] == [Path("m.xacro")]
    assert max(read) == 300
    assert Path("large.urdf").stat().st_size > 10_000


@pytest.mark.parametrize("words", ["tf", "tf a unknown", "tf a LONG", "info", "lint", "inertia"])
def test_names_as_long_as_a_file_are_shortened(words: str, folder: Path, capsys) -> None:
    name = "x" * 90_000
    joint = f'<joint name="j" type="fixed"><parent link="{name}"/><child link="a"/></joint>'
    (folder / "r.urdf").write_text(f'<robot name="r"><link name="{name}"/><link name="a"/>{joint}</robot>')
    command, *more = words.replace("LONG", name).split()
    main([command, "r.urdf", *more])
    out, err = capsys.readouterr()
    assert 0 < len(out) + len(err) < 10_000
