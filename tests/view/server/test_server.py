import contextlib
import struct
import threading

import numpy as np
import pytest
import umsgpack

from tests.time_limit import PATIENCE
from urdfkit.errors import UsageError
from urdfkit.view.protocol.websocket_messages import Axes
from urdfkit.view.server.drive_lock import DEADMAN
from urdfkit.view.server.server import Server

POSES = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (2, 1))
AHEAD = '{"type":"axes","axes":[1,0,0,0],"speed":0.5,"turn":1}'
NOTHING = '{"type":"axes","axes":[0,0,0,0],"speed":0.5,"turn":1}'


def test_a_page_gets_the_scene_then_the_model_then_poses(page, server, text, poses) -> None:
    server.publish(1.5, POSES)
    commands = []
    while isinstance(frame := page.recv(), str | bytes):
        if isinstance(frame, bytes) and frame[0] != 1:
            commands.append(umsgpack.unpackb(frame))
        elif isinstance(frame, str) and '"model"' in frame:
            break
    assert {c["path"] for c in commands if c["type"] == "set_object"} == {
        "/robot/links/base/visual/0",
        "/robot/links/mast/collision/0",
    }
    frame = poses(page)
    mark, model, count, _, time = struct.unpack_from("<BBHId", frame)
    assert (mark, model, count, time) == (1, 1, 2, 1.5)


def test_a_new_scene_has_a_new_number(page, server, scene, text, poses) -> None:
    assert text(page, "model")["number"] == 1
    server.show(name="other", nodes=["/robot/links/base"], draw=lambda window: None)
    model = text(page, "model")
    assert (model["number"], model["name"], model["nodes"]) == (2, "other", ["/robot/links/base"])
    server.publish(0.0, POSES[:1])
    assert poses(page)[1] == 2


def test_a_page_that_acknowledges_nothing_gets_three_frames_and_later_the_newest(
    page, server, text, poses, until
) -> None:
    text(page, "model")
    received = []
    for number in range(3):
        server.publish(float(number), POSES)
        received.append(struct.unpack_from("<d", poses(page), 8)[0])
    assert received == [0.0, 1.0, 2.0]
    for number in range(3, 100):
        server.publish(float(number), POSES)
    server.broadcast("status", mark="end")
    text(page, "status")  # arrives though poses are held back
    page.send('{"type":"ack","sequence":2}')
    assert struct.unpack_from("<d", poses(page), 8)[0] == 99.0


def test_a_page_that_does_not_read_holds_nobody_up(client, server, text, poses) -> None:
    client.log_in()
    stalled = [client.socket() for _ in range(3)]
    watching = client.socket()
    text(watching, "model")
    for number in range(2000):
        server.publish(float(number), POSES)
        server.broadcast("status", number=number)
    page_time, sequence = -1.0, 0
    while page_time < 1999.0:
        frame = poses(watching)
        _, _, _, sequence, page_time = struct.unpack_from("<BBHId", frame)
        watching.send(f'{{"type":"ack","sequence":{sequence}}}')
    assert server.hub.watchers == 1 + len(stalled)


def test_wishes_reach_the_caller(page, server, until) -> None:
    page.send('{"type":"joints","positions":{"lift":0.3}}')
    assert server.inbox.wait(PATIENCE).joints == {"lift": 0.3}
    page.send('{"type":"control","action":"pause"}')
    assert server.inbox.wait(PATIENCE).actions == ("pause",)


def test_the_wheel_is_let_go_with_the_key_the_page_and_the_line(client, page, server, until) -> None:
    page.send(AHEAD)
    assert until(lambda: server.drive_lock.axes) == Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0)
    page.send(NOTHING)
    until(lambda: server.drive_lock.axes is None)

    page.send(AHEAD)
    until(lambda: server.drive_lock.axes)
    page.shutdown()  # no goodbye: the line is cut
    until(lambda: server.drive_lock.axes is None)

    again = client.socket()
    again.send(AHEAD)
    until(lambda: server.drive_lock.axes)
    server.drive_lock._clock = lambda: DEADMAN + 0.01
    assert server.drive_lock.axes is None  # silence


def test_a_second_page_watches_while_the_first_drives(client, page, server, text, until) -> None:
    second = client.socket()
    page.send(AHEAD)
    until(lambda: server.drive_lock.axes)
    holder = server.drive_lock.holder
    second.send('{"type":"axes","axes":[-1,0,0,0],"speed":0.5,"turn":1}')
    second.send('{"type":"control","action":"play"}')  # comes after
    assert text(second, "notice")["text"].startswith("play rejected")
    assert server.drive_lock.holder == holder
    assert server.drive_lock.axes.axes[0] == 1.0


def test_stop_ends_the_thread_and_frees_the_port(scene) -> None:
    server = Server("view", port=0)
    server.start()
    names = {thread.name for thread in threading.enumerate()}
    assert "urdfkit-view" in names
    server.stop()
    server.stop()
    server.publish(0.0, POSES)  # harmless
    assert "urdfkit-view" not in {thread.name for thread in threading.enumerate()}
    again = Server("view", port=server.port)
    again.stop()


def test_a_busy_port_is_refused_before_anything_runs(server) -> None:
    with pytest.raises(UsageError, match="is in use"):
        Server("view", port=server.port)


def test_pages_are_said_goodbye_to(scene) -> None:
    import websocket

    with Server("view", port=0) as server:
        connected = websocket.create_connection(
            f"ws://127.0.0.1:{server.port}/ws",
            timeout=PATIENCE,
            origin=f"http://127.0.0.1:{server.port}",
            cookie=f"{server.access.cookie}={server.access.session}",
        )
        connected.recv()
    with contextlib.suppress(websocket.WebSocketConnectionClosedException, ConnectionError):
        while connected.recv():
            pass
    assert not connected.connected
    connected.shutdown()


def test_other_machines_are_let_in_only_when_asked_for() -> None:
    closed, opened = Server("view", port=0), Server("view", host="0.0.0.0", port=0)
    assert not closed.access.open_to_network
    assert opened.access.open_to_network
    assert all("token=" in url for url in opened.urls)
    closed.stop()
    opened.stop()
