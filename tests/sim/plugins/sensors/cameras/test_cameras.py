"""Cameras: topics, encodings, intrinsics, depths and points as each plugin has them."""

from __future__ import annotations

import re
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import ROBOTS, heard, noise, sensor, wall
from tests.sim.plugins.sensors.test_cloud_messages import layout, rows
from tests.suggestions import contains
from urdfkit.description import load
from urdfkit.description.lfs_pointer import LFS, POINTER
from urdfkit.errors import ResourceError
from urdfkit.sim import Simulator

ROOM = wall("east", 3.05, 0, 0.1, 500, role="visual") + wall("north", 0, 2.05, 500, 0.1, role="visual")


def camera(width=64, height=48, fov=1.2, form="R8G8B8", more="", near=0.05, far=50.0) -> str:
    return (
        f"<camera><horizontal_fov>{fov}</horizontal_fov><image><width>{width}</width><height>{height}</height>"
        f"<format>{form}</format></image><clip><near>{near}</near><far>{far}</far></clip>{more}</camera>"
    )


def ros1(file: str = "camera", more: str = "") -> str:
    return (
        f'<plugin name="c" filename="libgazebo_ros_{file}.so"><cameraName>cam</cameraName>'
        f"<frameName>optical</frameName>{more}</plugin>"
    )


def eye(plugin: str = "", type: str = "camera", inside: str | None = None, more: str = "") -> str:
    return sensor(plugin, inside=camera() if inside is None else inside, type=type, more=more)


def pixels(message) -> np.ndarray:
    kind = {"32FC1": "<f4", "16UC1": "<u2", "mono16": "<u2", "rgb16": "<u2"}.get(message.encoding, "u1")
    found = np.frombuffer(message.data.tobytes(), kind).reshape(message.height, message.width, -1)
    assert message.step == len(message.data) // message.height
    return found[..., 0] if found.shape[-1] == 1 else found


def test_a_camera_of_ros_1(post) -> None:
    simulator = post(eye(ros1()), room=ROOM)
    (picture,) = heard(simulator, "/cam/image_raw")
    assert (picture.width, picture.height, picture.encoding, picture.step) == (64, 48, "rgb8", 192)
    assert picture.header.frame_id == "optical"
    (info,) = heard(simulator, "/cam/camera_info")
    f = 64 / (2 * np.tan(0.6))
    assert info.k.reshape(3, 3) == pytest.approx(np.array([[f, 0, 32.5], [0, f, 24.5], [0, 0, 1]]))
    assert info.p.reshape(3, 4) == pytest.approx(np.column_stack([info.k.reshape(3, 3), np.zeros(3)]))
    assert info.r.reshape(3, 3).tolist() == np.eye(3).tolist()
    assert (info.width, info.height, info.distortion_model, info.header.frame_id) == (64, 48, "plumb_bob", "optical")
    assert info.d.tolist() == [0.0] * 5
    region = info.roi
    not_used = (info.binning_x, info.binning_y, region.x_offset, region.y_offset, region.height, region.width)
    assert (*not_used, region.do_rectify) == (0, 0, 0, 0, 0, 0, False)


def test_what_is_written_about_intrinsics_is_reported(post) -> None:
    more = "<focalLength>50</focalLength><Cx>30</Cx><Cy>20</Cy><hackBaseline>0.07</hackBaseline>"
    more += "<distortionK1>-0.1</distortionK1>"
    (info,) = heard(post(eye(ros1(more=more)), room=ROOM), "/cam/camera_info")
    assert info.k.tolist() == [50, 0, 30, 0, 50, 20, 0, 0, 1]
    assert info.p[3] == pytest.approx(-3.5)
    assert info.d.tolist() == [-0.1, 0, 0, 0, 0]


def test_nobody_looks_for_camera_info(post) -> None:
    simulator = post(eye(ros1()), room=ROOM)
    heard(simulator, "/cam/camera_info", 0.5)
    assert not simulator.surroundings.is_used


