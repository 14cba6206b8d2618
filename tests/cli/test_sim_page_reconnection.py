"""The simulation page with arms and depth cameras, and its reconnection when the server stops or restarts."""

from __future__ import annotations

import socket

import numpy as np
import pytest

from tests.cli.lab import drawn

pytest.importorskip("meshcat")
pytest.importorskip("numba")
pytestmark = pytest.mark.browser

SIZE = {"width": 800, "height": 520}


def test_an_arm_is_moved_by_its_sliders_and_a_depth_camera_gives_a_cloud(serve, visits, keep, until) -> None:
    page = visits.open(serve("sim", "teleop", "seven_dof_arm_with_rgbd").url, viewport=SIZE)
    ceiling = "urdfkit.connection.request('walls', { corners: [[-1, 0], [1, 0]], thickness: 2, height: 0.1 })"
    name = page.evaluate(ceiling)["name"]  # the camera looks up
    page.evaluate("(name) => urdfkit.connection.request('place', { name, pose: [0, 0, 2.2] })", name)
    # It is bolted down: where its base is need not be told, where its end is might.
    until(lambda: page.locator("#tip-at").is_visible())
    assert page.locator("#tip-name").inner_text() == "gripper_finger_link1"
    assert len(page.locator("#tip-at").inner_text().split(", ")) == 3
    assert not page.locator("#position, #heading, #velocity").filter(visible=True).count()
    until(lambda: page.locator("#panel-arms").is_visible())  # nothing drives: the arms come first
    page.locator(".unfold").first.click()  # it has many controllers
    until(lambda: page.locator(".real").first.inner_text().startswith("at "))
    row = page.locator(".controller li").first
    joint = row.get_attribute("data-joint")
    unit = page.locator(".controller .unit").first.inner_text()
    assert unit in ("rad", "m")
    row.locator("input.number").fill("0.4")
    row.locator("input.number").press("Enter")
    until(lambda: abs(float(row.locator(".real").inner_text().split()[1]) - 0.4) < 0.1)
    keep(page, "arms")
    assert joint
    page.evaluate("urdfkit.page.panels.open('sensors')")
    clouds = "urdfkit.sensors.shown.filter((each) => each.kinds.includes(3))"
    assert page.evaluate(f"{clouds}.length") >= 1
    assert not page.evaluate(f"{clouds}[0].on")  # a camera's cloud waits until it is asked for
    page.evaluate(f"{clouds}[0].box.click()")
    until(lambda: page.evaluate(f"{clouds}[0].on && {clouds}[0].count > 200"))
    assert page.evaluate(f"{clouds}[0].cloud.colored")
    drawn(page)
    keep(page, "cloud")
    before = page.evaluate(f"{clouds}[0].points.geometry.uuid")
    frames = page.evaluate("Number(document.body.dataset.frames)")
    until(lambda: page.evaluate("Number(document.body.dataset.frames)") > frames + 30)
    assert page.evaluate(f"{clouds}[0].points.geometry.uuid") == before  # the buffers are used again
    assert visits.problems == []


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def served(port: int, name: str):
    from urdfkit.description.urdf.robot import Box
    from urdfkit.scene import Scene, Shape
    from urdfkit.view.content.meshcat_objects import draw, link_path
    from urdfkit.view.server.server import Server

    server = Server("sim", port=port)
    shape = Shape("base/visual/0", "base", "visual", Box((0.4, 0.2, 0.1)), np.eye(4), (1.0, 0.5, 0.0, 1.0), True)
    scene = Scene(("base",), (shape,))
    server.show(name=name, nodes=[link_path("base")], draw=lambda window: draw(scene, window, server.geometries))
    server.publish(0.0, np.array([[0.0, 0, 0, 0, 0, 0, 1]]))
    server.start()
    return server


def seen(visits, url: str):
    """Open a page of a server behind which nothing runs."""
    page = visits.open(url, ready=False, viewport=SIZE)
    page.wait_for_selector("body[data-ready=true]")
    return page


def test_a_page_comes_back_when_the_server_does(visits, until, keep, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    port = free_port()
    first = served(port, "first")
    page = seen(visits, first.url)
    first.stop()
    until(lambda: page.locator("#state").inner_text() in ("urdfkit is not running", "reconnecting"))
    second = served(port, "second")
    try:
        until(lambda: page.locator("#robot-name").inner_text() == "second")
        assert page.locator("#state").inner_text() == "connected"
        assert page.evaluate("urdfkit.scene.nodes.length") == 1
    finally:
        second.stop()
    (tmp_path / "urdfkit" / f"page-{port}.json").unlink()
    third = served(port, "third")
    try:
        until(lambda: "open its new address" in page.locator("#state").inner_text())
        keep(page, "new-key")
    finally:
        third.stop()


def test_a_page_of_another_site_gets_no_websocket(visits, until, tmp_path) -> None:
    """Cross-site WebSocket hijacking: the browser has the cookie, and the other page tries to use it."""
    import http.server
    import threading

    target = served(0, "target")
    seen(visits, target.url)  # the cookie is there

    class Evil(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            body = b"<!doctype html><title>evil</title>"
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            pass

    evil = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Evil)
    threading.Thread(target=evil.serve_forever, daemon=True).start()
    try:
        page = visits.contexts[0].new_page()  # the same browser profile, another origin on the same host
        page.goto(f"http://127.0.0.1:{evil.server_port}/")
        found = page.evaluate(
            """(url) => new Promise((done) => {
              const line = new WebSocket(url);
              line.onopen = () => done("open");
              line.onerror = () => done("refused");
            })""",
            f"ws://127.0.0.1:{target.port}/ws",
        )
        assert found == "refused"
        assert target.hub.watchers == 1
    finally:
        evil.shutdown()
        evil.server_close()
        target.stop()
