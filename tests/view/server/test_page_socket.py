"""Frames as they go over the line."""

import pytest
from websocket import ABNF

from urdfkit.view.server.page_socket import framed


@pytest.mark.parametrize("size", [0, 1, 125, 126, 127, 65_535, 65_536, 70_000])
@pytest.mark.parametrize("kind", [str, bytes])
def test_a_message_is_framed_as_another_library_does_it(kind: type, size: int) -> None:
    text = "é" * (size // 2) + "x" * (size % 2)
    message = text if kind is str else text.encode()
    frame = ABNF(
        fin=1, opcode=ABNF.OPCODE_TEXT if kind is str else ABNF.OPCODE_BINARY, mask_value=0, data=text.encode()
    )
    assert framed(message) == frame.format()
