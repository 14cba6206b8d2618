"""Who is let in, what is served, what a page may say: as anybody on the network could try it."""

import contextlib
import gzip
import http.client
import json
import logging
import random
import re
from urllib.parse import urlsplit

import pytest
import websocket

from tests.time_limit import PATIENCE
from urdfkit.view.protocol import websocket_messages
from urdfkit.view.server import http_handlers

ZEROS = "0" * 64


def test_the_key_becomes_a_cookie_and_leaves_the_address(client, server) -> None:
    answer = client.get("/?" + urlsplit(server.url).query)
    assert answer.status == 303
    assert answer.headers["location"] == "/"
    name, *attributes = answer.headers["set-cookie"].split("; ")
    assert name.startswith(f"urdfkit-{server.port}=")
    assert {"HttpOnly", "Path=/", "SameSite=Strict"} == set(attributes)
    assert server.access.token not in answer.headers["set-cookie"]
    client.cookie = name
    page = client.get("/")
    assert page.status == 200
    assert b"/app/app.js" in page.body
    assert server.access.token.encode() not in page.body


@pytest.mark.parametrize("path", ["/", f"/geometry/{ZEROS}", "/ws", "/nothing", "/?token=", "/?token=wrong",
                                  "/?token=a&token=b", "/?token=%00"])  # fmt: skip
def test_without_the_key_nobody_gets_in(client, path: str) -> None:
    answer = client.get(path)
    assert answer.status == 403
    assert "set-cookie" not in answer.headers
    assert b"urdfkit printed in the terminal" in answer.body


@pytest.mark.parametrize(
    "cookie", ["urdfkit-{port}=wrong", "urdfkit-1={session}", "urdfkit-{port}=", "{session}", ";;=;"]
)
def test_a_wrong_cookie_is_no_cookie(client, server, cookie: str) -> None:
    client.cookie = cookie.format(port=server.port, session=server.access.session)
    assert client.get("/").status == 403


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "", None, "192.168.0.9:{port}", "127.0.0.1:{port}, x"]
)
@pytest.mark.parametrize("path", ["/", "/app/app.js", f"/geometry/{ZEROS}", "/ws", "/?token={token}"])
def test_a_foreign_host_is_refused_even_with_the_key(client, server, host: str | None, path: str) -> None:
    client.log_in()
    answer = client.get(path.format(token=server.access.token), Host=host and host.format(port=server.port))
    assert answer.status in (400, 403)
    assert "set-cookie" not in answer.headers


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1:1", ""])
def test_a_foreign_page_is_refused_even_with_the_cookie(client, server, origin: str) -> None:
    client.log_in()
    assert client.get("/", Origin=origin).status == 403
    assert client.get(f"/?token={server.access.token}", Origin=origin).status == 403
    assert client.get(f"/geometry/{ZEROS}", Origin=origin).status == 403


@pytest.mark.parametrize("options", [
    {"cookie": None}, {"cookie": "urdfkit-1=x"}, {"origin": "http://evil.example"}, {"origin": "http://127.0.0.1:1"},
    {"host": "evil.example"}, {"suppress_origin": True},
], ids=str)  # fmt: skip
def test_a_websocket_needs_cookie_origin_and_host(client, options: dict) -> None:
    client.log_in()
    with pytest.raises(websocket.WebSocketBadStatusException) as caught:
        client.socket(**options)
    assert caught.value.status_code == 403


def test_every_answer_carries_the_policy(client, server) -> None:
    refused = client.get("/")
    client.log_in()
    for answer in (
        refused,
        client.get("/"),
        client.get("/app/app.js"),
        client.get("/nothing"),
        client.get(f"/geometry/{ZEROS}"),
    ):
        assert "script-src 'self'" in answer.headers["content-security-policy"]
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["x-frame-options"] == "DENY"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["cache-control"] == "no-store"
        assert "server" not in answer.headers


@pytest.mark.parametrize("path", [
    "/app/../web.py", "/app/..%2fweb.py", "/app/%2e%2e/web.py", "/app//etc/passwd", "/app/....//web.py", "/app/web.py",
    "/app/.", "/app/", "/static/x", "/etc/passwd", "//etc/passwd", "/geometry/../../etc/passwd", f"/geometry/{ZEROS}",
    "/geometry/" + "g" * 64, "/app/app.js%00.html", "/app/" + "a" * 5000,
])  # fmt: skip
def test_no_path_leads_out(client, path: str) -> None:
    answer = client.log_in().get(path)
    assert answer.status == 404
    assert b"root:" not in answer.body