@pytest.mark.parametrize("form", ["L8", "L16", "R16G16B16", "B8G8R8", "BAYER_RGGB8", "BAYER_GRBG8"])
def test_formats_hold_the_same_picture(post, form: str) -> None:
    room = ROOM.replace("</geometry>", "</geometry><material><diffuse>1 0.5 0.25 1</diffuse></material>")
    (colored,) = heard(post(eye(ros1()), room=room), "/cam/image_raw")
    (other,) = heard(post(eye(ros1(), inside=camera(form=form)), room=room), "/cam/image_raw")
    rgb, found = pixels(colored), pixels(other)
    if form == "B8G8R8":
        assert other.encoding == "bgr8"
        assert np.array_equal(found[..., ::-1], rgb)
    elif form.endswith("16"):
        assert other.encoding == {"L16": "mono16", "R16G16B16": "rgb16"}[form]
        grey = rgb if form == "R16G16B16" else rgb @ (0.299, 0.587, 0.114)
        assert np.abs(found / 257.0 - grey).max() <= 0.002
    elif form == "L8":
        assert other.encoding == "mono8"
        assert np.abs(found - rgb @ (0.299, 0.587, 0.114)).max() <= 0.51
    else:
        order = form[6:10]
        for k, color in enumerate(order):
            assert np.array_equal(found[k // 2 :: 2, k % 2 :: 2], rgb[k // 2 :: 2, k % 2 :: 2, "RGB".index(color)])
        assert other.encoding == f"bayer_{order.lower()}8"


def depths(width=64, height=48, fov=1.2):
    """Return how deep the walls of `ROOM` are in a camera that looks along x."""
    f = width / (2 * np.tan(fov / 2))
    left = np.tile(((width - 1) / 2 - np.arange(width)) / f, (height, 1))
    return np.where(left > 2 / 3, 2 / np.maximum(left, 1e-9), 3.0)


@pytest.mark.parametrize("file", ["openni_kinect", "depth_camera"])
def test_depth_cameras_of_ros_1(post, file: str) -> None:
    more = "<pointCloudCutoff>0.4</pointCloudCutoff><pointCloudCutoffMax>2.99</pointCloudCutoffMax>"
    simulator = post(eye(ros1(file, more), "depth"), room=ROOM)
    (message,) = heard(simulator, "/cam/depth/image_raw")
    found, true = pixels(message), depths()
    farthest = 2.99 if file == "openni_kinect" else np.inf
    assert message.encoding == "32FC1"
    assert np.allclose(found, np.where(true < farthest, true, np.nan), atol=1e-5, equal_nan=True)
    (cloud,) = heard(simulator, "/cam/points")
    points = rows(cloud)
    assert layout(cloud) == [("x", 0), ("y", 4), ("z", 8), ("rgb", 16)]
    assert (cloud.width, cloud.height, cloud.point_step) == (64, 48, 32)
    assert cloud.is_dense == (file == "depth_camera")
    # Each point falls back on its own pixel.
    f = 64 / (2 * np.tan(0.6))
    row, column = np.divmod(np.arange(64 * 48), 64)
    seen = np.isfinite(points["z"])
    assert np.allclose((f * points["x"] / points["z"] + 31.5)[seen], column[seen], atol=1e-3)
    assert np.allclose((f * points["y"] / points["z"] + 23.5)[seen], row[seen], atol=1e-3)
    assert np.allclose(points["z"].reshape(48, 64), found, equal_nan=True)
    assert {t.name for t in simulator.bus.topics} >= {"/cam/depth/camera_info"}


def test_points_have_the_colours_of_their_pixels(post) -> None:
    room = ROOM.replace("</geometry>", "</geometry><material><diffuse>1 0.5 0.25 1</diffuse></material>")
    simulator = post(eye(ros1("openni_kinect"), "depth"), room=room)
    simulator.run(0.1)
    rgb = pixels(simulator.bus.latest("/cam/ir/image_raw")).reshape(-1, 3)
    packed = rows(simulator.bus.latest("/cam/points"))["rgb"].copy().view(np.uint32)
    assert np.array_equal(np.column_stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255]), rgb)
    assert rgb[0, 0] > rgb[0, 1] > rgb[0, 2]


