"""The notes of running simulations: who finds which, and whose are not trusted."""

import os
import stat
import subprocess
import sys

import pytest

from urdfkit.errors import ResourceError, UsageError
from urdfkit.view.server import running_simulations
from urdfkit.view.server.running_simulations import Running, all_running, find, registered

URL = "http://127.0.0.1:7007/?token=" + "k" * 32


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path / "urdfkit"


def test_a_simulation_is_found_while_it_runs_and_not_after(folder) -> None:
    with registered(7007, URL, "simpleton"):
        assert all_running() == [Running(URL, "simpleton", os.getpid())]
        assert stat.S_IMODE((folder / "running-7007.json").stat().st_mode) == 0o600
        assert find() == URL
    assert list(folder.iterdir()) == []
    with pytest.raises(ResourceError, match="no simulation is running; start one with `urdfkit sim teleop ROBOT`"):
        find()


def test_of_several_one_has_to_be_named(folder) -> None:
    other = URL.replace("7007", "7008")
    with registered(7007, URL, "simpleton"), registered(7008, other, "mybot"):
        with pytest.raises(
            ResourceError, match=r"http://127.0.0.1:7007 \(simpleton\), http://127.0.0.1:7008 \(mybot\)"
        ):
            find()
        assert find("localhost:7008") == find("http://127.0.0.1:7008") == find(other) == other
        with pytest.raises(UsageError, match=r"include the token in the address; did you mean `http://127.0.0.1:7008`"):
            find("http://127.0.0.1:7080")


@pytest.mark.parametrize("url", ["nonsense", "http://", "ftp://127.0.0.1:7007/?token=x", "127.0.0.1:port"])
def test_what_is_no_address_is_refused(folder, url: str) -> None:
    with pytest.raises(UsageError, match="http://HOST:PORT/"):
        find(url)


def test_an_address_with_its_key_needs_no_note(folder) -> None:
    assert find("http://lab.local:7007/?token=x") == "http://lab.local:7007/?token=x"


def test_a_process_that_is_gone_runs_no_simulation(folder, monkeypatch) -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as gone:
        gone.wait()
    with monkeypatch.context() as patch:
        patch.setattr(running_simulations.os, "getpid", lambda: gone.pid)
        running_simulations._write(7007, Running(URL, "simpleton", gone.pid))
    assert all_running() == []
    with registered(7009, URL.replace("7007", "7009"), "mybot"):
        assert [path.name for path in folder.iterdir()] == ["running-7009.json"]


@pytest.mark.parametrize("text", ["", "[]", "nonsense", '{"url": "x"}', '{"url":"x","robot":"y","process":"z"}'])
def test_a_broken_note_is_no_simulation(folder, text: str) -> None:
    with registered(7007, URL, "simpleton"):
        (folder / "running-7007.json").write_text(text)
        assert all_running() == []


def test_a_note_that_others_could_have_written_is_not_trusted(folder, tmp_path) -> None:
    with registered(7007, URL, "simpleton"):
        (folder / "running-7007.json").chmod(0o666)
        assert all_running() == []
    (tmp_path / "bait").write_text('{"url": "http://127.0.0.1:1/?token=x", "robot": "x", "process": 1}')
    (tmp_path / "bait").chmod(0o600)
    (folder / "running-1.json").symlink_to(tmp_path / "bait")
    assert all_running() == []


def test_where_no_note_can_be_kept_the_simulation_runs_all_the_same(tmp_path, monkeypatch) -> None:
    (tmp_path / "urdfkit").write_text("in the way")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with registered(7007, URL, "simpleton"):
        assert all_running() == []