def test_the_page_and_all_it_asks_for_is_there_and_small(client) -> None:
    client.log_in()
    wire = 0
    files = (path for path in http_handlers.APP.rglob("*") if path.suffix in (".js", ".css", ".svg"))
    own = sorted(path.relative_to(http_handlers.APP).as_posix() for path in files)
    names = ["/", "/app/meshcat.js", *(f"/app/{name}" for name in own)]
    for name in names:
        answer = client.get(name, Accept_Encoding="gzip")
        assert answer.status == 200, name
        wire += len(answer.body)
    assert wire < 1_500_000


def test_files_come_packed_and_plain_the_same(client) -> None:
    client.log_in()
    for name in ("app.js", "styles/style.css", "meshcat.js"):
        small, plain = client.get(f"/app/{name}", Accept_Encoding="gzip, br"), client.get(f"/app/{name}")
        assert small.headers["content-encoding"] == "gzip"
        assert "content-encoding" not in plain.headers
        assert gzip.decompress(small.body) == plain.body
        assert small.headers["vary"] == plain.headers["vary"] == "Accept-Encoding"


def test_the_page_names_its_modules_at_the_top(client) -> None:
    text = client.log_in().get("/").body.decode()
    named = re.findall(r'<link rel="modulepreload" href="/app/([\w./-]+)">', text.partition("</head>")[0])
    assert {"app.js", "robot/robot_features.js", "viewport/scene_nodes.js"} <= set(named)
    for name in named:
        assert client.get(f"/app/{name}").status == 200


def test_a_key_that_is_no_text_is_refused(client) -> None:
    assert client.get("/?token=%ff%fe").status in (400, 403)


def test_only_reading_is_possible(client) -> None:
    client.log_in()
    for method in ("POST", "PUT", "DELETE", "PATCH"):
        assert client.get("/", method=method).status in (403, 405)


def test_an_oversized_body_is_refused(client, server) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
    connection.putrequest("POST", "/")
    connection.putheader("Content-Length", str(10**9))
    connection.endheaders()
    try:
        assert connection.getresponse().status in (400, 403, 413)
    except (http.client.RemoteDisconnected, ConnectionResetError):
        pass  # closed without a word: also refused
    finally:
        connection.close()
    assert client.log_in().get("/").status == 200


def read_to_the_end(connected: websocket.WebSocket) -> None:
    with contextlib.suppress(websocket.WebSocketConnectionClosedException, ConnectionError):
        while connected.recv():
            pass


def test_a_frame_over_the_cap_closes_the_line_and_nothing_else(client, page, server, until, caplog) -> None:
    other = client.socket()
    page.send("x" * (websocket_messages.MAX_INBOUND + 1))
    read_to_the_end(page)
    other.send('{"type":"joints","positions":{"lift":0.2}}')
    assert until(server.inbox.take).joints == {"lift": 0.2}
    assert until(lambda: "longer than 65536 bytes; connection closed" in caplog.text)


def test_a_frame_that_is_none_closes_the_line_with_a_word(page, until, caplog) -> None:
    page.sock.sendall(b"\xf3\x80\x00\x00\x00\x00")  # bits that mean nothing are set
    read_to_the_end(page)
    assert until(lambda: "a frame was malformed" in caplog.text)


@pytest.mark.parametrize("status", [1000, 1001, 1005])
def test_a_page_that_says_goodbye_is_no_refusal(page, server, until, caplog, status: int) -> None:
    until(lambda: server.hub.watchers)
    code = b"" if status == 1005 else status.to_bytes(2, "big")
    page.sock.sendall(bytes((0x88, 0x80 | len(code))) + bytes(4) + code)  # a tab that is closed states 1001 or nothing
    read_to_the_end(page)
    until(lambda: not server.hub.watchers)
    assert "rejected" not in caplog.text


def test_a_page_that_goes_away_is_no_refusal(page, server, until, caplog) -> None:
    until(lambda: server.hub.watchers)
    page.sock.close()
    until(lambda: not server.hub.watchers)
    assert "rejected" not in caplog.text


@pytest.mark.parametrize("frame", ["", "nonsense", "{}", '{"type":"joints","positions":{"lift":NaN}}',
                                   '{"type":"joints","positions":{"lift":1e999}}', '{"type":"control","action":"exec"}',
                                   '{"type":"axes","axes":[9,9,9,9],"speed":1,"turn":1}', "[" * 60000])  # fmt: skip
def test_nonsense_is_dropped_with_a_word_in_the_log(page, server, until, caplog, frame: str) -> None:
    with caplog.at_level(logging.WARNING, "urdfkit.view"):
        page.send(frame)
        page.send('{"type":"joints","positions":{"lift":0.2}}')
        assert until(server.inbox.take).joints == {"lift": 0.2}
    assert "dropped a message" in caplog.text
    assert server.drive_lock.axes is None