def test_points_fall_back_onto_their_pixels_through_a_distorted_lens(post) -> None:
    lens = "<distortion><k1>-0.25</k1><k2>0.08</k2><k3>-0.01</k3><p1>0.002</p1><p2>-0.001</p2></distortion>"
    room = ROOM.replace("</geometry>", "</geometry><material><diffuse>1 0.5 0.25 1</diffuse></material>", 1)
    more = "<pointCloudCutoffMax>100</pointCloudCutoffMax>"
    simulator = post(eye(ros1("openni_kinect", more), "depth", camera(320, 240, more=lens)), room=room)
    simulator.run(0.1)
    points, info = rows(simulator.bus.latest("/cam/points")), simulator.bus.latest("/cam/ir/camera_info")
    rgb = pixels(simulator.bus.latest("/cam/ir/image_raw")).reshape(-1, 3)
    seen = np.isfinite(points["z"])
    where = np.column_stack([points["x"], points["y"], points["z"]]).astype(float)[seen]
    matrix = info.k.reshape(3, 3).copy()
    matrix[:2, 2] -= 1.0  # Gazebo Classic tells a principal point that is one pixel off
    back, _ = cv2.projectPoints(where, np.zeros(3), np.zeros(3), matrix, info.d)
    assert info.d.tolist() == [-0.25, 0.08, 0.002, -0.001, -0.01]
    row, column = np.divmod(np.flatnonzero(seen), 320)
    assert seen.mean() > 0.9
    assert np.abs(back[:, 0] - np.column_stack([column, row])).max() < 0.01
    packed = points["rgb"].copy().view(np.uint32)
    assert np.array_equal(np.column_stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255]), rgb)


def test_millimetres(post) -> None:
    more = "<useDepth16UC1Format>true</useDepth16UC1Format><pointCloudCutoffMax>2.99</pointCloudCutoffMax>"
    (message,) = heard(post(eye(ros1("openni_kinect", more), "depth"), room=ROOM), "/cam/depth/image_raw")
    true = depths()
    assert message.encoding == "16UC1"
    assert np.abs(pixels(message) - np.where(true < 2.99, 1000 * true, 0)).max() <= 0.51


def test_a_camera_of_ros_2_with_depth(post) -> None:
    plugin = """<plugin name="c" filename="libgazebo_ros_camera.so"><ros><namespace>n</namespace></ros>
    <camera_name>cam</camera_name>
    <min_depth>2.2</min_depth><max_depth>2.99</max_depth></plugin>"""
    simulator = post(eye(plugin, "depth"), room=ROOM)
    names = {t.name for t in simulator.bus.topics}
    assert names >= {"/n/cam/image_raw", "/n/cam/camera_info", "/n/cam/depth/camera_info", "/n/cam/points"}
    (message,) = heard(simulator, "/n/cam/depth/image_raw")
    true = depths(fov=1.2)
    expected = np.where(true >= 2.99, np.inf, np.where(true <= 2.2, -np.inf, true))
    assert np.allclose(pixels(message), expected, atol=1e-5)
    assert message.header.frame_id == "eye"


def test_cameras_of_gz_sim(post) -> None:
    optical = camera(more="<optical_frame_id>o</optical_frame_id>")
    simulator = post(
        eye(inside=optical, more="<topic>a/picture</topic>")
        + eye(type="rgbd_camera", more="<topic>b</topic>").replace('"lidar"', '"other"'),
        room=ROOM,
    )
    (picture,) = heard(simulator, "/a/picture")
    assert picture.header.frame_id == "o"
    (info,) = heard(simulator, "/a/camera_info")
    assert (info.k[2], info.k[5]) == (32.0, 24.0)
    (depth,) = heard(simulator, "/b/depth_image")
    assert np.allclose(pixels(depth), depths(), atol=1e-5)
    (cloud,) = heard(simulator, "/b/points")
    points = rows(cloud)
    assert (np.isclose(points["x"], 3, atol=1e-5) | np.isclose(points["y"], 2, atol=1e-5)).all()
    assert {t.name for t in simulator.bus.topics} >= {"/b/image", "/b/camera_info"}


def test_points_with_x_forward_have_the_frame_that_looks_along_x(post) -> None:
    optical = camera(more="<optical_frame_id>o</optical_frame_id>")
    simulator = post(eye(type="rgbd_camera", inside=optical, more="<topic>b</topic>"), room=ROOM)
    frames = {}
    for topic in ("image", "depth_image", "points", "camera_info"):
        (message,) = heard(simulator, f"/b/{topic}")
        frames[topic] = message.header.frame_id
    own = frames.pop("points")
    assert set(frames.values()) == {"o"}
    assert own != "o"
    (plain,) = heard(post(eye(type="rgbd_camera", more="<topic>b</topic>"), room=ROOM), "/b/image")
    assert own == plain.header.frame_id


