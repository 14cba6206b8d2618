"""While one page drives, other pages may do what `watchers_may` permits; every page may stop the robots."""

from __future__ import annotations

import json

import pytest

from urdfkit.view.protocol.page_requests import Schema

CONNECTIONS = 300


@pytest.fixture(autouse=True)
def no_pings(monkeypatch) -> None:
    """Keep pages connected that read nothing and therefore answer no ping."""
    monkeypatch.setattr("urdfkit.view.server.http_handlers.PING", 0)


@pytest.fixture
def driven(page, server, until):
    """The number of a page that drives."""
    page.send(json.dumps({"type": "axes", "axes": [1, 0, 0, 0], "speed": 1, "turn": 1}))
    return until(lambda: server.drive_lock.holder)


def pressed(server, *actions: str, client: int) -> tuple[str, ...]:
    """Return the buttons that reach the simulation."""
    for action in actions:
        server._receive_control(client, action)
    return server.inbox.take().actions


def test_only_the_driver_pauses_and_resets(driven, server) -> None:
    every = ("pause", "play", "reset", "stop")
    assert pressed(server, *every, client=driven + 1) == ("stop",)
    assert pressed(server, *every, client=driven) == every
    server.drive_lock.release()
    assert pressed(server, *every, client=driven + 1) == every


def test_the_refused_page_gets_the_reason(driven, client, server, text) -> None:
    other = client.socket()
    other.send('{"type":"control","action":"reset"}')
    assert text(other, "notice")["text"] == "reset rejected: another page is driving; wait until it stops"
    assert server.inbox.take().actions == ()


@pytest.mark.parametrize(
    ("permitted", "actions", "refused"),
    [
        ("pause", ("pause", "play"), ["spawn"]),
        ("reset", ("reset",), ["step", "spawn"]),
        ("change", (), ["step"]),
    ],
)
def test_watchers_may_do_what_is_permitted(driven, server, permitted, actions, refused, monkeypatch) -> None:
    server.watchers_may = frozenset((permitted,))
    server.requests.update({name: Schema({}) for name in ("step", "spawn")})
    assert pressed(server, "pause", "play", "reset", client=driven + 1) == actions
    answers = []
    monkeypatch.setattr(server, "answer", lambda request, error=None, **_: answers.append(request.name))
    for name in ("step", "spawn"):
        server.receive(driven + 1, None, json.dumps({"type": "request", "number": 1, "name": name, "values": {}}))
    assert answers == refused


@pytest.mark.slow
def test_three_hundred_pages_watch_and_one_drives(scene, client, server, until) -> None:
    client.log_in()
    pages = [client.socket() for _ in range(CONNECTIONS)]
    until(lambda: server.hub.watchers == CONNECTIONS)
    for number in range(60):
        server.broadcast("status", time=number)
    pages[0].send(json.dumps({"type": "axes", "axes": [1, 0, 0, 0], "speed": 1, "turn": 1}))
    first = until(lambda: server.drive_lock.holder)
    pages[1].send(json.dumps({"type": "axes", "axes": [-1, 0, 0, 0], "speed": 1, "turn": 1}))
    pages[1].send('{"type":"joints","positions":{"lift":0.25}}')
    pages[1].send('{"type":"control","action":"stop"}')  # every page may stop the robot
    inputs = until(lambda: (taken := server.inbox.take()).actions and taken)
    assert inputs.joints == {}
    pages[0].send('{"type":"joints","positions":{"lift":0.5}}')
    assert until(lambda: server.inbox.take().joints) == {"lift": 0.5}
    assert server.drive_lock.holder == first
    assert server.drive_lock.axes.axes[0] == 1
    for page in (pages[0], pages[-1]):
        until(lambda page=page: isinstance(frame := page.recv(), str) and json.loads(frame).get("time") == 59)
    for page in pages:
        page.shutdown()
    until(lambda: server.hub.watchers == 0)
    assert server.drive_lock.holder is None
