"""PNG compression of rosbridge: the bytes of a JSON text are the pixels of an RGB image."""

import base64
import json
import math
import struct
import zlib

LEVEL = 1
"""Level of zlib: the fastest one, because the text is compressed for every message."""


def compress(text: str) -> str:
    """Return the ``png`` message with a JSON text; the image is filled up with line breaks."""
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
