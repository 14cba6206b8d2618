"""What an editor gets wrong is answered, in words; standard error stays free of tracebacks; nothing hangs."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.lsp.conftest import connected

TEXT = '<robot name="r">\n<link name="a"/>\n<link name="b"/>\n</robot>\n'
JOINT = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>'


@pytest.fixture
def client(tmp_path):
    (tmp_path / "r.urdf").write_text(TEXT)
    with connected(tmp_path) as one:
        yield one


@pytest.mark.slow
def test_what_is_refused_leaves_nothing_on_standard_error(client):
    client.open("r.urdf")
    at = client.at("r.urdf", TEXT, 'link name="|a')
    with pytest.raises(AssertionError, match="link `b` already exists"):
        client.ask("textDocument/rename", {**at, "newName": "b"})
    for line, column in ((-1, 0), (0, -5), (2**40, 0)):
        place = {**at, "position": {"line": line, "character": column}}
        with pytest.raises(AssertionError, match=r"should be in range \[0:2147483647\], but was"):
            client.ask("textDocument/hover", place)
    assert client.ask("textDocument/hover", at) is not None
    assert client.close() == ""


@pytest.mark.slow
def test_a_change_that_makes_no_sense_is_one_line(client):
    client.open("r.urdf")
    change = {"range": {"start": {"line": -1, "character": 0}, "end": {"line": 0, "character": 0}}, "text": "x"}
    document = {"uri": client.uri("r.urdf"), "version": 2}
    client.tell("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
    assert client.ask("textDocument/hover", client.at("r.urdf", TEXT, 'link name="|a')) is not None
    reported = client.close().splitlines()
    assert len(reported) == 1
    assert "Position.line should be in range" in reported[0]


@pytest.mark.slow
def test_an_element_typed_key_by_key_is_answered_at_every_key(client):
    before, after = TEXT.split("</robot>")
    client.open("r.urdf")
    place = {"line": 3}
    for count in range(1, len(JOINT) + 1):
        client.change("r.urdf", f"{before}{JOINT[:count]}\n</robot>{after}")
        at = {"textDocument": {"uri": client.uri("r.urdf")}, "position": {**place, "character": count}}
        for name in ("completion", "hover", "definition", "prepareRename"):
            client.ask(f"textDocument/{name}", at)
    # The parents' names are offered where one is typed.
    typed = JOINT.index('link="a"') + len('link="')
    client.change("r.urdf", f"{before}{JOINT[:typed]}\n</robot>{after}")
    at = {"textDocument": {"uri": client.uri("r.urdf")}, "position": {**place, "character": typed}}
    assert {"a", "b"} <= {item["label"] for item in client.ask("textDocument/completion", at)}
    assert client.close() == ""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no FIFOs here")
def test_what_is_no_regular_file_is_not_waited_for(client):
    os.mkfifo(client.folder / "pipe.urdf")
    uris = [(client.folder / "pipe.urdf").as_uri(), *(Path(f).as_uri() for f in ("/proc/self/mem", "/dev/zero", "/"))]
    for uri in uris:
        at = {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 0}}
        assert client.ask("textDocument/hover", at) is None
        document = {"uri": uri, "languageId": "xml", "version": 1, "text": TEXT}
        client.tell("textDocument/didOpen", {"textDocument": document})
        client.ask("textDocument/hover", at)
        client.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
        client.tell("textDocument/didClose", {"textDocument": {"uri": uri}})
        assert client.ask("textDocument/hover", at) is None
    assert client.close() == ""
