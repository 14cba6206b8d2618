import json
import random

import pytest

from urdfkit.view.protocol.page_requests import (
    Request,
    Schema,
    check,
    choice,
    flag,
    listing,
    number,
    numbers,
    record,
    text,
    tree,
    whole,
)
from urdfkit.view.protocol.websocket_messages import ProtocolError, RawRequest

TABLE = {
    "move": Schema({"name": text(5), "pose": numbers(3, 7)}, {"fast": flag}),
    "count": Schema({"steps": whole(1, 10)}, changes=False),
    "weigh": Schema({"mass": number(0.001, 1e6, unit="kg")}),
    "all": Schema(
        optional={
            "kind": choice("a", "b"),
            "rows": listing(record(x=number(0, 1)), 0, 2),
            "free": tree,
        }
    ),
}


def checked(order: str, /, **values) -> dict:
    return check(TABLE, 3, RawRequest(7, order, values)).values


def test_an_order_comes_through_as_it_is_meant() -> None:
    found = check(TABLE, 3, RawRequest(7, "move", {"name": "box", "pose": [1, 2.5, 0]}))
    assert found == Request(3, 7, "move", {"name": "box", "pose": [1.0, 2.5, 0.0]})
    assert checked("move", name="box", pose=[0] * 7, fast=True)["fast"] is True
    assert checked("all", kind="b", rows=[{"x": 1}], free={"a": [None, {"b": "c"}]})["rows"] == [{"x": 1.0}]


@pytest.mark.parametrize(
    ("name", "values", "why"),
    [
        ("mvoe", {}, "unknown request `mvoe`; did you mean `move`?"),
        ("move", {"name": "box"}, "move: the pose is missing"),
        ("move", {"name": "box", "pose": [1, 2, 3], "psoe": 1}, "has no value `psoe`; did you mean `pose`?"),
        ("move", {"name": "box", "pose": [1, 2]}, "pose: 2 numbers instead of a list of 3 to 7 numbers"),
        ("move", {"name": "box", "pose": [1, 2, float("nan")]}, "pose: “nan” is not a number, such as 0.5"),
        ("move", {"name": "box", "pose": [1, 2, True]}, "“True” is not a number"),
        ("move", {"name": "box", "pose": [1, 2, 1e7]}, "pose: 1e+07 is too large; the maximum is 1e+06"),
        ("move", {"name": "boxes!", "pose": [1, 2, 3]}, "at most 5 characters"),
        ("move", {"name": "a\x00", "pose": [1, 2, 3]}, "name: “a\\x00” is not a string"),
        ("move", {"name": 3, "pose": [1, 2, 3]}, "name: “3” is not a string"),
        ("move", {"name": "box", "pose": [1, 2, 3], "fast": 1}, "fast: “1” is neither true nor false"),
        ("count", {"steps": 11}, "steps: 11 is too large; the maximum is 10"),
        ("count", {"steps": 2.0}, "steps: “2.0” is not an integer, such as 1"),
        ("weigh", {"mass": -3}, "mass: -3 kg is too small; the minimum is 0.001 kg"),
        ("weigh", {"mass": "1,5"}, "mass: “1,5” is not a number, such as 0.5 kg"),
        ("all", {"kind": "bb"}, "kind: “bb” is not one of a, b; did you mean `b`?"),
        ("all", {"kind": ["a"]}, "not one of a, b"),
        ("all", {"rows": [{"x": 0, "y": 0}]}, "not an object with x"),
        ("all", {"rows": [{}] * 3}, "3 entries instead of a list of 0 to 2 entries"),
        ("all", {"free": [float("inf")]}, "not finite"),
    ],
    ids=str,
)
def test_nonsense_is_refused_with_its_place(name: str, values: dict, why: str) -> None:
    with pytest.raises(ProtocolError) as caught:
        checked(name, **values)
    assert why in str(caught.value)
    assert "\n" not in str(caught.value)


def test_nesting_ends() -> None:
    value: object = 0
    for _ in range(40):
        value = [value]
    with pytest.raises(ProtocolError, match="nested deeper"):
        checked("all", free=value)


def test_random_values_never_do_anything_but_pass_or_be_refused() -> None:
    chance = random.Random(3)

    def anything(depth: int = 3):
        kind = chance.randrange(8 if depth else 6)
        if kind == 6:
            return [anything(depth - 1) for _ in range(chance.randrange(9))]
        if kind == 7:
            return {chance.choice(["x", "y", "name", ""]): anything(depth - 1) for _ in range(chance.randrange(4))}
        return (None, True, chance.randrange(-5, 2**40), chance.uniform(-1e9, 1e9), "x" * chance.randrange(9), -0.0)[
            kind
        ]

    passed = 0
    for _ in range(5000):
        name = chance.choice([*TABLE, "nothing"])
        known = [*TABLE[name].values, *TABLE[name].optional] if name in TABLE else ["a"]
        values = {key: anything() for key in chance.sample(known, chance.randrange(len(known) + 1))}
        try:
            checked(name, **values)
            passed += 1
        except ProtocolError:
            pass
    assert passed > 50


