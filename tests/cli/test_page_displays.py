"""Displays of topics on the page, without a simulation: shapes in the scene, options, goals, and layouts."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("meshcat")
pytest.importorskip("pinocchio")

from tests.app.simulation.displays.marker_server import MarkerServer
from tests.app.simulation.displays.test_displays import (
    MARK,
    Simulation,
    interactive_marker,
    mesh_marker,
    package_with_mesh,
)
from tests.cli.accessibility import violations
from tests.cli.lab import drawn, panel
from tests.view.conftest import show
from urdfkit.app.replay.recorded_sensors import RecordedSensors
from urdfkit.app.simulation.displays.displays import Displays
from urdfkit.app.simulation.features.plots import Plots
from urdfkit.app.simulation.features.topic_panel import TopicPanel
from urdfkit.description.urdf.robot import Box
from urdfkit.messages.vision import DETECTIONS_2D
from urdfkit.scene import Scene, Shape
from urdfkit.view.server.server import Server

pytestmark = pytest.mark.browser
STATUS = {
    "time": 1.0, "paused": False, "real_time_factor": 1.0, "factor": 1.0, "dt": 0.001, "speed": 0.0, "fixed": False,
    "pose": {"x": 0.0, "y": 0.0, "yaw": 0.0}, "tip": None, "robots": {}, "odometry": {}, "driver": None, "watchers": 1,
}  # fmt: skip
DRAWN = """(topic) => {
  const found = [];
  urdfkit.viewport.viewer.scene.traverse((object) => {
    if (object.userData.display === topic && object.geometry) found.push(object.geometry.type);
  });
  return found;
}"""

VERTEX_COLOURS = """(topic) => {
  const found = [];
  urdfkit.viewport.viewer.scene.traverse(({ userData, geometry }) => {
    const colours = userData.display === topic && geometry?.getAttribute("color");
    const colour = (i) => [0, 1, 2].map((k) => Math.round(colours.array[3 * i + k]));
    for (let i = 0; i < (colours?.count ?? 0); i += 1) found.push(colour(i));
  });
  return found;
}"""


class Shown:
    """The page of a robot that stands still, with topics."""

    def __init__(self, layout: dict[str, Any] | None = None) -> None:
        self.simulation = Simulation()
        self.server = Server("sim", port=0, settings={"layout": layout} if layout else {})
        self.features = [part(self.simulation, self.server, self._now) for part in (TopicPanel, Plots, Displays)]  # type: ignore[arg-type]
        self._takes = {name: take for part in self.features for name, take in part.takes.items()}
        self.server.requests.update({name: schema for name, (schema, _) in self._takes.items()})

    def _now(self) -> float:
        return self.simulation.t

    def open(self) -> None:
        shape = Shape("base/visual/0", "base", "visual", Box((0.4, 0.3, 0.2)), np.eye(4))
        show(self.server, Scene(("base", "laser"), (shape,)))
        self.server.publish_latched("teleop", drives=False, robots=[], moves={}, factors={}, speed=0.5, turn=1.0)
        for part in self.features:
            part.show()
        self.server.publish(0.0, self.simulation.link_poses())

    def tick(self) -> bool:
        """Advance as the loop of a simulation does."""
        self.simulation.t += 0.5
        self.server.broadcast("status", **STATUS)
        for request in self.server.inbox.take().requests:
            self.server.answer(request, **(self._takes[request.name][1](request) or {}))
        for part in self.features:
            part.tick()
        return False

    def topics(self) -> None:
        simulation = self.simulation
        simulation.transform("map", "base", 1.0, 2.0)
        poses = [{"pose": {"position": {"x": x}, "orientation": {"w": 1.0}}} for x in (0.0, 1.0, 2.0)]
        simulation.publish("/plan", "nav_msgs/msg/Path", poses=poses)
        info = {"width": 20, "height": 20, "resolution": 0.2, "origin": {"position": {"x": -1.0}}}
        data = [100 if k % 20 in (0, 19) or k < 20 or k > 379 else -1 if k % 7 == 0 else 0 for k in range(400)]
        simulation.publish("/map", "nav_msgs/msg/OccupancyGrid", info=info, data=data)
        scan = {"angle_min": -1.5, "angle_increment": 0.02, "range_max": 9.0, "ranges": [1.5] * 150}
        simulation.publish("/scan", "sensor_msgs/msg/LaserScan", "laser", **scan)
        red = {"r": 0.8, "g": 0.1, "b": 0.1, "a": 1.0}
        size = {"x": 0.3, "y": 0.3, "z": 0.3}
        place = {"position": {"x": 2.0, "y": 1.0, "z": 0.2}, "orientation": {"w": 1.0}}
        marks = [{"header": {"frame_id": "map"}, "id": k, "type": k, "scale": size, "color": red} for k in (0, 1, 2, 3)]
        marks = [
            {**mark, "pose": {**place, "position": {**place["position"], "y": 0.5 * k}}} for k, mark in enumerate(marks)
        ]
        marks.append(
            {**marks[1], "id": 9, "type": 9, "text": "kitchen", "pose": {"position": {"x": 2.0, "y": 0.5, "z": 0.6}}}
        )
        kind = "visualization_msgs/msg/MarkerArray"
        from urdfkit.messages import from_fields

        simulation.bus.publish("/marks", kind, from_fields(kind, {"markers": marks}))
        covariance = np.zeros((6, 6))
        covariance[:2, :2], covariance[5, 5] = [[0.2, 0.1], [0.1, 0.3]], 0.1
        pose = {"pose": place, "covariance": covariance.ravel().tolist()}
        simulation.publish("/pose", "geometry_msgs/msg/PoseWithCovarianceStamped", pose=pose)
        simulation.publish("/range", "sensor_msgs/msg/Range", "laser", range=1.0, field_of_view=0.4)
        fields = [{"name": name, "offset": 4 * k, "datatype": 7, "count": 1} for k, name in enumerate("xyzi")]
        data = list(np.array([[0, 0, 1, 5], [1, 0, 1, 9]], dtype="<f4").tobytes())
        size = {"point_step": 16, "width": 2, "height": 1}
        simulation.publish("/cloud", "sensor_msgs/msg/PointCloud2", fields=fields, data=data, **size)


@pytest.fixture
def shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Shown]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    made = Shown()
    with made.server:
        made.open()
        yield made


def test_topics_are_drawn_with_their_options_and_saved_as_a_layout(shown, visits, until, keep, tmp_path) -> None:
    page = visits.open(shown.server.url, ready=False, viewport={"width": 1440, "height": 900})
    shown.topics()
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    kinds = {
        "/plan": "InstancedBufferGeometry", "/map": "PlaneGeometry", "/scan": "BufferGeometry", "/marks": "BoxGeometry",
        "/pose": "SphereGeometry", "/range": "ConeGeometry", "/cloud": "BufferGeometry",
    }  # fmt: skip
    for topic, kind in kinds.items():
        until(lambda topic=topic: shown.tick() or page.locator(f"[data-display='{topic}']").is_visible())
        page.locator(f"[data-display='{topic}'] input[type=checkbox]").check()
        until(lambda topic=topic, kind=kind: shown.tick() or kind in page.evaluate(DRAWN, topic))
    assert page.evaluate(DRAWN, "/plan") == ["InstancedBufferGeometry"]  # once, at every distance
    options = {topic: page.locator(f"[data-display='{topic}'] .display-options > input") for topic in kinds}
    counts = {"/plan": 2, "/map": 0, "/scan": 2, "/marks": 0, "/pose": 2, "/range": 1, "/cloud": 2}
    assert {topic: each.count() for topic, each in options.items()} == counts  # colour and size, if they change it
    page.get_by_label("Field that colours /scan").select_option("range")
    assert not page.get_by_label("Colour of /scan").is_visible()
    page.get_by_label("Field that colours /cloud").select_option("i")
    until(lambda: shown.tick() or page.evaluate(VERTEX_COLOURS, "/cloud") == [[0, 0, 1], [1, 0, 0]])
    assert not page.get_by_label("Colour of /cloud").is_visible()
    page.get_by_label("Field that colours /cloud").select_option("one colour")
    until(lambda: shown.tick() or page.evaluate(VERTEX_COLOURS, "/cloud") == [])
    assert page.get_by_label("Colour of /cloud").is_visible()
    page.get_by_label("Decay of /scan [s]").fill("60")
    page.get_by_label("Decay of /scan [s]").press("Enter")
    until(lambda: shown.tick() or shown.topics() or len(page.evaluate(DRAWN, "/scan")) > 2)  # older points stay
    until(lambda: shown.tick() or "BufferGeometry" in page.evaluate(DRAWN, "/scan"))
    page.locator("#transforms summary").click()
    until(lambda: shown.tick() or page.locator("[data-frame=base]").is_visible())
    age = re.compile(r"^[\d.]+ s$")
    until(lambda: shown.tick() or age.match(page.locator("[data-frame=base] small").inner_text()))
    page.evaluate("urdfkit.viewport.fit(urdfkit.scene.bounds(), [-0.3, -1, 0.9], 9)")
    drawn(page)
    keep(page, "displays")
    page.get_by_role("button", name="Put Displays below the view").click()
    page.get_by_role("separator", name="Height of the panels below the view").press("ArrowUp")
    page.get_by_role("button", name="Put Displays floating").press("Enter")
    page.get_by_role("button", name="Put Displays at the left").press("ArrowDown")
    assert page.evaluate("urdfkit.layout.state.panels.places.displays.at[1]") == 76
    page.get_by_role("button", name="Put Displays at the left").press("Enter")
    page.get_by_role("button", name="Put Displays at the side").press("Enter")
    page.get_by_role("button", name="Put Displays below the view").press("Enter")

    panel(page, "camera")
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save layout").click()
    layout = json.loads(Path(saved.value.path()).read_text())
    assert {each["topic"] for each in layout["displays"]} == kinds.keys()
    assert visits.problems == []
    other = Shown(layout)
    with other.server:
        other.open()
        second = visits.open(other.server.url, ready=False)
        other.topics()
        until(lambda: other.tick() or "ConeGeometry" in second.evaluate(DRAWN, "/range"))
        assert second.locator("#panel-camera").is_visible()
        assert second.locator("#strip #panel-displays").is_visible()
        drawn(second)
        keep(second, "layout")
    visits.problems.clear()  # the browser reports the closed connection


XYZ = {"x": 0.5, "y": 0.2, "z": 1.0}
PLACE = {"position": XYZ, "orientation": {"w": 1.0}}
ARROW = ["ConeGeometry", "CylinderGeometry"]
FURTHER = {
    "nav_msgs/msg/Odometry": ({"pose": {"pose": PLACE, "covariance": [0.1] * 36}}, [*ARROW, "SphereGeometry"]),
    "nav_msgs/msg/GridCells": ({"cell_width": 0.1, "cell_height": 0.1, "cells": [XYZ]}, ["PlaneGeometry"]),
    "geometry_msgs/msg/PoseStamped": ({"pose": PLACE}, ARROW),
    "geometry_msgs/msg/PoseArray": ({"poses": [PLACE]}, ARROW),
    "geometry_msgs/msg/PointStamped": ({"point": XYZ}, ["SphereGeometry"]),
    "geometry_msgs/msg/PolygonStamped": ({"polygon": {"points": [XYZ, {"x": 1.0}, {}]}}, ["InstancedBufferGeometry"]),
    "geometry_msgs/msg/TwistStamped": ({"twist": {"linear": XYZ}}, ARROW),
    "geometry_msgs/msg/AccelStamped": ({"accel": {"linear": XYZ}}, ARROW),
    "geometry_msgs/msg/WrenchStamped": ({"wrench": {"force": XYZ}}, ARROW),
}
"""Type → fields and the geometries of its drawing."""


def test_a_cloud_is_coloured_by_its_height_in_the_world(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    shown.simulation.transform("base", "eye", turn={"y": 0.5**0.5, "w": 0.5**0.5})
    names = [{"name": name, "offset": 4 * k, "datatype": 7, "count": 1} for k, name in enumerate("xyz")]
    # x of the frame points down: the point with the largest x is the lowest, and z is the same for all.
    data = list(np.array([[0.0, 0, 1], [1, 0, 1], [2, 0, 1]], dtype="<f4").tobytes())
    values = {"fields": names, "data": data, "point_step": 12, "width": 3, "height": 1}
    send = partial(shown.simulation.publish, "/cloud", "sensor_msgs/msg/PointCloud2", "eye", **values)
    send()
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    until(lambda: shown.tick() or page.locator("[data-display='/cloud']").is_visible())
    page.locator("[data-display='/cloud'] input[type=checkbox]").check()
    colors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]  # red is high, blue is low
    until(lambda: shown.tick() or page.evaluate(VERTEX_COLOURS, "/cloud") == colors)
    page.get_by_label("Field that colours /cloud").select_option("x")
    until(lambda: shown.tick() or page.evaluate(VERTEX_COLOURS, "/cloud") == colors[::-1])
    page.get_by_label("Field that colours /cloud").select_option("height")
    until(lambda: shown.tick() or page.evaluate(VERTEX_COLOURS, "/cloud") == colors)


def test_further_types_of_messages_are_drawn(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    for kind, (fields, geometries) in FURTHER.items():
        topic = f"/{kind.split('/')[-1].lower()}"
        shown.simulation.publish(topic, kind, "base", **fields)
        until(lambda topic=topic: shown.tick() or page.locator(f"[data-display='{topic}']").is_visible())
        page.locator(f"[data-display='{topic}'] input[type=checkbox]").check()
        until(lambda topic=topic: shown.tick() or page.evaluate(DRAWN, topic))
        assert set(geometries) <= set(page.evaluate(DRAWN, topic)), kind
    assert visits.problems == []


def test_a_map_stays_until_the_next_one_is_decoded_and_arrows_have_their_thickness(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    shown.topics()
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    for topic in ("/map", "/marks"):
        until(lambda topic=topic: shown.tick() or page.locator(f"[data-display='{topic}']").is_visible())
        page.locator(f"[data-display='{topic}'] input[type=checkbox]").check()
        until(lambda topic=topic: shown.tick() or page.evaluate(DRAWN, topic))
    pictures = page.evaluate(
        """async () => {
          const display = urdfkit.page.displays.all.get("/map");
          const [{ pose, items: [{ map, size, pose: origin }] }] = display.drawn[0].content;
          const plane = () => display.drawn[0].groups[0].children[0], first = plane(), seen = [];
          display.take({ time: 9, groups: [{ pose, items: [{ map, size, pose: origin }] }] });
          while (seen.push(plane().material.map.image?.complete ?? false) < 9 && plane() === first) {
            await new Promise((done) => setTimeout(done, 200));
          }
          return [plane() !== first, ...new Set(seen)];
        }"""
    )
    assert pictures == [True, True]
    color = "urdfkit.page.displays.all.get('/map').drawn[0].groups[0].children[0].material.color.getHexString()"
    assert page.evaluate(color) == "ffffff"
    page.emulate_media(color_scheme="dark")
    until(lambda: page.evaluate(color) == "8f99a8")
    head = """() => {
      const box = new MeshCat.THREE.Box3();
      urdfkit.viewport.viewer.scene.traverse((object) => {
        const { userData, geometry } = object;
        if (userData.display === "/marks" && geometry?.type === "ConeGeometry") box.expandByObject(object);
      });
      return box.getSize(new MeshCat.THREE.Vector3()).toArray();
    }"""
    assert page.evaluate(head) == pytest.approx([0.23 * 0.3, 0.6, 0.6], abs=1e-3)  # along x, as in RViz
    assert visits.problems == []


def test_a_path_is_drawn_over_the_map(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    shown.topics()
    poses = [{"pose": {"position": {"x": x, "y": 2.0}, "orientation": {"w": 1.0}}} for x in (0.0, 2.0)]
    shown.simulation.publish("/plan", "nav_msgs/msg/Path", "map", poses=poses)
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    for topic in ("/map", "/plan"):
        until(lambda topic=topic: shown.tick() or page.locator(f"[data-display='{topic}']").is_visible())
        page.locator(f"[data-display='{topic}'] input[type=checkbox]").check()
        until(lambda topic=topic: shown.tick() or page.evaluate(DRAWN, topic))
    page.evaluate("urdfkit.viewport.fit(urdfkit.scene.bounds(), [-0.3, -1, 0.9], 3)")
    pink = """() => {
      const { viewport } = urdfkit, canvas = document.createElement("canvas");
      viewport.draw(400, 300);
      Object.assign(canvas, { width: 400, height: 300 });
      const pen = canvas.getContext("2d");
      pen.drawImage(viewport.viewer.renderer.domElement, 0, 0);
      viewport.resize();
      const { data } = pen.getImageData(0, 0, 400, 300);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += data[i] > 200 && data[i + 1] < 100 && data[i + 2] > 120;
      return count;
    }"""
    until(lambda: shown.tick() or page.evaluate(pink) > 500)  # 3 cm wide
    assert visits.problems == []


def test_values_of_the_environment_are_plotted(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    until(lambda: shown.tick() or page.locator("#open-plots").is_visible())
    values = {"Temperature.temperature": 21.5, "RelativeHumidity.relative_humidity": 0.4}
    values |= {"FluidPressure.fluid_pressure": 99800.0, "Illuminance.illuminance": 320.0}
    for name, value in values.items():
        kind, field = name.split(".")
        send = partial(shown.simulation.publish, f"/{field}", f"sensor_msgs/msg/{kind}", **{field: value})
        send()
        page.evaluate("(field) => urdfkit.plots.add(`/${field}`, field)", field)
        row = page.locator(f"[data-curve='field:/{field}:{field}'] .value")
        until(lambda row=row, send=send, value=value: send() or shown.tick() or row.inner_text() == f"{value:g}")
    assert visits.problems == []


def test_the_mesh_of_a_marker_is_drawn(shown, visits, until, keep, tmp_path: Path) -> None:
    page = visits.open(shown.server.url, ready=False)
    shown.simulation.kinematics.robot.packages = package_with_mesh(tmp_path)
    shown.simulation.publish("/props", MARK, "base", **mesh_marker(1, "package://props/cone.obj"))
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    until(lambda: shown.tick() or page.locator("[data-display='/props']").is_visible())
    page.locator("[data-display='/props'] input[type=checkbox]").check()
    size = """() => {
      const { THREE } = MeshCat, box = new THREE.Box3();
      urdfkit.viewport.viewer.scene.traverse((object) => {
        if (object.parent?.userData.display === "/props" && object.isMesh) box.expandByObject(object);
      });
      return box.isEmpty() ? [] : box.getSize(new THREE.Vector3()).toArray();
    }"""
    until(lambda: shown.tick() or page.evaluate(size) == pytest.approx([0.5, 0.5, 0.5], abs=1e-3))
    page.evaluate("urdfkit.viewport.fit(urdfkit.scene.bounds(), [-0.3, -1, 0.9], 3)")
    drawn(page)
    keep(page, "marker-mesh")
    assert visits.problems == []


def test_interactive_markers_are_dragged_clicked_and_moved_by_keys(shown, visits, until, keep) -> None:
    page = visits.open(shown.server.url, ready=False)
    simulation = shown.simulation
    simulation.transform("map", "base", 1.0, 2.0)
    server = MarkerServer(simulation.bus, "/tool")
    feedback = server.feedback
    server.insert(interactive_marker("grip", 1.8, 2.0))
    server.apply_changes()
    until(lambda: shown.tick() or page.locator("#open-displays").is_visible())
    panel(page, "displays")
    until(lambda: shown.tick() or page.locator("[data-display='/tool/update']").first.is_visible())
    page.locator("[data-display='/tool/update'] input[type=checkbox]").check()
    until(lambda: shown.tick() or page.get_by_role("button", name="Move grip").is_visible())
    page.evaluate("urdfkit.viewport.fit(urdfkit.scene.bounds(), [-0.5, -1, 0.8], 4)")
    drawn(page)
    keep(page, "interactive-markers")

    def point(x: float, y: float, z: float) -> list[float]:
        """Return the position in the window of a point from the start of the marker, 1.8 2 0.3 in the map."""
        at = """([x, y, z]) => {
          const { viewer, pane } = urdfkit.viewport, box = pane.getBoundingClientRect();
          const p = viewer.scene.localToWorld(new MeshCat.THREE.Vector3(x, y, z)).project(viewer.camera);
          return [box.left + ((p.x + 1) / 2) * box.width, box.top + ((1 - p.y) / 2) * box.height];
        }"""
        found: list[float] = page.evaluate(at, [1.8 + x, 2.0 + y, 0.3 + z])
        return found

    def drag(start: list[float], end: list[float]) -> Any:
        feedback.clear()
        page.mouse.move(*start)
        page.mouse.down()
        page.mouse.move(*end, steps=4)
        until(lambda: shown.tick() or any(each.event_type == 1 for each in feedback))
        page.mouse.up()
        until(lambda: shown.tick() or (feedback and feedback[-1].event_type == 5))
        until(lambda: shown.tick() or page.evaluate("!urdfkit.page.interactive.awaited"))
        assert [feedback[0].event_type, feedback[0].marker_name] == [4, "grip"]
        return feedback[-1]

    last = drag(point(0.55, 0, 0), point(0.85, 0, 0))
    assert (last.control_name, last.header.frame_id, last.client_id) == ("move x", "map", "urdfkit")
    assert last.pose.position.x == pytest.approx(2.1, abs=0.02)
    assert [last.pose.position.y, last.pose.position.z] == pytest.approx([2.0, 0.3], abs=1e-6)
    c = 0.5 * np.cos(np.pi / 4)
    last = drag(point(0.3 + c, c, 0), point(0.3 + c, -c, 0))
    assert last.control_name == "turn z"
    assert 2 * np.arctan2(last.pose.orientation.z, last.pose.orientation.w) == pytest.approx(-np.pi / 2, abs=0.05)
    assert last.pose.position.x == pytest.approx(2.1, abs=0.02)
    feedback.clear()
    page.mouse.click(*point(0.3, 0, 0))
    until(lambda: shown.tick() or feedback)
    assert [feedback[0].event_type, feedback[0].control_name] == [3, "press"]
    page.get_by_role("button", name="Move grip").press("Shift+ArrowUp")
    until(lambda: shown.tick() or len(feedback) == 2)
    assert feedback[1].pose.position.z == pytest.approx(0.35)
    page.get_by_role("button", name="Home").press("Enter")
    until(lambda: shown.tick() or len(feedback) == 3)
    assert [feedback[2].event_type, feedback[2].menu_entry_id] == [2, 7]
    drawn(page)
    assert violations(page) == {"light": [], "dark": []}
    keep(page, "interactive-markers-moved")

    # An echo of an earlier pose does not move the marker back, and a step that follows begins where the marker is.
    place = "urdfkit.page.displays.all.get('/tool/update').drawn.at(-1).groups.map((each) => each.children[0])"
    position = f"({place}).map((each) => each.position.toArray())[0]"
    until(lambda: shown.tick() or page.evaluate("!urdfkit.page.interactive.awaited"))
    echo = f"""() => {{
      const display = urdfkit.page.displays.all.get("/tool/update");
      const echo = structuredClone({{ groups: display.drawn.at(-1).content, time: 99 }});
      const button = document.querySelector("[data-marker=grip]"), heights = [];
      button.focus();
      for (const key of ["ArrowUp", "ArrowDown"]) {{
        button.dispatchEvent(new KeyboardEvent("keydown", {{ key, shiftKey: true, bubbles: true }}));
        display.take(echo);
        heights.push(({position})[2]);
      }}
      return heights;
    }}"""
    assert page.evaluate(echo) == pytest.approx([0.4, 0.35])
    until(lambda: shown.tick() or len(feedback) == 5)

    # Each change came back from the server; others that it makes are shown too.
    assert server.markers["grip"]["pose"]["position"]["z"] == pytest.approx(0.35)
    until(lambda: shown.tick() or page.evaluate(position)[2] == pytest.approx(0.35, abs=1e-5))
    server.keep_alive()
    server.set_pose("grip", {"position": {"x": 1.0, "y": 1.0, "z": 1.0}, "orientation": {"w": 1.0}})
    server.apply_changes()
    until(lambda: shown.tick() or page.evaluate(position) == pytest.approx([1.0, 1.0, 1.0], abs=1e-5))
    server.erase("grip")
    server.apply_changes()
    until(lambda: shown.tick() or page.evaluate(f"({place}).length") == 0)
    assert page.get_by_role("button", name="Move grip").count() == 0
    assert visits.problems == []


def test_an_image_is_enlarged_with_boxes_and_another_image_over_it(shown, visits, until, keep) -> None:
    simulation = shown.simulation
    sensors = RecordedSensors(simulation.bus, SimpleNamespace(frame_pose=lambda *_: None), shown.server, shown._now)  # type: ignore[arg-type]

    def tick() -> bool:
        pixels = np.full((300, 400, 3), 90, dtype=np.uint8)
        pixels[100:200, 150:250] = 200
        for topic, values in (("/eye/image", pixels), ("/eye/labels", np.where(pixels > 90, pixels, 0))):
            fields = {"height": 300, "width": 400, "step": 1200, "encoding": "rgb8", "data": values.ravel()}
            simulation.publish(topic, "sensor_msgs/msg/Image", "eye", **fields)
        simulation.publish("/eye/camera_info", "sensor_msgs/msg/CameraInfo", "eye", width=400, height=300)
        box = {"center": {"position": {"x": 200.0, "y": 150.0}}, "size_x": 100.0, "size_y": 100.0}
        results = [{"hypothesis": {"class_id": "crate", "score": 0.93}}]
        simulation.publish("/boxes", DETECTIONS_2D, "eye", detections=[{"results": results, "bbox": box}])
        sensors.find()
        sensors.tick(simulation.t)
        return shown.tick()

    page = visits.open(shown.server.url, ready=False)
    until(lambda: tick() or page.locator("#open-sensors").is_visible())
    if not page.locator("#sensors").is_visible():
        panel(page, "sensors")
    overlay = page.get_by_label("Overlay of /eye/image")
    until(lambda: tick() or overlay.locator("option").all_inner_texts() == ["no overlay", "/boxes", "/eye/labels"])
    overlay.select_option(label="/boxes")
    until(lambda: tick() or page.locator(".boxes rect").count() == 1)
    assert page.locator(".boxes text").text_content() == "crate 0.93"
    page.get_by_role("button", name="Enlarge /eye/image").press("Enter")
    dialog = page.get_by_role("dialog", name="Image of /eye/image")
    image = dialog.get_by_role("img", name="image of /eye/image")
    until(lambda: tick() or image.evaluate("(it) => it.width") == 400)
    frame, rect = image.bounding_box(), page.locator(".boxes rect").bounding_box()
    assert [rect["x"] - frame["x"], rect["y"] - frame["y"]] == pytest.approx(
        [frame["width"] * 0.375, frame["height"] / 3], abs=2
    )
    assert [rect["width"], rect["height"]] == pytest.approx([frame["width"] / 4, frame["height"] / 3], abs=3)
    assert violations(page) == {"light": [], "dark": []}
    keep(page, "boxes")
    overlay.select_option(label="/eye/labels")
    until(lambda: tick() or dialog.locator("canvas.over").is_visible())
    assert page.locator(".boxes rect").count() == 0
    keep(page, "labels")
    dialog.press("Escape")
    assert dialog.count() == 0
    assert page.locator("#sensors").get_by_role("img", name="image of /eye/image").is_visible()
    assert visits.problems == []


def test_a_goal_is_published_with_the_mouse_and_by_numbers(shown, visits, until) -> None:
    page = visits.open(shown.server.url, ready=False)
    shown.topics()
    goals: list[Any] = []
    shown.simulation.bus.subscribe("/goal_pose", "geometry_msgs/msg/PoseStamped", goals.append)
    until(lambda: shown.tick() or page.locator("#tool-goal").is_visible())
    page.evaluate("urdfkit.page.fit()")
    page.locator("#tool-goal").click()
    page.mouse.move(400, 400)
    page.mouse.down()
    page.mouse.move(500, 380, steps=3)
    page.mouse.up()
    until(lambda: shown.tick() or goals)
    assert goals[0].header.frame_id == "map"
    assert abs(goals[0].pose.orientation.w) < 0.9999
    panel(page, "displays")
    page.locator("#publish-pose summary").press("Enter")
    page.locator("#pose-x").fill("3")
    page.locator("#publish-goal").press("Enter")
    until(lambda: shown.tick() or len(goals) == 2)
    assert goals[1].pose.position.x == pytest.approx(3.0)
