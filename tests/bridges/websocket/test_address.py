import pytest

from urdfkit.bridges.websocket.address import parse_address
from urdfkit.errors import UsageError


@pytest.mark.parametrize(
    ("text", "host", "port", "private"),
    [
        ("9090", "127.0.0.1", 9090, True),
        ("0.0.0.0:9091", "0.0.0.0", 9091, False),
        ("localhost:1", "localhost", 1, True),
        ("[::1]:8765", "::1", 8765, True),
        ("[::]:8765", "::", 8765, False),
    ],
)
def test_addresses(text: str, host: str, port: int, private: bool) -> None:
    address = parse_address(text)
    assert address == (host, port)
    assert address.is_private is private


@pytest.mark.parametrize("text", ["", "x", ":9090", "1.2.3.4", "65536", "-1", "localhost:", "simpleton", "９０"])
def test_no_address(text: str) -> None:
    with pytest.raises(UsageError, match="use PORT or HOST:PORT"):
        parse_address(text)