def test_noise_has_its_mean_and_deviation(post) -> None:
    noisy = camera(500, 400, more=noise(0.02, 0.01))
    (plain,) = heard(post(eye(ros1(), inside=camera(500, 400)), room=ROOM), "/cam/image_raw")
    (grainy,) = heard(post(eye(ros1(), inside=noisy), room=ROOM), "/cam/image_raw")
    off = pixels(grainy).astype(float) - pixels(plain)
    assert abs(off.mean() - 2.55) < 5 * 5.1 / np.sqrt(off.size) + 0.01
    assert off.std() == pytest.approx(np.hypot(5.1, 12**-0.5), rel=0.01)


def test_edges_are_smooth_where_that_is_asked_for(post) -> None:
    smooth = camera().replace("</format>", "</format><anti_aliasing>8</anti_aliasing>")
    room = wall("east", 3.05, 0, 0.1, 1, role="visual").replace("<pose>3.05 0 0 0", "<pose>3.05 0 0 0.3")
    (plain,) = heard(post(eye(ros1()), room=room), "/cam/image_raw")
    (found,) = heard(post(eye(ros1(), inside=smooth), room=room), "/cam/image_raw")
    assert len(np.unique(pixels(plain).reshape(-1, 3), axis=0)) < len(np.unique(pixels(found).reshape(-1, 3), axis=0))
    (depth,) = heard(post(eye(ros1("openni_kinect"), "depth", smooth), room=room), "/cam/depth/image_raw")
    edge = pixels(depth)
    assert (np.isnan(edge) | (np.abs(edge - 3.0) < 0.2)).all()


@pytest.mark.parametrize(
    ("content", "why"), [(None, "does not exist"), (b"?", "is not a readable picture"), (LFS, POINTER)]
)
def test_a_texture_that_is_not_there_is_named_once(post, tmp_path, content, why: str) -> None:
    if content is not None:
        (tmp_path / "gone.png").write_bytes(content)
    (tmp_path / "plate.obj").write_text(
        "mtllib plate.mtl\nv 0 1 0\nv 0 -1 0\nv 0 0 3\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
    )
    (tmp_path / "plate.mtl").write_text("newmtl m\nmap_Kd gone.png\n")
    uri = f"<mesh><uri>file://{tmp_path / 'plate.obj'}</uri></mesh>"
    room = f"""<link name="l"><pose>3 0 0 0 0 0</pose><visual name="v"><geometry>{uri}</geometry></visual></link>"""
    notes: list[str] = []
    simulator = post(eye(ros1()), room=room, note=notes.append)
    (picture,) = heard(simulator, "/cam/image_raw")
    heard(simulator, "/cam/image_raw")
    (note,) = [note for note in notes if "gone.png" in note]
    reported = f"texture `gone.png` of `world/walls/visual/v` {why}; the shape is shown without it"
    assert re.fullmatch(rf"\S+\.\w+:\d+:\d+: {re.escape(reported)}", note)
    assert len(np.unique(pixels(picture).reshape(-1, 3), axis=0)) == 2


