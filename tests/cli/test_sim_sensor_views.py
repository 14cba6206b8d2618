"""Sensor views of the page: point clouds, images, and their rate on a busy machine."""

from __future__ import annotations

import io
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("meshcat")

from PIL import Image

from urdfkit.app.simulation.features.sensor_views import ENLARGED, MOST_POINTS, OPTICAL, SensorViews, picture, points
from urdfkit.description import load
from urdfkit.scene.camera_model import Lens
from urdfkit.sim import Simulator
from urdfkit.sim.plugins.sensors.cameras.camera import Imager
from urdfkit.sim.plugins.sensors.cameras.camera_optics import depth_image, image
from urdfkit.sim.plugins.sensors.cameras.depth_points import points as depth_points
from urdfkit.sim.plugins.sensors.cloud_messages import GZ, cloud, old_cloud
from urdfkit.view.protocol import websocket_messages
from urdfkit.view.protocol.websocket_messages import COLORED, PICTURE, POINTS

LASER = str(
    Path(__file__).parents[2]
    / "robots/diff_wheeled_robot/diff_wheeled_robot_description/urdf/diff_wheeled_robot_with_laser.urdf.xacro"
)
HEARD = """async () => {
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  await urdfkit.connection.request("form", { topic: "/scan", type: "sensor_msgs/LaserScan" });
}"""
"""Wait until what the page wants, which it says before a picture, is heard: words come in order, and so do answers."""
MOVED = np.array([[0.0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]])


class Page:
    """A server that keeps what it is told."""

    def __init__(self) -> None:
        self.hub = SimpleNamespace(accepts=lambda key: key in self.wanted, subscribed_keys=frozenset())
        self.wanted: set[str] = set()
        self.sensed: list[tuple[int, float, int, bytes]] = []
        self.declared: list[dict[str, Any]] = []

    def publish_latched(self, type: str, **values: Any) -> None:
        self.declared.append({"type": type, **values})
        self.wanted = {f"sensor:{each['topic']}" for each in values.get("sensors", ())}

    def sense(self, key: str, *content: Any) -> None:
        assert key in self.wanted
        self.sensed.append(content)


def xyz(packed: bytes) -> np.ndarray:
    return np.frombuffer(packed, "<f4").reshape(-1, 3)


def test_points_are_where_the_sensor_saw_them() -> None:
    scan = SimpleNamespace(ranges=np.array([2.0, np.inf, 3.0]), angle_min=0.0, angle_increment=np.pi / 4)
    seen = [[10.0, 22.0, 30.0], [7.0, 20.0, 30.0]]
    assert xyz(points(scan, MOVED)) == pytest.approx(np.array(seen), abs=1e-5)
    own = np.array([[2.0, 0, 0], [0, 3.0, 0], [np.nan, 0, 0]])
    columns = {name: own[:, i] for i, name in enumerate("xyz")}
    assert xyz(points(cloud(0.0, "f", GZ, columns, width=3), MOVED)) == pytest.approx(np.array(seen), abs=1e-5)
    old = old_cloud(0.0, "f", own[:2], np.zeros(2))
    assert xyz(points(old, MOVED)) == pytest.approx(np.array(seen), abs=1e-5)
    many = SimpleNamespace(ranges=np.ones(50_001), angle_min=0.0, angle_increment=1e-4)
    assert MOST_POINTS / 2 < len(xyz(points(many, np.eye(4)))) <= MOST_POINTS


def test_pictures_are_small_jpegs() -> None:
    rgb = np.full((400, 800, 3), (10, 200, 30), dtype=np.uint8)
    with Image.open(io.BytesIO(picture(image(0.0, "eye", rgb, "rgb8")))) as found:
        assert (found.format, found.size, found.mode) == ("JPEG", (320, 160), "RGB")
        assert np.asarray(found).mean(axis=(0, 1)) == pytest.approx((10, 200, 30), abs=4)
    depth = np.full((20, 30), 2.0, dtype=np.float32)
    depth[:, 15:], depth[:5] = 4.0, np.nan
    with Image.open(io.BytesIO(picture(depth_image(0.0, "eye", depth, millimetres=False)))) as found:
        grey = np.asarray(found).astype(int)
        assert grey.shape == (20, 30)
        assert grey[15, 5] > grey[15, 25] > grey[1, 5]


@pytest.fixture
def shown():
    now = [0.0]
    page = Page()
    simulator = Simulator(load(LASER), world="cylinders", note=lambda _: None)
    views = SensorViews(simulator, page, lambda: now[0])  # type: ignore[arg-type]
    assert views.find()
    return simulator, page, views, now


