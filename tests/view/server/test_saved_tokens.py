import os
import stat
import time

import pytest

from urdfkit.view.server import saved_tokens
from urdfkit.view.server.saved_tokens import AGE, tokens_of
from urdfkit.view.server.server import Server


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path / "urdfkit"


def test_the_next_server_on_a_port_has_the_same_keys(folder) -> None:
    first = tokens_of(7007)
    assert tokens_of(7007) == first
    assert tokens_of(7008)["token"] != first["token"]
    assert stat.S_IMODE((folder / "page-7007.json").stat().st_mode) == 0o600
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700


def test_old_keys_are_not_used_again(folder) -> None:
    first = tokens_of(7007)
    old = time.time() - AGE - 10
    os.utime(folder / "page-7007.json", (old, old))
    assert tokens_of(7007)["token"] != first["token"]


@pytest.mark.parametrize("text", ["", "{}", "nonsense", '{"token":"short","session":"short"}', "[]", '{"token":1}'])
def test_a_broken_file_is_replaced(folder, text: str) -> None:
    tokens_of(7007)
    (folder / "page-7007.json").write_text(text)
    (folder / "page-7007.json").chmod(0o600)
    assert all(len(key) == 32 for key in tokens_of(7007).values())


def test_a_file_that_others_could_read_or_a_link_is_not_trusted(folder, tmp_path) -> None:
    first = tokens_of(7007)
    (folder / "page-7007.json").chmod(0o644)
    assert tokens_of(7007)["token"] != first["token"]
    bait = tmp_path / "bait"
    bait.write_text("{}")
    (folder / "page-7009.json").symlink_to(bait)
    assert tokens_of(7009) == {}  # a new key at every start, rather than one that somebody else planted
    assert bait.read_text() == "{}"


def test_without_a_folder_of_the_login_they_are_in_the_cache_which_is_made_private(tmp_path, monkeypatch) -> None:
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home" / "cache"))
    first = tokens_of(7007)
    folder = tmp_path / "home" / "cache" / "urdfkit"
    folder.chmod(0o755)
    assert tokens_of(7007) == first
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700


def test_where_nothing_can_be_kept_there_is_a_new_key_each_time(tmp_path, monkeypatch) -> None:
    (tmp_path / "urdfkit").write_text("in the way")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    assert tokens_of(7007) == {}


def test_a_page_finds_its_way_back_to_a_server_on_the_same_port(folder) -> None:
    first = Server("sim", port=0)
    port, token = first.port, first.access.token
    first.stop()
    again = Server("sim", port=port)
    third = None
    try:
        assert again.access.token != token  # any port: nothing was kept
        again.stop()
        third = Server("sim", port=port)
        assert (third.access.token, third.access.session) == (again.access.token, again.access.session)
    finally:
        again.stop()
        if third is not None:
            third.stop()


def test_windows_keeps_none(folder, monkeypatch) -> None:
    monkeypatch.setattr(saved_tokens.sys, "platform", "win32")
    assert tokens_of(7007) == {}
    assert not folder.exists()