@pytest.mark.parametrize(
    ("inside", "reported"),
    [
        (
            camera().replace("</format>", "</format><anti_aliasing>1.5</anti_aliasing>"),
            "<anti_aliasing> is 1.5; it must",
        ),
        (camera(form="R8G8B9"), "unknown pixel format `R8G8B9`"),
        (camera(width=0), "<width> is 0; it must be a whole number, one or greater"),
        (camera(width=99999, height=99999), "a picture of 99999 × 99999 pixels cannot be rendered"),
        (camera(fov=3.5), "<horizontal_fov> is 3.5 rad; it must be between 0 and π"),
        (camera(near=2, far=1), "the range of the camera, 2 m to 1 m, is empty"),
        ("", "a camera sensor has no <camera>"),
    ],
)
def test_a_camera_that_makes_no_sense_is_left_out_by_name(post, inside: str, reported: str) -> None:
    notes: list[str] = []
    simulator = post(eye(ros1(), inside=inside), room=ROOM, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "; sensor `lidar` is ignored" in note
    simulator.run(0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "topic"),
    [
        ("simpleton", "/simpleton/camera1/image_raw"),
        ("mybot", "/mybot/camera1/image_raw"),
        ("artoo", "/artoo/camera1/image_raw"),
        ("bot", "/robot_0/camera1/image_raw"),
        ("heterogeneous", "/camera/depth/image_raw"),
    ],
)
def test_cameras_of_robots_see_the_house(robot: str, topic: str) -> None:
    notes: list[str] = []
    (file,) = ROBOTS.glob(f"*/*_description/urdf/{robot}.urdf.xacro")
    simulator = Simulator(load(file, package_path=[file.parents[2]]), world="house", note=notes.append)
    simulator.run(0.2)
    message = simulator.bus.latest(topic)
    seen = pixels(message)
    if message.encoding == "32FC1":
        assert np.isfinite(seen).mean() > 0.2
    else:
        assert len(np.unique(seen.reshape(-1, 3), axis=0)) > 5
    assert not [note for note in notes if "camera" in note]


def test_a_visual_of_the_world_that_is_broken_is_missed_by_eyes_alone(post, tmp_path) -> None:
    (tmp_path / "broken.stl").write_bytes(b"no mesh")
    uri = f"<mesh><uri>file://{tmp_path / 'broken.stl'}</uri></mesh>"
    room = ROOM + f'<link name="l"><visual name="v"><geometry>{uri}</geometry></visual></link>'
    notes: list[str] = []
    (picture,) = heard(post(eye(ros1()), room=room, note=notes.append), "/cam/image_raw")
    assert (pixels(picture) == round(255 * 0.4 * 0.7)).all()  # the walls, in ambient light
    (note,) = [each for each in notes if "broken.stl" in each]
    assert "visual `v` is invisible: mesh broken.stl is truncated" in note


@pytest.mark.parametrize("role", ["visual", "collision"])
def test_a_mesh_that_is_not_there_is_missed_by_eyes_alone(tmp_path, role: str) -> None:
    shape = f'<{role}><geometry><mesh filename="gone.stl"/></geometry></{role}>'
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="base">{shape}{inertial}</link><gazebo reference="base">{eye(ros1())}</gazebo>'
        "</robot>"
    )
    notes: list[str] = []
    if role == "collision":
        with pytest.raises(ResourceError, match="gone"):
            Simulator(tmp_path / "r.urdf", note=notes.append, strict=True)
    simulator = Simulator(tmp_path / "r.urdf", fixed_base=True, note=notes.append)
    assert heard(simulator, "/cam/image_raw")
    (note,) = [each for each in notes if "gone.stl" in each]
    assert note.endswith("it is invisible") == (role == "visual")
    assert "r.urdf:1:" in note


@pytest.mark.slow
def test_images_that_are_built_later_are_those_of_their_time(post) -> None:
    """Noise and poses are those of the step at which an image is due, although a crate has fallen on."""
    box = "<geometry><box><size>0.5 0.5 0.5</size></box></geometry>"
    crate = (
        '</model><model name="crate"><pose>2 0 0.6 0 0 0</pose><link name="box"><inertial><mass>1</mass></inertial>'
        f'<visual name="v">{box}</visual></link>'
    )
    text, images, builders = eye(ros1(), inside=camera(more=noise(0.02))), [], []
    now, later = (post(text, room=ROOM + crate, seed=3) for _ in range(2))
    now.subscribe("/cam/image_raw", "sensor_msgs/msg/Image", images.append)
    later.bus.subscribe("/cam/image_raw", "sensor_msgs/msg/Image", print, defer=builders.append)
    for simulator in (now, later):
        simulator.run(0.3)
    with ThreadPoolExecutor(1) as pool:
        built = list(pool.map(lambda build: build(), builders))
    assert len(built) == len(images) == 3
    for one, other in zip(built, images, strict=True):
        assert one.header == other.header
        assert one.data.tobytes() == other.data.tobytes()
    assert len({one.data.tobytes() for one in built}) == 3