def test_the_page_receives_the_points_of_the_laser_scan(shown) -> None:
    simulator, page, views, _ = shown
    assert page.declared == [{"type": "sensors", "sensors": [{"topic": "/scan", "picture": False, "camera": False}]}]
    simulator.run(0.1)
    views.show()
    ((index, t, kind, content),) = page.sensed
    assert (index, t, kind) == (0, pytest.approx(0.1), POINTS)
    found = xyz(content)
    assert len(found) > 50
    where = np.array([pose[:2] for pose in simulator.world.body_poses().values()])
    off = np.linalg.norm(found[:, None, :2] - where, axis=-1).min(axis=1)
    assert off.std() < 1e-4  # all as far from the axis of a cylinder as its radius


def test_a_sensor_without_a_subscribed_page_is_not_rendered(shown) -> None:
    simulator, page, views, _ = shown
    page.wanted.clear()
    simulator.run(0.1)
    assert views.show() == 0.0
    assert not page.sensed
    assert not simulator.surroundings.is_used


def test_a_sensor_view_is_updated_at_most_ten_times_a_second(shown) -> None:
    simulator, page, views, now = shown
    for _ in range(100):
        simulator.run(0.01)
        views.show()
        now[0] += 0.01
    assert 9 <= len(page.sensed) <= 11


def test_all_topics_of_one_camera_share_one_small_rendered_image(monkeypatch: pytest.MonkeyPatch) -> None:
    page, widths = Page(), []
    simulator = Simulator("seven_dof_arm_with_rgbd", note=lambda _: None)
    views = SensorViews(simulator, page, lambda: 0.0)  # type: ignore[arg-type]
    assert views.find()
    names = [each["topic"] for each in page.declared[0]["sensors"]]
    capture = Imager.capture
    monkeypatch.setattr(
        Imager, "capture", lambda self, *g, **k: widths.append(self.optics.lens.width) or capture(self, *g, **k)
    )
    simulator.run(0.2)
    views.show()
    assert [names[index] for index, *_ in page.sensed] == names[:3]
    assert [kind for _, _, kind, _ in page.sensed] == [PICTURE, PICTURE, COLORED]
    assert widths == [320]
    for *_, jpeg in page.sensed[:2]:
        with Image.open(io.BytesIO(jpeg)) as found:
            assert found.size == (320, 240)
    page.hub.subscribed_keys = frozenset({f"{ENLARGED}{names[0]}"})  # until the page reduces it again
    simulator.run(0.2)
    views._free = float("-inf")
    for view in views._views:
        view.due = 0.0
    views.show()
    assert widths == [320, 800]
    with Image.open(io.BytesIO(page.sensed[3][3])) as found:
        assert found.size == (800, 600)
    whole = simulator.bus.latest(names[0])
    assert (whole.width, whole.height) == (800, 600)  # who subscribes gets it as it is written


def test_a_cloud_of_a_depth_camera_has_the_colours_and_positions_of_the_bodies() -> None:
    lens = Lens(4, 3, 1.0)
    rgb = np.zeros((3, 4, 3), dtype=np.uint8)
    rgb[:, :2], rgb[:, 2:] = (200, 10, 30), (5, 6, 250)
    depth = np.full((3, 4), 2.0, dtype=np.float32)
    depth[0, 0] = np.nan
    message = depth_points(0.0, "optical", lens, depth, rgb)
    found = points(message, MOVED @ OPTICAL, colored=True)
    rows = np.frombuffer(found, "<f4").reshape(-1, 4)
    assert len(rows) == 11
    assert rows[:, 1] == pytest.approx(22.0)  # two metres ahead, which is along y
    colors = np.frombuffer(found, np.uint8).reshape(-1, 16)[:, 12:]
    left = rows[:, 0] < 10.0  # looking along y, left is where x is small
    assert (colors[left] == (200, 10, 30, 255)).all()
    assert (colors[~left] == (5, 6, 250, 255)).all()


def test_the_colours_of_a_segmentation_are_not_blurred() -> None:
    rng = np.random.default_rng(0)
    rgb = rng.integers(0, 255, (60, 80, 3)).astype(np.uint8)
    with Image.open(io.BytesIO(picture(image(0.0, "eye", rgb, "rgb8"), exact=True))) as found:
        assert found.format == "WEBP"
        assert (np.asarray(found.convert("RGB")) == rgb).all()


def test_frames_have_sensor_kind_and_time() -> None:
    frame = websocket_messages.pack_sensed(3, 1.5, PICTURE, b"jpeg")
    assert websocket_messages.POSE_HEADER.unpack(frame[:16]) == (0x02, 1, 3, 0, 1.5)
    assert frame[16:] == b"jpeg"


