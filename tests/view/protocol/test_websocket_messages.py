import json
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.view.protocol import websocket_messages
from urdfkit.view.protocol.page_requests import Schema, check, number, tree, whole
from urdfkit.view.protocol.websocket_messages import Ack, Axes, Control, Joints, ProtocolError, read


def test_what_a_page_may_say() -> None:
    assert read('{"type":"joints","positions":{"a":1,"b":-0.5}}') == Joints({"a": 1.0, "b": -0.5})
    assert read('{"type":"axes","axes":[1,0,0,-1],"speed":0.5,"turn":1}') == Axes((1, 0, 0, -1), 0.5, 1.0)
    assert read('{"type":"control","action":"pause"}') == Control("pause")
    assert read('{"type":"ack","sequence":7}') == Ack(7)


@pytest.mark.parametrize(
    "frame",
    [
        "", "nonsense", "[]", "1", "null", '"joints"', "{}", '{"type":"reboot"}', '{"type":["joints"]}', '{"type":{}}',
        '{"type":"joints"}', '{"type":"joints","positions":[]}', '{"type":"joints","positions":{"a":null}}',
        '{"type":"joints","positions":{"a":true}}', '{"type":"joints","positions":{"a":"1"}}',
        '{"type":"joints","positions":{"a":NaN}}', '{"type":"joints","positions":{"a":Infinity}}',
        '{"type":"joints","positions":{"a":-Infinity}}', '{"type":"joints","positions":{"a":1e999}}',
        '{"type":"joints","positions":{"a":1e7}}', '{"type":"joints","positions":{"a":1},"more":1}',
        '{"type":"axes","axes":[1,0,0],"speed":1,"turn":1}',
        '{"type":"axes","axes":[2,0,0,0],"speed":1,"turn":1}',
        '{"type":"axes","axes":[NaN,0,0,0],"speed":1,"turn":1}', '{"type":"axes","axes":"1000","speed":1,"turn":1}',
        '{"type":"axes","axes":[1,0,0,0],"speed":-1,"turn":1}',
        '{"type":"axes","axes":[1,0,0,0],"speed":1e999,"turn":1}',
        '{"type":"control","action":"exec"}', '{"type":"control","action":null}', '{"type":"control","action":{}}',
        '{"type":"ack","sequence":-1}', '{"type":"ack","sequence":4294967296}', '{"type":"ack","sequence":1.5}',
        '{"type":"ack","sequence":true}', b'{"type":"ack","sequence":1}', "[" * 30000,
        '{"type":"ack","sequence":' + "9" * 5000 + "}",
    ],
    ids=lambda frame: repr(frame)[:60],
)  # fmt: skip
def test_everything_else_is_refused(frame: str | bytes) -> None:
    with pytest.raises(ProtocolError):
        read(frame)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(max_size=8), inner, max_size=5),
    max_leaves=20,
)
NEAR_MISSES = st.fixed_dictionaries(
    {"type": st.sampled_from(["joints", "axes", "control", "ack"]) | JSON},
    optional=dict.fromkeys(("positions", "axes", "speed", "turn", "action", "sequence"), JSON),
)


@given(st.one_of(st.text(), st.binary(), JSON.map(json.dumps), NEAR_MISSES.map(json.dumps)))
def test_random_frames_are_read_or_refused_and_nothing_else(frame: str | bytes) -> None:
    try:
        message = read(frame)
    except ProtocolError:
        return
    numbers = {
        Joints: lambda m: list(m.positions.values()),
        Axes: lambda m: [*m.axes, m.speed, m.turn],
        Control: lambda m: [],
        Ack: lambda m: [m.sequence],
    }[type(message)](message)
    assert all(np.isfinite(numbers))


def test_what_python_says_is_one_json_object_of_finite_numbers() -> None:
    assert json.loads(websocket_messages.write("status", time=1.5)) == {"type": "status", "time": 1.5}
    with pytest.raises(ValueError, match="JSON"):
        websocket_messages.write("status", time=float("nan"))


def test_poses_are_packed_in_sixteen_bytes_and_seven_floats_each() -> None:
    poses = np.arange(14.0).reshape(2, 7)
    frame = websocket_messages.pack_poses(2**32 + 5, 12.25, poses, model=3)
    assert struct.unpack_from("<BBHId", frame) == (1, 3, 2, 5, 12.25)
    assert np.array_equal(np.frombuffer(frame, "<f4", offset=16).reshape(2, 7), poses)
    assert len(websocket_messages.pack_poses(0, 0.0, np.zeros((30, 7)))) == 856


@pytest.mark.parametrize("digits", ["1" + "0" * 400, "-1" + "0" * 4000])
def test_an_integer_that_no_float_can_hold_is_refused_with_an_answer(digits: str) -> None:
    raw = read(f'{{"type":"request","number":1,"name":"move","values":{{"x":{digits},"y":{digits}}}}}')
    for schema in ({"x": number(), "y": number()}, {"x": whole(), "y": whole()}, {"x": tree, "y": tree}):
        with pytest.raises(ProtocolError, match=r"too|integer|finite"):
            check({"move": Schema(schema)}, 1, raw)
