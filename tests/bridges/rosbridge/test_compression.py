import base64
import io
import json

import cbor2
import numpy as np
import pytest
from PIL import Image

from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.rosbridge import cbor
from urdfkit.bridges.rosbridge.subscription import compress, encoder, fragments
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields, typestore

SCAN = from_fields("sensor_msgs/msg/LaserScan", {"range_max": 30.0, "ranges": [1.5, float("inf")], "intensities": []})


@pytest.mark.parametrize(
    "value",
    [0, 23, 24, 255, 256, 65535, 65536, 2**32, 2**64 - 1, -1, -24, -25, -(2**63), 1.5, float("inf"), True, False, "",
     "é" * 30, b"\x00\xff", [1, [2.5, "x"]], {"a": {"b": []}}, ["x"] * 300],
)  # fmt: skip
def test_an_independent_decoder_reads_our_cbor(value: object) -> None:
    read = cbor2.loads(cbor.encode(value))
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize(
    ("kind", "tag"),
    [("u2", 69), ("u4", 70), ("u8", 71), ("i1", 72), ("i2", 77), ("i4", 78), ("i8", 79), ("f4", 85), ("f8", 86)],
)
def test_arrays_have_the_tags_of_rfc_8746_and_little_endian_bytes(kind: str, tag: int) -> None:
    values = np.array([0, 1, 100], kind)
    for stored in (values, values.astype(values.dtype.newbyteorder(">"))):
        read = cbor2.loads(cbor.encode(stored))
        assert read.tag == tag
        assert np.array_equal(np.frombuffer(read.value, "<" + kind), values)


def test_bytes_are_a_byte_string_and_booleans_a_list() -> None:
    assert cbor2.loads(cbor.encode(np.array([1, 255], np.uint8))) == b"\x01\xff"
    assert cbor2.loads(cbor.encode(np.array([True, False]))) == [True, False]


def test_raw_cbor_holds_the_message_in_cdr() -> None:
    sample = PublishedMessage("/scan", "sensor_msgs/msg/LaserScan", SCAN, 2.5)
    (frame,) = encoder("cbor-raw")(sample)
    read = cbor2.loads(frame)
    assert (read["op"], read["topic"], read["msg"]["secs"], read["msg"]["nsecs"]) == (
        "publish",
        "/scan",
        2,
        500_000_000,
    )
    back = typestore().deserialize_cdr(read["msg"]["bytes"], "sensor_msgs/msg/LaserScan")
    assert back.ranges.tolist() == [1.5, float("inf")]


@pytest.mark.parametrize("length", [0, 1, 2, 3, 11, 12, 13, 1000, 100_001])
def test_png_holds_the_text_and_line_breaks(length: int) -> None:
    text = json.dumps({"op": "publish", "data": "é" * length})
    packed = json.loads(compress(text))
    assert packed["op"] == "png"
    with Image.open(io.BytesIO(base64.b64decode(packed["data"]))) as image:
        assert image.mode == "RGB"
        assert image.tobytes().decode().rstrip("\n") == text


def test_a_message_is_encoded_once_for_all_subscribers() -> None:
    sample = PublishedMessage("/scan", "sensor_msgs/msg/LaserScan", SCAN, 0.0)
    (first,), (second,) = encoder("none")(sample), encoder("none")(sample)
    assert first is second
    assert json.loads(first)["msg"]["ranges"] == [1.5, None]


def test_fragments_add_up_to_the_text() -> None:
    text = json.dumps({"op": "publish", "data": "x" * 100})
    parts = [json.loads(str(part)) for part in fragments(text, 30)]
    assert [(part["num"], part["total"]) for part in parts] == [(k, len(parts)) for k in range(len(parts))]
    assert "".join(part["data"] for part in parts) == text
    assert len({part["id"] for part in parts}) == 1
    sample = PublishedMessage("/scan", "sensor_msgs/msg/LaserScan", SCAN, 0.0)
    assert len(encoder("none", 50)(sample)) > 2
    assert len(encoder("cbor", 50)(sample)) == 1


def test_an_unknown_compression_names_the_known_ones() -> None:
    with pytest.raises(UsageError, match="unknown compression `gzip`; use none, png, cbor, cbor-raw"):
        encoder("gzip")
