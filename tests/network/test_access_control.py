import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.network.access_control import AccessControl, host_name, is_loopback
from urdfkit.view.server.authenticated_handler import headers

GATE = AccessControl(7007)
OPEN = AccessControl(7007, names=("localhost", "127.0.0.1", "::1", "bench"), open_to_network=True)


@pytest.mark.parametrize("host", ["127.0.0.1:7007", "localhost:7007", "LOCALHOST", "[::1]:7007", "localhost:9000"])
def test_own_hosts_are_let_in(host: str) -> None:
    assert GATE.accepts_host(host)


@pytest.mark.parametrize(
    "host",
    ["", "evil.example", "evil.example:7007", "192.168.1.5:7007", "127.0.0.1.evil.example", "localhost@evil.example",
     "localhost/evil", "localhost:port", "localhost evil.example", "[::1", "127.0.0.1:7007:1"],
)  # fmt: skip
def test_foreign_hosts_are_not(host: str) -> None:
    assert not GATE.accepts_host(host)


def test_the_network_may_use_addresses_and_our_name_but_no_other() -> None:
    assert OPEN.accepts_host("192.168.1.5:7007")
    assert OPEN.accepts_host("bench:7007")
    assert not OPEN.accepts_host("evil.example:7007")


def test_origin_must_be_exactly_the_page() -> None:
    host = "127.0.0.1:7007"
    assert GATE.accepts_origin("http://127.0.0.1:7007", host)
    for origin in (None, "null", "", "https://127.0.0.1:7007", "http://127.0.0.1:7008", "http://127.0.0.1",
                   "http://127.0.0.1:7007.evil.example", "http://evil.example"):  # fmt: skip
        assert not GATE.accepts_origin(origin, host)


@given(st.text())
def test_no_other_token_or_cookie_fits(text: str) -> None:
    assert not GATE.accepts_token(text)
    assert not GATE.accepts_session(text)


def test_token_and_cookie_fit_and_differ() -> None:
    assert GATE.accepts_token(GATE.token)
    assert GATE.accepts_session(GATE.session)
    assert not GATE.accepts_session(None)
    assert GATE.token != GATE.session
    assert len({AccessControl(1).token for _ in range(20)}) == 20
    assert len(GATE.token) >= 32
    assert GATE.token not in repr(GATE)


@given(st.text())
def test_host_name_never_raises_and_headers_stay_one_line(text: str) -> None:
    host_name(text)
    assert all("\n" not in value and "\r" not in value for value in headers(text).values())


def test_policy_runs_no_foreign_or_generated_script() -> None:
    policy = headers("127.0.0.1:7007")["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "script-src 'self';" in policy
    assert "unsafe-eval" not in policy
    assert "unsafe-inline" not in policy


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("127.0.0.1", True),
        ("127.1.2.3", True),
        ("::1", True),
        ("localhost", True),
        ("0.0.0.0", False),
        ("bench", False),
    ],
)
def test_is_loopback(host: str, expected: bool) -> None:
    assert is_loopback(host) is expected
