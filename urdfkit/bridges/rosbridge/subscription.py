"""Subscription of a rosbridge client: its compression, and the frames of a message."""

import base64
import itertools
import json
import math
import struct
import zlib

from urdfkit.bridges.json_messages import to_json
from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.rosbridge import cbor
from urdfkit.bridges.websocket.send_queue import Encode, Frame
from urdfkit.errors import UsageError

COMPRESSIONS = ("none", "png", "cbor", "cbor-raw")
_FRAGMENTS = itertools.count(1)


def encoder(compression: str, fragment_size: int | None = None) -> Encode:
    """Return the function that makes the frames of a message.

    Args:
        compression: one of `COMPRESSIONS`.
        fragment_size: maximum number of characters of a frame of JSON; None for no limit.

    Raises:
        UsageError: the compression is unknown.
    """
    if compression not in COMPRESSIONS:
        raise UsageError(f"unknown compression `{compression}`; use {', '.join(COMPRESSIONS)}")

    def encode(sample: PublishedMessage) -> list[Frame]:
        frame: Frame = sample.encoded(compression, ENCODERS[compression])
        if fragment_size is None or not isinstance(frame, str) or len(frame) <= fragment_size:
            return [frame]
        return fragments(frame, fragment_size)

    return encode


def as_json(sample: PublishedMessage) -> str:
    """Return a message as a ``publish`` in JSON."""
    return f'{{"op":"publish","topic":{json.dumps(sample.topic)},"msg":{to_json(sample.message)}}}'


def _as_png(sample: PublishedMessage) -> str:
    return compress(sample.encoded("none", as_json))


def _as_cbor(sample: PublishedMessage) -> cbor.Parts:
    return cbor.encode_parts({"op": "publish", "topic": sample.topic, "msg": sample.message})


def _as_raw_cbor(sample: PublishedMessage) -> bytes:
    seconds, nanoseconds = divmod(round(sample.t * 1e9), 10**9)
    content = {"secs": seconds, "nsecs": nanoseconds, "bytes": b"".join(sample.cdr())}
    return cbor.encode({"op": "publish", "topic": sample.topic, "msg": content})


ENCODERS = {"none": as_json, "png": _as_png, "cbor": _as_cbor, "cbor-raw": _as_raw_cbor}


def fragments(text: str, size: int) -> list[Frame]:
    """Return a text as ``fragment`` messages with at most `size` characters of it each."""
    parts = [text[k : k + size] for k in range(0, len(text), size)]
    name = str(next(_FRAGMENTS))
    return [
        json.dumps({"op": "fragment", "id": name, "data": part, "num": number, "total": len(parts)})
        for number, part in enumerate(parts)
    ]


LEVEL = 1
"""Level of zlib: the fastest one, because the text is compressed for every message."""


def compress(text: str) -> str:
    """Return the ``png`` message with a JSON text, whose bytes are the pixels of an RGB image.

    The image is filled up with line breaks.
    """
    content = text.encode()
    width = max(1, math.isqrt(len(content) // 3))
    height = -(-len(content) // (3 * width))
    content = content.ljust(3 * width * height, b"\n")
    rows = b"".join(b"\0" + content[k : k + 3 * width] for k in range(0, len(content), 3 * width))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = (_chunk(b"IHDR", header), _chunk(b"IDAT", zlib.compress(rows, LEVEL)), _chunk(b"IEND", b""))
    return json.dumps({"op": "png", "data": base64.b64encode(b"\x89PNG\r\n\x1a\n" + b"".join(chunks)).decode("ascii")})


def _chunk(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