# Over the line


@pytest.fixture
def doing(server):
    server.requests.update(TABLE)
    return server


def do(page, number: int, order: str, /, **values) -> None:
    page.send(json.dumps({"type": "request", "number": number, "name": order, "values": values}))


def test_an_order_is_done_and_answered_to_who_ordered_it(client, page, doing, text, until) -> None:
    other = client.socket()
    do(page, 9, "count", steps=3)
    (order,) = until(lambda: doing.inbox.take().requests)
    assert (order.name, order.values) == ("count", {"steps": 3})
    doing.answer(order, found=[1, 2])
    doing.broadcast("status", end=True)
    assert text(page, "answer") == {
        "type": "answer", "number": 9, "name": "count", "error": None, "values": {"found": [1, 2]},
    }  # fmt: skip
    while (frame := other.recv()) and not (isinstance(frame, str) and "end" in frame):
        assert "answer" not in str(frame)


def test_nonsense_is_answered_and_logged(page, doing, text, caplog) -> None:
    do(page, 1, "count", steps="many")
    assert text(page, "answer")["error"] == "steps: “many” is not an integer, such as 1"
    do(page, 2, "format_disk")
    assert "unknown request `format_disk`" in text(page, "answer")["error"]
    assert "dropped a message" in caplog.text


def test_while_somebody_drives_nobody_else_changes_anything(client, page, doing, text, until) -> None:
    other = client.socket()
    page.send('{"type":"axes","axes":[1,0,0,0],"speed":0.5,"turn":1}')
    until(lambda: doing.drive_lock.axes)
    do(other, 1, "move", name="box", pose=[0, 0, 0])
    assert "another page is driving" in text(other, "answer")["error"]
    do(other, 2, "count", steps=1)  # looking is allowed
    until(lambda: doing.inbox.take().requests)
    page.send('{"type":"axes","axes":[0,0,0,0],"speed":0.5,"turn":1}')
    until(lambda: doing.drive_lock.holder is None)
    do(other, 3, "move", name="box", pose=[0, 0, 0])
    until(lambda: doing.inbox.take().requests)


def test_too_many_orders_are_refused_not_piled_up(page, doing, text) -> None:
    from urdfkit.view.server.request_inbox import MAX_REQUESTS

    for k in range(MAX_REQUESTS + 5):
        do(page, k, "count", steps=1)
    assert "too many requests are waiting" in text(page, "answer")["error"]
    assert len(doing.inbox.take().requests) == MAX_REQUESTS


def test_a_file_is_handed_to_who_ordered_it(client, page, doing, until) -> None:
    do(page, 4, "count", steps=1)
    (order,) = until(lambda: doing.inbox.take().requests)
    doing.send_file(order, "wörld.sdf", b"<sdf/>")
    while not (isinstance(frame := page.recv(), bytes) and frame[0] == 3):
        pass
    length = int.from_bytes(frame[2:4], "little")
    assert frame[16 : 16 + length].decode() == "wörld.sdf"
    assert frame[16 + length :] == b"<sdf/>"


def test_what_a_page_wants_it_gets_and_nothing_else(client, page, doing, text, until) -> None:
    other = client.socket()
    page.send('{"type":"subscribe","keys":["sensor:/scan","topics"]}')
    until(lambda: doing.hub.subscribed_keys == {"sensor:/scan", "topics"})
    assert doing.hub.accepts("sensor:/scan")
    for k in range(20):
        doing.sense("sensor:/scan", 0, float(k), 0, b"x" * 12)
        doing.send_to_subscribers("topics", "topics", rows=[k])
        doing.send_to_subscribers("secret", "secret")
    doing.broadcast("status", end=True)
    kinds = []
    while (frame := page.recv()) and "end" not in str(frame):
        kinds.append(frame[0] if isinstance(frame, bytes) else json.loads(frame)["type"])
    assert "topics" in kinds
    assert "secret" not in kinds
    while (frame := other.recv()) and "end" not in str(frame):
        assert not (isinstance(frame, bytes) and frame[0] == 2)
        assert "topics" not in str(frame)

    def full() -> bool:
        doing.sense("sensor:/scan", 0, 0.0, 0, b"")
        return not doing.hub.accepts("sensor:/scan")

    until(full)  # two are on their way: no more until they have been shown
    page.send('{"type":"subscribe","keys":[]}')
    until(lambda: not doing.hub.subscribed_keys)


def test_frames_that_were_shown_make_room_for_the_newest(page, doing, until) -> None:
    page.send('{"type":"subscribe","keys":["a"]}')
    until(lambda: doing.hub.accepts("a"))
    for k in range(50):
        doing.sense("a", 0, float(k), 0, b"")
    seen = []
    while not seen or seen[-1] != 50:
        frame = page.recv()
        if isinstance(frame, bytes) and frame[0] == 2:
            sequence = int.from_bytes(frame[4:8], "little")
            seen.append(sequence)
            page.send(json.dumps({"type": "seen", "key": "a", "sequence": sequence}))
    assert seen == sorted(seen)
