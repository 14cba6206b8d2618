"""Ten thousand frames of nonsense and half-sense: refused, logged in bounds, and the server goes on serving."""

from __future__ import annotations

import json
import logging
import random

import pytest
import websocket

from urdfkit.view.protocol.page_requests import Schema, number, text, tree

FRAMES = 10_000
KINDS = ("joints", "axes", "control", "ack", "seen", "subscribe", "request", "hello", "", "__proto__", None, 7)
KEYS = (
    "positions", "axes", "speed", "turn", "robot", "action", "sequence", "key", "keys", "number", "name", "values",
)  # fmt: skip


def value(chance: random.Random, depth: int = 2) -> object:
    """Return anything JSON can say, and some that it should not."""
    simple = (
        None, True, False, 0, -1, 1.5, 2**31, 2**64, 1e308, float("nan"), float("inf"), "", "lift", "x" * 300, "\x00",
        "é", "move", "play", "sensor:/scan",
    )  # fmt: skip
    kind = chance.randrange(6 if depth else 4)
    if kind == 4:
        return [value(chance, depth - 1) for _ in range(chance.randrange(70 if chance.random() < 0.02 else 6))]
    if kind == 5:
        return {str(chance.choice(KEYS)): value(chance, depth - 1) for _ in range(chance.randrange(5))}
    return chance.choice(simple)


def frame(chance: random.Random) -> str | bytes:
    style = chance.randrange(10)
    if style == 0:
        return bytes(chance.randrange(256) for _ in range(chance.randrange(60)))
    if style == 1:
        return "".join(chr(chance.choice((0, 9, 34, 92, 123, 125, 8364, 65, 48))) for _ in range(chance.randrange(80)))
    whole = json.dumps({"type": chance.choice(KINDS), **{chance.choice(KEYS): value(chance) for _ in range(4)}})
    if style == 2:
        return whole[: chance.randrange(len(whole))]
    return whole


@pytest.mark.slow
def test_ten_thousand_random_frames_leave_it_serving(client, server, until, caplog) -> None:
    server.requests.update({"move": Schema({"x": number()}, {"name": text(), "free": tree})})
    chance = random.Random(20)
    client.log_in()
    page, watching, lines = client.socket(), client.socket(), 1
    with caplog.at_level(logging.WARNING, "urdfkit.view"):
        for k in range(FRAMES):
            content = frame(chance)
            try:
                if isinstance(content, bytes):
                    page.send_binary(content)
                else:
                    page.send(content.encode("utf-8", "surrogatepass").decode("utf-8", "replace"))
            except (websocket.WebSocketException, OSError):
                page, lines = client.socket(), lines + 1
            if k % 500 == 0:
                server.inbox.take()
    watching.send('{"type":"joints","positions":{"lift":0.25}}')
    until(lambda: server.inbox.take().joints.get("lift") == 0.25)
    assert client.get("/").status == 200
    assert server.drive_lock.holder is None or server.drive_lock.axes is not None
    assert len(server.hub.subscribed_keys) <= 2 * 64
    assert 0 < caplog.text.count("dropped") <= 10 * lines  # said, but not ten thousand times
    assert "Traceback" not in caplog.text


def test_a_page_that_wants_everything_gets_so_much_and_no_more(page, server, text, until) -> None:
    page.send(json.dumps({"type": "subscribe", "keys": [f"k{k}" for k in range(65)]}))
    page.send(json.dumps({"type": "subscribe", "keys": ["k" * 201]}))
    page.send(json.dumps({"type": "subscribe", "keys": [f"k{k}" for k in range(64)]}))
    until(lambda: len(server.hub.subscribed_keys) == 64)
    for k in range(1000):
        server.send_chunk("k1", "samples", curve="k1", t=[k], values=[0])
    server.broadcast("status", end=True)
    seen = []
    while True:
        message = page.recv()
        if isinstance(message, str) and (found := json.loads(message))["type"] == "samples":
            seen.append(found["t"][0])
        if seen and seen[-1] == 999:
            break
    assert seen == sorted(seen)
