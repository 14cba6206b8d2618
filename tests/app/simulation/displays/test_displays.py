"""Drawings of messages in the frames of their headers, without a simulation."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("meshcat")
pytest.importorskip("pinocchio")

from tests.app.simulation.displays.marker_server import MarkerServer
from urdfkit.app.simulation.displays.displays import DISPLAY, FRAMES, TYPES, Displays
from urdfkit.app.simulation.displays.drawings import drawing
from urdfkit.bus import Bus
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields
from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.protocol.page_requests import Request

MARK = "visualization_msgs/msg/Marker"
INTERACTIVE = "visualization_msgs/msg/InteractiveMarker"
TURNED = {"x": 0.0, "y": 0.0, "z": np.sin(np.pi / 4), "w": np.cos(np.pi / 4)}
"""90° about z."""


def package_with_mesh(folder: Path) -> Packages:
    """Write a package ``props`` with a tetrahedron, and one outside of it; return a resolver that finds the package."""
    (folder / "props").mkdir()
    (folder / "props/package.xml").write_text("<package><name>props</name></package>")
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["f 1 3 2", "f 1 2 4", "f 2 3 4", "f 3 1 4"]
    for path in (folder / "props/cone.obj", folder / "outside.obj"):
        path.write_text("\n".join(lines))
    return Packages([folder])


def mesh_marker(id: int, uri: str) -> dict[str, Any]:
    """Return the fields of a red marker with a mesh."""
    half = {"x": 0.5, "y": 0.5, "z": 0.5}
    return {"id": id, "type": 10, "mesh_resource": uri, "scale": half, "color": {"r": 1.0, "a": 1.0}}


def interactive_marker(name: str, x: float = 0.5, y: float = 0.0) -> dict[str, Any]:
    """Return the fields of an interactive marker in the frame of the map with a handle along each axis and a button."""
    half = np.sqrt(0.5)
    turns = {"x": {"w": 1.0}, "y": {"z": half, "w": half}, "z": {"y": -half, "w": half}}
    box = {"type": 1, "scale": {"x": 0.2, "y": 0.2, "z": 0.2}, "color": {"r": 0.9, "g": 0.6, "a": 1.0}}
    controls: list[dict[str, Any]] = [
        {"name": "press", "interaction_mode": 2, "always_visible": True, "markers": [box]}
    ]
    for axis, turn in turns.items():
        controls.append({"name": f"move {axis}", "orientation": turn, "interaction_mode": 3})
        controls.append({"name": f"turn {axis}", "orientation": turn, "interaction_mode": 5})
    pose = {"position": {"x": x, "y": y, "z": 0.3}, "orientation": {"w": 1.0}}
    marker = {"header": {"frame_id": "map"}, "name": name, "pose": pose, "scale": 1.0, "controls": controls}
    return {**marker, "menu_entries": [{"id": 7, "title": "Home"}]}


class Simulation:
    """What displays need of a simulation: a bus, the time, and the poses of the links."""

    def __init__(self) -> None:
        self.bus, self.t = Bus(), 0.0
        self.kinematics = SimpleNamespace(link_names=("base", "laser"), robot=SimpleNamespace(packages=None))

    def link_poses(self) -> np.ndarray:
        return np.array([[1.0, 2.0, 0.0, 0, 0, 0, 1], [1.0, 2.0, 0.5, 0, 0, 0, 1]])

    def publish(self, topic: str, kind: str, frame: str = "map", **fields: Any) -> None:
        self.bus.publish(topic, kind, from_fields(kind, {"header": {"frame_id": frame}, **fields}))

    def transform(self, parent: str, child: str, x: float = 0.0, y: float = 0.0, turn: Any = None) -> None:
        each = {"header": {"frame_id": parent}, "child_frame_id": child}
        each["transform"] = {"translation": {"x": x, "y": y, "z": 0.0}, "rotation": turn or {"w": 1.0}}
        kind = "tf2_msgs/msg/TFMessage"
        self.bus.publish("/tf", kind, from_fields(kind, {"transforms": [each]}))


class Page:
    def __init__(self) -> None:
        self.readers = frozenset({1})
        self.hub = SimpleNamespace(subscribed_keys=set(), subscribers=lambda key: self.readers)
        self.geometries = GeometryStore()
        self.sent: list[tuple[str, dict[str, Any]]] = []

    def send_to_subscribers(self, key: str, type: str, **values: Any) -> None:
        json.dumps(values, allow_nan=False)
        self.sent.append((type, values))

    publish_latched = send_to_subscribers


@pytest.fixture
def made() -> tuple[Simulation, Page, Displays]:
    simulation, page = Simulation(), Page()
    simulation.bus.advertise("/tf", "tf2_msgs/msg/TFMessage")
    return simulation, page, Displays(simulation, page, lambda: simulation.t)  # type: ignore[arg-type]


def shown(made: tuple[Simulation, Page, Displays], topic: str, field: str = "") -> dict[str, Any]:
    """Return the newest drawing of a topic."""
    simulation, page, displays = made
    page.hub.subscribed_keys.add(f"{DISPLAY}{topic}{f':{field}' if field else ''}")
    simulation.t += 10.0
    displays.tick()
    return next(values for type, values in reversed(page.sent) if type == "display")


def test_a_path_is_drawn_in_its_frame_which_transforms_connect_with_the_robot(made) -> None:
    simulation, page, _ = made
    poses = [{"pose": {"position": {"x": x, "y": 0.0, "z": 0.0}}} for x in (0.0, 1.0)]
    simulation.publish("/plan", "nav_msgs/msg/Path", poses=poses)
    lost = shown(made, "/plan")
    assert lost["groups"] == []
    assert "no transform from frame map" in lost["fault"]
    simulation.transform("map", "odom", 5.0, 0.0, TURNED)
    simulation.transform("odom", "base", 1.0, 0.0)
    (group,) = shown(made, "/plan")["groups"]  # of the message that came before the transforms
    # base is at (1, 2): odom at (0, 2), and map, in which odom is at (5, 0) and turned by 90°, at (0, 2) + (0, 5).
    assert group["pose"][:3] == pytest.approx([0.0, 7.0, 0.0])
    assert group["pose"][3:] == pytest.approx([0, 0, -TURNED["z"], TURNED["w"]])
    assert group["items"] == [{"line": [0.0, 0, 0, 1, 0, 0]}]
    simulation.transform("map", "odom", 6.0, 0.0, TURNED)  # a corrected localization moves the drawing
    assert shown(made, "/plan")["poses"][0][:3] == pytest.approx([0.0, 8.0, 0.0])
    page.readers = frozenset({1, 2})  # another page
    assert shown(made, "/plan")["groups"][0]["items"] == group["items"]


def test_a_covariance_is_the_ellipsoid_of_one_standard_deviation() -> None:
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = np.diag([0.04, 0.25, 0.01])
    matrix[5, 5] = 0.09
    pose = {"pose": {"position": {"x": 1.0}, "orientation": {"w": 2.0}}, "covariance": matrix.ravel().tolist()}
    kind = "nav_msgs/msg/Odometry"
    arrow, ellipsoid, sector = drawing(from_fields(kind, {"pose": pose}), kind)
    assert arrow["arrow"] == [1.0, 0, 0, 0, 0, 0, 1]
    assert sorted(ellipsoid["axes"]) == pytest.approx([0.1, 0.2, 0.5])
    assert sector["angle"] == pytest.approx(0.3)


def test_a_map_is_a_picture_of_its_cells() -> None:
    from PIL import Image

    kind = "nav_msgs/msg/OccupancyGrid"
    info = {"width": 2, "height": 1, "resolution": 0.5, "origin": {"orientation": {"w": 1.0}}}
    (item,) = drawing(from_fields(kind, {"info": info, "data": [100, -1]}), kind)
    pixels = np.asarray(Image.open(io.BytesIO(base64.b64decode(item["map"]))))
    assert pixels[0, 0].tolist() == [24, 28, 34, 255]
    assert pixels[0, 1, 3] < 200
    assert item["size"] == [1.0, 0.5]


def test_a_message_that_contradicts_itself_is_a_line_on_the_page(made) -> None:
    simulation, _, _ = made
    info = {"width": 3, "height": 2, "resolution": 1.0}
    simulation.publish("/map", "nav_msgs/msg/OccupancyGrid", "base", info=info, data=[0])
    assert "cannot be drawn" in shown(made, "/map")["fault"]


def test_points_have_the_values_of_the_field() -> None:
    kind = "sensor_msgs/msg/LaserScan"
    scan = {
        "angle_min": 0.0, "angle_increment": np.pi / 2, "range_min": 0.1, "range_max": 10.0,
        "ranges": [1.0, np.inf, 2.0], "intensities": [7.0, 8.0, 9.0],
    }  # fmt: skip
    (item,) = drawing(from_fields(kind, scan), kind, "intensity")
    xyz = np.frombuffer(base64.b64decode(item["points"]), "<f4").reshape(-1, 3)
    assert xyz == pytest.approx(np.array([[1, 0, 0], [-2, 0, 0]]), abs=1e-6)
    assert np.frombuffer(base64.b64decode(item["values"]), "<f4").tolist() == [7.0, 9.0]
    assert item["fields"] == ["range", "intensity"]
    kind = "sensor_msgs/msg/PointCloud2"
    fields = [{"name": name, "offset": 4 * k, "datatype": 7, "count": 1} for k, name in enumerate(("x", "y", "z", "t"))]
    data = np.array([[1, 2, 3, 50], [np.nan, 0, 0, 60]], "<f4").view(np.uint8).ravel().tolist()
    cloud = from_fields(kind, {"fields": fields, "point_step": 16, "width": 2, "height": 1, "data": data})
    (item,) = drawing(cloud, kind, "t")
    assert item["count"] == 1
    assert item["range"] == [50.0, 50.0]


def test_markers_stay_until_they_are_deleted_or_their_lifetime_ends(made) -> None:
    simulation, _, _ = made
    kind = "visualization_msgs/msg/Marker"

    def put(id: int, **fields: Any) -> None:
        simulation.publish("/marks", kind, "laser", id=id, color={"r": 1.0, "a": 1.0}, **fields)

    simulation.bus.advertise("/marks", kind)
    made[1].hub.subscribed_keys.add(f"{DISPLAY}/marks")
    made[2].tick()
    put(1, type=1, scale={"x": 1.0, "y": 1.0, "z": 1.0}, pose={"orientation": {"w": 1.0}})
    put(2, type=9, text="door", scale={"z": 0.3}, lifetime={"sec": 15, "nanosec": 0})
    put(3, type=4, points=[{"x": 0.0}, {"x": 1.0}])
    groups = shown(made, "/marks")["groups"]
    assert [next(iter(group["items"][0])) for group in groups] == ["shape", "text", "line"]
    assert groups[0]["pose"][:3] == [1.0, 2.0, 0.5]
    put(1, action=2)
    assert len(shown(made, "/marks")["groups"]) == 1  # and 20 s later the text has ended


def test_a_marker_has_a_mesh_of_a_package_and_no_other_file(made, tmp_path: Path) -> None:
    simulation, page, _ = made
    simulation.kinematics.robot.packages = package_with_mesh(tmp_path)
    simulation.publish("/marks", MARK, "laser", **mesh_marker(1, "package://props/cone.obj"))
    (group,) = shown(made, "/marks")["groups"]
    (item,) = group["items"]
    assert [item["scale"], item["color"], item["own"]] == [[0.5] * 3, [1.0, 0.0, 0.0, 1.0], False]
    page.geometries.keep_only([])  # as when another entity is drawn
    assert page.geometries.get(item["mesh"]) is not None
    for uri, words in (
        (f"file://{tmp_path}/outside.obj", "is not a file of a package"),
        ("package://props/../outside.obj", "is outside its package"),
        ("package://prop/cone.obj", "no package `prop`"),
        ("package://props/package.xml", "unsupported format"),
    ):
        simulation.publish("/marks", MARK, "laser", **mesh_marker(2, uri))
        sent = shown(made, "/marks")
        assert len([each for group in sent["groups"] for each in group["items"]]) == 1
        assert words in sent["fault"]
    simulation.publish("/marks", MARK, "laser", id=2, action=2)
    assert shown(made, "/marks")["fault"] is None
    assert len(page.geometries) == 1


def test_interactive_markers_are_kept_as_their_server_sends_them(made) -> None:
    simulation, _, _ = made
    simulation.transform("map", "base", 1.0, 2.0)
    server = MarkerServer(simulation.bus, "/tool")

    def markers() -> dict[str, Any]:
        return {each["items"][0]["name"]: each["items"][0] for each in shown(made, "/tool/update")["groups"]}

    server.insert(interactive_marker("a"))
    server.insert(interactive_marker("b", 1.5))
    server.apply_changes()
    server.keep_alive()
    first = markers()
    assert [each["mode"] for each in first["a"]["controls"]] == [2, 3, 5, 3, 5, 3, 5]
    assert first["a"]["controls"][0]["items"][0]["shape"] == "cube"
    assert (first["b"]["pose"][:3], first["b"]["frame"], first["b"]["menu"]) == ([1.5, 0.0, 0.3], "map", [[7, "Home"]])
    server.erase("a")
    server.set_pose("b", {"position": {"y": 2.0}, "orientation": {"w": 1.0}}, "base")
    server.insert(interactive_marker("c"))
    server.apply_changes()
    server.keep_alive()
    after = markers()
    assert after.keys() == {"b", "c"}
    assert (after["b"]["pose"], after["b"]["frame"]) == ([0.0, 2.0, 0.0, 0, 0, 0, 1], "base")
    again = MarkerServer(simulation.bus, "/tool")  # the node has started again
    assert markers() == {}
    again.insert(interactive_marker("d"))
    again.apply_changes()
    assert markers().keys() == {"d"}


def test_all_interactive_markers_of_ros_2_are_requested_at_first_and_after_a_loss(made) -> None:
    simulation, _, displays = made
    simulation.transform("map", "base", 1.0, 2.0)
    server = MarkerServer(simulation.bus, "/arm", is_ros1=False)
    asked: list[Any] = []
    displays.request_markers = lambda topic, take: asked.append((topic, take))

    def positions() -> dict[str, float]:
        items = (each["items"][0] for each in shown(made, "/arm/update")["groups"])
        return {item["name"]: item["pose"][0] for item in items}

    def pose(x: float) -> dict[str, Any]:
        return {"position": {"x": x}, "orientation": {"w": 1.0}}

    server.insert(interactive_marker("a", 1.0))
    server.insert(interactive_marker("b", 2.0))
    server.apply_changes()
    server.keep_alive()
    shown(made, "/arm/update")
    ((topic, take),) = asked
    assert topic == "/arm/update"
    response = server.response()  # on its way while the next updates arrive
    server.set_pose("a", pose(3.0))
    server.apply_changes()
    server.erase("b")
    server.apply_changes()
    take(response)
    assert positions() == {"a": 3.0}
    server.keep_alive()
    server.insert(interactive_marker("c", 4.0))
    server.apply_changes(lost=True)
    server.set_pose("a", pose(5.0))
    server.apply_changes()
    assert positions() == {"a": 5.0}
    assert len(asked) == 2
    asked[1][1](server.response())
    assert positions() == {"a": 5.0, "c": 4.0}
    server.erase("c")
    server.apply_changes(lost=True)
    server.keep_alive()
    shown(made, "/arm/update")
    asked[2][1](server.response())
    assert positions() == {"a": 5.0}
    assert len(asked) == 3


def test_frames_have_their_ages(made) -> None:
    simulation, page, displays = made
    page.hub.subscribed_keys.add(FRAMES)
    simulation.t = 1.0
    displays.tick()
    simulation.transform("odom", "base")
    simulation.t = 3.0
    displays.tick()
    assert page.sent[-1][1]["rows"] == [{"name": "base", "parent": "odom", "age": 2.0, "static": False}]


def test_a_goal_is_published_in_the_frame_of_the_map(made) -> None:
    simulation, _, displays = made
    _, publish = displays.takes["publish_pose"]
    goals: list[Any] = []
    simulation.bus.subscribe("/goal_pose", "geometry_msgs/msg/PoseStamped", goals.append)
    values = {"as": "goal", "position": [1.0, 3.0], "yaw": 0.5}
    assert publish(Request(1, 1, "publish_pose", values)) == {"topic": "/goal_pose", "frame": "world"}
    simulation.transform("map", "base", 10.0, 0.0)
    assert publish(Request(1, 1, "publish_pose", values)) == {"topic": "/goal_pose", "frame": "map"}
    pose = goals[-1].pose
    assert [pose.position.x, pose.position.y] == pytest.approx([10.0, 1.0])
    assert pose.orientation.z == pytest.approx(np.sin(0.25))
    simulation.bus.advertise("/initialpose", "std_msgs/msg/String")
    with pytest.raises(UsageError, match="PoseWithCovarianceStamped"):
        publish(Request(1, 1, "publish_pose", {**values, "as": "estimate"}))


@pytest.mark.parametrize("kind", [each for each in TYPES if "Marker" not in each])
def test_an_empty_message_of_every_type_has_a_drawing(kind: str) -> None:
    json.dumps(drawing(from_fields(kind, None), kind), allow_nan=False)