def test_a_page_that_talks_nonsense_all_day_does_not_fill_the_log(page, server, until, caplog) -> None:
    with caplog.at_level(logging.WARNING, "urdfkit.view"):
        for _ in range(100):
            page.send("nonsense")
        page.send('{"type":"joints","positions":{"lift":0.2}}')
        until(server.inbox.take)
    assert caplog.text.count("dropped") == 10


def test_two_thousand_random_frames_leave_it_serving(client, page, server, until) -> None:
    chance = random.Random(7)
    kinds = [b'{"type":"joints","positions":{"lift":', b'{"type":"axes","axes":[', b"{", b"\x01", b"\xff\xfe", b""]
    for number in range(2000):
        body = chance.choice(kinds) + bytes(chance.randrange(256) for _ in range(chance.randrange(40)))
        try:
            if number % 2:
                page.send_binary(body)
            else:
                page.send(body.decode("latin-1"))
        except (websocket.WebSocketException, OSError):
            page = client.socket()  # a frame that closed the line
    client.socket().send('{"type":"joints","positions":{"lift":0.25}}')
    until(lambda: server.inbox.take().joints.get("lift") == 0.25)
    assert client.get("/").status == 200


def test_only_joints_that_are_there_and_move_on_their_own_are_passed_on(page, server, until) -> None:
    page.send('{"type":"joints","positions":{"lift":0.2,"echo":0.2,"other":1,"__proto__":1}}')
    assert until(server.inbox.take).joints == {"lift": 0.2}


def test_geometry_is_served_by_its_content_and_may_be_kept(client, server) -> None:
    import numpy as np
    import trimesh

    from urdfkit.scene import TriMesh

    box = trimesh.creation.box()
    name = server.geometries.add(
        TriMesh(np.asarray(box.vertices, dtype=np.float32), np.asarray(box.faces, dtype=np.int32))
    )
    answer = client.log_in().get(f"/geometry/{name}")
    assert answer.status == 200
    assert answer.body == gzip.decompress(server.geometries.get(name))
    assert "immutable" in answer.headers["cache-control"]
    answer = client.get(f"/geometry/{name}", Accept_Encoding="gzip, br")
    assert (answer.headers["content-encoding"], answer.body) == ("gzip", server.geometries.get(name))
    client.cookie = None
    assert client.get(f"/geometry/{name}").status == 403


def test_textures_are_served_in_the_sizes_of_the_page(client, server) -> None:
    import numpy as np

    from urdfkit.meshes.textures import Texture
    from urdfkit.scene import TriMesh

    corners = np.eye(3, dtype=np.float32)
    texture = Texture(np.full((8, 8, 4), 200, np.uint8))
    server.geometries.add(
        TriMesh(corners, np.array([[0, 1, 2]], np.int32), uv=corners[:, :2].copy(), textures=(texture,))
    )
    ((name, image),) = server.geometries.images
    answer = client.log_in().get(f"/texture/{name}?edge=1024")
    assert (answer.status, answer.headers["content-type"], answer.body) == (200, "image/webp", image)
    assert client.get(f"/texture/{name}?edge=7").status == 404
    assert client.get(f"/texture/{'0' * 64}").status == 404
    client.cookie = None
    assert client.get(f"/texture/{name}").status == 403


def test_refusals_are_logged_without_the_key(client, server, caplog) -> None:
    client.get("/?token=guess")
    client.get(f"/?token={server.access.token}", Origin="http://evil.example")
    client.get("/", Host="evil.example")
    lines = [record.getMessage() for record in caplog.records if record.levelno == logging.WARNING]
    assert [line.partition(": ")[0] for line in lines[:3]] == ["rejected GET / from 127.0.0.1"] * 3
    assert "token in the address is wrong" in lines[0]
    assert "another site" in lines[1]
    assert "not accepted by this server" in lines[2]
    assert server.access.token not in caplog.text
    assert "guess" not in caplog.text


def test_missing_meshcat_is_one_line(monkeypatch) -> None:
    from urdfkit.errors import MissingDependencyError

    monkeypatch.setattr(http_handlers, "find_spec", lambda name: None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'urdfkit\[view\]'"):
        http_handlers.meshcat_bundle()


def test_hello_comes_first_and_says_the_version(page, text) -> None:
    first = json.loads(page.recv())
    assert first["type"] == "you"
    assert text(page, "hello")["protocol"] == websocket_messages.VERSION
