import re
import socket

import pytest

from urdfkit.errors import UsageError
from urdfkit.network.listen_address import bind, urls


@pytest.fixture
def busy() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        yield taken.getsockname()[1]


def test_a_busy_port_is_one_line_that_names_a_free_one(busy: int) -> None:
    with pytest.raises(UsageError) as caught:
        bind("127.0.0.1", busy)
    found = re.fullmatch(rf"port {busy} is in use; (\d+) is free", str(caught.value))
    assert found
    listening, port = bind("127.0.0.1", int(found[1]))
    listening.close()
    assert port == int(found[1])


def test_the_usual_port_gives_way_to_the_next() -> None:
    first, one = bind("127.0.0.1", None)
    second, other = bind("127.0.0.1", None)
    first.close()
    second.close()
    assert one != other


def test_a_second_server_cannot_share_the_port() -> None:
    listening, port = bind("127.0.0.1", 0)
    with listening, pytest.raises(UsageError, match="in use"):
        bind("127.0.0.1", port)


@pytest.mark.parametrize("port", [-1, 65536])
def test_no_such_port(port: int) -> None:
    with pytest.raises(UsageError, match=r"outside 0\.\.65535"):
        bind("127.0.0.1", port)


@pytest.mark.parametrize(
    ("host", "reason"),
    [("192.0.2.7", "not an address of this machine"), ("no-such-host.invalid", "unknown host name")],
)
def test_an_address_that_is_not_ours_is_reported_with_a_usable_one(host: str, reason: str) -> None:
    with pytest.raises(UsageError, match=f"cannot listen on `{host}`: {reason}; use 127.0.0.1 for this machine alone"):
        bind(host, 0)


def test_loopback_only_is_bound_by_default() -> None:
    listening, _ = bind("127.0.0.1", 0)
    with listening:
        assert listening.getsockname()[0] == "127.0.0.1"


def test_urls() -> None:
    assert urls("127.0.0.1", 7007, "key") == ["http://127.0.0.1:7007/?token=key"]
    assert urls("::1", 7007, "key") == ["http://[::1]:7007/?token=key"]
    assert urls("0.0.0.0", 7007, "key")[0] == "http://127.0.0.1:7007/?token=key"