@pytest.mark.browser
def test_the_page_shows_points_and_pictures(serve_for_all, visits, keep, until) -> None:
    server = serve_for_all("sim", "teleop", LASER, "--world", "cylinders")
    page = visits.open(server.url, viewport={"width": 1100, "height": 700})
    page.wait_for_selector("#progress", state="hidden")
    until(lambda: page.evaluate("urdfkit.sensors.shown[0]?.count ?? 0") > 50)
    keep(page, "scan")
    page.get_by_label("/scan").first.click()
    assert not page.evaluate("urdfkit.sensors.shown[0].points.visible")
    until(lambda: not page.evaluate("urdfkit.connection.subscriptions.size"))
    page.evaluate(HEARD)
    page.evaluate("urdfkit.sensors.frames = 0, urdfkit.page.on('sensed', () => (urdfkit.sensors.frames += 1))")
    now = page.evaluate("urdfkit.page.status.time")
    until(lambda: page.evaluate("urdfkit.page.status.time") > now + 0.5)
    assert page.evaluate("urdfkit.sensors.frames") == 0
    page.get_by_label("/scan").first.click()
    until(lambda: page.evaluate("urdfkit.sensors.frames") > 2)
    # The first scan of all may have met nothing.
    taken = """() => {
      const cloud = new urdfkit.sensors.shown[0].cloud.constructor(urdfkit.page.viewport, 0xff0000);
      cloud.take(new ArrayBuffer(16), 16, false);
      return cloud.count;
    }"""
    assert page.evaluate(taken) == 0
    assert visits.problems == []


@pytest.mark.browser
def test_the_page_shows_what_the_camera_sees(serve_for_all, visits, keep, until) -> None:
    server = serve_for_all("sim", "teleop", "simpleton", "--world", "house")
    page = visits.open(server.url, viewport={"width": 1100, "height": 700})
    page.wait_for_selector("#progress", state="hidden")
    until(lambda: page.evaluate("urdfkit.sensors.shown[0]?.image?.width ?? 0") == 320)
    keep(page, "camera")
    # A URL for each image would keep the memory of many of them.
    page.evaluate(
        """() => {
          Object.assign(window, { images: 0, urls: 0 });
          urdfkit.page.on("picture", () => (window.images += 1));
          URL.createObjectURL = () => `about:${(window.urls += 1)}`;
        }"""
    )
    until(lambda: page.evaluate("window.images") > 3)
    assert page.evaluate("window.urls") == 0
    assert visits.problems == []


LABELLED = """<?xml version="1.0"?><sdf version="1.9"><world name="labelled">
  <light type="directional" name="sun"><direction>-0.5 0.1 -0.9</direction></light>
  {posts}
</world></sdf>"""
POST = """<model name="post{label}"><static>true</static><pose>2 {y} 0.5 0 0 0</pose>
  <plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{label}</label></plugin>
  <link name="l"><visual name="v"><geometry><box><size>0.2 0.4 1</size></box></geometry></visual></link></model>"""
SEGMENTING = """<robot name="seer"><link name="world"/><link name="eye"/>
  <joint name="mount" type="fixed"><parent link="world"/><child link="eye"/><origin xyz="0 0 0.5"/></joint>
  <gazebo reference="eye"><sensor name="labels" type="segmentation"><topic>labels</topic>
    <update_rate>10</update_rate><camera><horizontal_fov>1.2</horizontal_fov>
    <segmentation_type>semantic</segmentation_type><image><width>160</width><height>120</height></image>
    <clip><near>0.1</near><far>20</far></clip></camera></sensor></gazebo></robot>"""
COLORS = """() => {
  const image = urdfkit.sensors.shown[0]?.image;
  if (!image || image.width === 1) return [];
  const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0);
  const data = new Uint32Array(pen.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  return [...new Set(data)];
}"""


@pytest.mark.browser
def test_the_page_shows_labels_in_colours_that_are_not_mixed(serve, visits, keep, until, tmp_path: Path) -> None:
    robot, world = tmp_path / "seer.urdf", tmp_path / "labelled.sdf"
    robot.write_text(SEGMENTING)
    world.write_text(
        LABELLED.format(posts="".join(POST.format(label=label, y=y) for label, y in ((7, 0.5), (9, -0.5))))
    )
    page = visits.open(
        serve("sim", "teleop", str(robot), "--world", str(world)).url, viewport={"width": 1000, "height": 640}
    )
    until(lambda: len(page.evaluate(COLORS)) == 3)  # two labels, and what has none
    keep(page, "labels")
    assert visits.problems == []
