"""Frames as they go over the line."""

import pytest
from websocket import ABNF

from urdfkit.network.websocket_frame import SHORT, framed, framed_parts


@pytest.mark.parametrize("size", [0, 1, 125, 126, 127, 65_535, 65_536, 70_000])
@pytest.mark.parametrize("kind", [str, bytes])
def test_a_message_is_framed_as_another_library_does_it(kind: type, size: int) -> None:
    text = "é" * (size // 2) + "x" * (size % 2)
    message = text if kind is str else text.encode()
    frame = ABNF(
        fin=1, opcode=ABNF.OPCODE_TEXT if kind is str else ABNF.OPCODE_BINARY, mask_value=0, data=text.encode()
    )
    assert framed(message) == frame.format()


@pytest.mark.parametrize("sizes", [(), (3,), (3, 0, 200), (10, SHORT, 5), (70_000,), (1, 2, 70_000, SHORT, 1, 1)])
def test_parts_are_one_message_and_long_ones_are_not_copied(sizes: tuple[int, ...]) -> None:
    parts = [memoryview(bytes([k]) * size) for k, size in enumerate(sizes)]
    frames = framed_parts(parts)
    assert b"".join(frames) == framed(b"".join(parts))
    assert [each for each in frames if len(each) >= SHORT] == [each for each in parts if len(each) >= SHORT]
    assert all(any(each is part for each in frames) for part in parts if len(part) >= SHORT)
