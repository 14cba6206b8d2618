"""CBOR of messages (RFC 8949), with typed arrays (RFC 8746), as rosbridge writes it."""

import struct
from typing import Any

import numpy as np

from urdfkit.messages.conversion import LONG, fields_of

TYPED_ARRAYS = {
    "u2": 69, "u4": 70, "u8": 71, "i1": 72, "i2": 77, "i4": 78, "i8": 79, "f4": 85, "f8": 86,
}  # fmt: skip
"""Kind and size of the entries of an array → tag of its little-endian bytes."""
UNSIGNED, NEGATIVE, BYTES, TEXT, ARRAY, MAP, TAG = range(7)


Parts = list[bytes | memoryview]


def encode(value: Any) -> bytes:
    """Return a message, a dict, or the value of a field, as CBOR."""
    return b"".join(encode_parts(value))


def encode_parts(value: Any) -> Parts:
    """Return the parts of the CBOR; long arrays of bytes are not copied."""
    parts: Parts = []
    _write(parts, value)
    return parts


def _head(major: int, number: int) -> bytes:
    first = major << 5
    if number < 24:
        return bytes((first | number,))
    for info, kind, limit in ((24, "B", 1 << 8), (25, "H", 1 << 16), (26, "I", 1 << 32)):
        if number < limit:
            return struct.pack(f">B{kind}", first | info, number)
    return struct.pack(">BQ", first | 27, number)


def _write(parts: Parts, value: Any) -> None:
    if isinstance(value, np.ndarray):
        _array(parts, value)
    elif isinstance(value, str):
        text = value.encode("utf-8", "surrogatepass")
        parts += (_head(TEXT, len(text)), text)
    elif isinstance(value, bytes):
        parts += (_head(BYTES, len(value)), value)
    elif isinstance(value, bool | np.bool_):
        parts.append(b"\xf5" if value else b"\xf4")
    elif isinstance(value, int | np.integer):
        number = int(value)
        parts.append(_head(UNSIGNED, number) if number >= 0 else _head(NEGATIVE, -1 - number))
    elif isinstance(value, float | np.floating):
        parts.append(struct.pack(">Bd", 0xFB, value))
    elif isinstance(value, list | tuple):
        parts.append(_head(ARRAY, len(value)))
        for each in value:
            _write(parts, each)
    else:
        items = (
            value.items() if isinstance(value, dict) else [(name, getattr(value, name)) for name in fields_of(value)]
        )
        parts.append(_head(MAP, len(items)))
        for name, each in items:
            _write(parts, name)
            _write(parts, each)


def _array(parts: Parts, values: Any) -> None:
    if values.dtype == np.uint8:
        content = values.tobytes() if values.nbytes < LONG else np.ascontiguousarray(values).reshape(-1).data
        parts += (_head(BYTES, values.nbytes), content)
        return
    tag = TYPED_ARRAYS.get(f"{values.dtype.kind}{values.dtype.itemsize}")
    if tag is None:
        _write(parts, values.tolist())
    else:
        little = values.astype(values.dtype.newbyteorder("<"), copy=False)
        parts += (_head(TAG, tag), _head(BYTES, values.nbytes), little.tobytes())
