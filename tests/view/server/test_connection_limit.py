"""Others can neither use up the connections of the server nor keep a new page from opening."""

import socket
from http.client import HTTPConnection

import pytest
import websocket

from tests.time_limit import PATIENCE
from urdfkit.network import connection_limit
from urdfkit.network.connection_limit import LimitedHTTPServer, limits
from urdfkit.view.server.page_socket import PageSocket
from urdfkit.view.server.server import Server


def unfinished(server) -> socket.socket:
    """Return a connection with a request that does not end."""
    line = socket.create_connection(("127.0.0.1", server.port))
    line.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n".encode())
    return line


def is_closed(line: socket.socket) -> bool:
    line.settimeout(0.0)
    try:
        return line.recv(1) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


def test_unfinished_requests_give_way_to_new_ones(client, server, until, monkeypatch) -> None:
    monkeypatch.setattr(LimitedHTTPServer, "most", 5)
    client.log_in()
    page = client.socket()
    lines = [unfinished(server) for _ in range(20)]
    assert client.get("/").status == 200
    until(lambda: sum(map(is_closed, lines)) >= 15)
    assert not is_closed(lines[-1])
    assert client.get("/").status == 200
    page.ping()
    page.send('{"type":"joints","positions":{"lift":0.25}}')
    until(lambda: server.inbox.take().joints)
    for line in lines:
        line.close()


def test_many_requests_of_one_connection_count_once(client, server, monkeypatch) -> None:
    monkeypatch.setattr(LimitedHTTPServer, "most", 1)
    connection = HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
    for _ in range(3):
        connection.request("GET", "/app/styles/refused.css", headers={"Host": client.host})
        response = connection.getresponse()
        response.read()
        assert response.status == 200
    assert connection.sock is not None  # the same connection all the time
    connection.close()


def test_a_page_too_many_is_refused_with_a_line_and_accepted_when_another_closes(
    client, server, until, monkeypatch, caplog
) -> None:
    monkeypatch.setattr(PageSocket, "most", 2)
    client.log_in()
    pages = [client.socket(), client.socket()]
    until(lambda: server.hub.watchers == 2)
    with pytest.raises(websocket.WebSocketBadStatusException, match="503"):
        client.socket()
    assert "2 pages are open already; close one of them" in caplog.text
    pages[0].close()
    until(lambda: server.hub.watchers == 1)
    assert client.socket().connected


def test_a_request_that_does_not_end_is_closed(until, monkeypatch) -> None:
    monkeypatch.setattr("urdfkit.network.server_thread.REQUEST_TIMEOUT", 0.2)
    with Server("view", port=0) as brief, unfinished(brief) as headers, unfinished(brief) as body:
        body.sendall(b"Content-Length: 9\r\n\r\n12")
        until(lambda: is_closed(headers) and is_closed(body))


def test_limits_leave_files_for_other_purposes(monkeypatch) -> None:
    resource = pytest.importorskip("resource")
    for files, expected in ((256, (128, 64)), (1024, (512, 256)), (1 << 20, (512, 256))):
        monkeypatch.setattr(resource, "getrlimit", lambda _, files=files: (files, files))
        assert limits() == expected
    monkeypatch.setattr(resource, "getrlimit", lambda _: (resource.RLIM_INFINITY,) * 2)
    assert limits() == (connection_limit.MOST_PAGES, connection_limit.MOST_REQUESTS)
