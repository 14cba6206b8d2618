"""Point clouds, ranges and what the other lidar plugins publish: fields byte by byte, points where the walls are."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import ROOM, heard, noise, scan, sensor, wall

RINGS = scan(90, -0.5, 0.5, rings=16, spread=0.2618)


def plugin(file: str, inside: str = "") -> str:
    return f'<plugin name="points" filename="lib{file}.so">{inside}</plugin>'


def ray_sensor(output: str = "", more: str = "") -> str:
    kind = f"<output_type>sensor_msgs/{output}</output_type>" if output else ""
    return plugin("gazebo_ros_ray_sensor", f"<ros><namespace>n</namespace></ros>{kind}{more}")


def rows(message) -> np.ndarray:
    """Return a PointCloud2 as it describes itself."""
    kinds = {7: "<f4", 4: "<u2"}
    kind = np.dtype(
        {
            "names": [f.name for f in message.fields],
            "formats": [kinds[f.datatype] for f in message.fields],
            "offsets": [f.offset for f in message.fields],
            "itemsize": message.point_step,
        }
    )
    assert message.row_step == message.point_step * message.width
    assert len(message.data) == message.row_step * message.height
    assert not message.is_bigendian
    return np.frombuffer(message.data.tobytes(), kind)


def layout(message) -> list[tuple[str, int]]:
    return [(f.name, f.offset) for f in message.fields]


def on_walls(points) -> np.ndarray:
    """Return whether points, relative to the lidar, lie on one of the faces of `ROOM`."""
    return np.isclose(points["x"], 3, atol=1e-5) | np.isclose(points["y"], 2, atol=1e-5)


def test_ros_2_gives_a_cloud_of_what_it_met(post) -> None:
    (message,) = heard(
        post(sensor(ray_sensor(), inside=RINGS, type="gpu_ray"), room=ROOM.replace("collision", "visual")),
        "/n/points/out",
    )
    points = rows(message)
    assert layout(message) == [("x", 0), ("y", 4), ("z", 8), ("intensity", 12)]
    assert (message.point_step, message.height, message.width, message.is_dense) == (16, 1, 16 * 90, True)
    assert message.header.frame_id == "eye"
    assert on_walls(points).all()
    assert set(points["intensity"].tolist()) == {120.0}
    assert (np.diff(points["z"][::90]) > 0).all()  # ring by ring, the lowest first


def test_ros_2_leaves_out_what_is_nowhere_and_clips_intensities(post) -> None:
    wide = scan(100, -3.0, 3.0, far=2.5)
    (message,) = heard(post(sensor(ray_sensor(more="<min_intensity>70</min_intensity>"), inside=wide)), "/n/points/out")
    points = rows(message)
    assert 0 < message.width < 100
    assert set(points["intensity"].tolist()) == {70.0}


@pytest.mark.parametrize("output", ["LaserScan", "PointCloud", "Range"])
def test_ros_2_has_other_outputs(post, output: str) -> None:
    near = scan(31, -0.3, 0.3)
    (message,) = heard(post(sensor(ray_sensor(output, "<frame_name>f</frame_name>"), inside=near)), "/n/points/out")
    assert message.header.frame_id == "f"
    if output == "LaserScan":
        assert message.ranges[15] == pytest.approx(3.0)
    elif output == "PointCloud":
        assert len(message.points) == 31
        assert all(point.x == pytest.approx(3.0) for point in message.points)
        assert message.channels[0].name == "intensity"
        assert message.channels[0].values.tolist() == [120.0] * 31
    else:
        assert message.range == pytest.approx(3.0)
        assert message.field_of_view == pytest.approx(0.6)
        assert (message.radiation_type, message.min_range, message.max_range) == (1, 0.1, 30.0)


def test_an_unknown_output_is_refused_with_the_nearest(post) -> None:
    notes: list[str] = []
    post(sensor(ray_sensor("PointCloud3")), note=notes.append)
    assert any("did you mean `sensor_msgs/PointCloud" in note for note in notes)


VELODYNE = """<topicName>/velodyne_points</topicName><frameName>velodyne</frameName><min_range>0.9</min_range>
<max_range>4</max_range>"""


def test_velodyne_of_ros_1(post) -> None:
    (message,) = heard(post(sensor(plugin("gazebo_ros_velodyne_laser", VELODYNE), inside=RINGS)), "/velodyne_points")
    points = rows(message)
    assert layout(message) == [("x", 0), ("y", 4), ("z", 8), ("intensity", 16), ("ring", 20)]
    assert (message.point_step, message.height, message.is_dense) == (32, 1, True)
    assert points["ring"][:32].tolist() == [*range(16), *range(16)]  # column by column
    assert on_walls(points).all()
    elevation = np.arctan2(points["z"], np.hypot(points["x"], points["y"]))
    assert np.allclose(elevation, np.linspace(-0.2618, 0.2618, 16)[points["ring"]], atol=1e-6)


def test_velodyne_drops_what_is_out_of_range_or_marks_it(post) -> None:
    short = VELODYNE.replace("<max_range>4", "<max_range>3.1")
    (some,) = heard(post(sensor(plugin("gazebo_ros_velodyne_laser", short), inside=RINGS)), "/velodyne_points")
    assert 0 < some.width < 90 * 16
    organized = short + "<organize_cloud>true</organize_cloud>"
    (all,) = heard(post(sensor(plugin("gazebo_ros_velodyne_laser", organized), inside=RINGS)), "/velodyne_points")
    assert (all.width, all.height, all.is_dense) == (16, 90, False)
    assert np.isfinite(rows(all)["x"]).sum() == some.width


def test_velodyne_of_ros_2_and_its_noise(post) -> None:
    inside = (
        "<ros><remapping>~/out:=/cloud</remapping></ros><gaussian_noise>0.02</gaussian_noise><frame_name>v</frame_name>"
    )
    many = scan(3000, -0.4, 0.4, rings=16, spread=0.2)
    (message,) = heard(post(sensor(plugin("gazebo_ros_velodyne_gpu_laser", inside), inside=many)), "/cloud")
    points = rows(message)
    assert layout(message)[3:] == [("intensity", 12), ("ring", 16), ("time", 18)]
    assert message.point_step == 22
    found = np.sqrt(points["x"] ** 2 + points["y"] ** 2 + points["z"] ** 2)
    off = found * (1 - 3 / points["x"])
    assert len(off) == 48_000
    assert abs(off.mean()) < 5 * 0.02 / np.sqrt(48_000)
    assert off.std() == pytest.approx(0.02, rel=0.02)


def test_the_block_laser_gives_old_clouds(post) -> None:
    inside = "<topicName>blocks</topicName><frameName>eye</frameName><gaussianNoise>0</gaussianNoise>"
    two = scan(31, -0.3, 0.3, rings=3, spread=0.1)
    (message,) = heard(post(sensor(plugin("gazebo_ros_block_laser", inside), inside=two)), "/blocks")
    assert len(message.points) == 93
    assert all(point.x == pytest.approx(3.0) for point in message.points)
    assert message.points[0].z < 0 < message.points[-1].z


def test_the_rangefinder_gives_the_nearest(post) -> None:
    inside = "<topicName>sonar</topicName><frameName>eye</frameName><radiation>infrared</radiation><fov>0.3</fov>"
    simulator = post(sensor(plugin("gazebo_ros_range", inside), inside=scan(21, -0.3, 0.9, rings=3, spread=0.1)))
    (message,) = heard(simulator, "/sonar")
    angles = np.linspace(-0.3, 0.9, 21)
    nearest = min(min(3 / np.cos(a), 2 / np.sin(a) if a > 0 else 9) for a in angles)
    assert message.range == pytest.approx(nearest)
    assert (message.radiation_type, message.field_of_view) == (1, 0.3)
    (empty,) = heard(post(sensor(plugin("gazebo_ros_range", inside)), room=wall("w", 50, 0, 0.1, 9)), "/sonar")
    assert empty.range == 30.0


def test_the_rangefinders_own_rate_slows_it(post) -> None:
    inside = "<topicName>sonar</topicName><updateRate>5</updateRate>"
    assert len(heard(post(sensor(plugin("gazebo_ros_range", inside), rate=50)), "/sonar", 1.0)) == 5


def test_gz_sims_lidar_needs_no_plugin(post) -> None:
    text = sensor(
        inside=RINGS.replace("ray>", "lidar>"),
        type="gpu_lidar",
        more="<topic>lidar</topic><gz_frame_id>v</gz_frame_id>",
    )
    simulator = post(text, room=ROOM.replace("collision", "visual"))
    (laser,) = heard(simulator, "/lidar")
    assert laser.header.frame_id == "v"
    assert len(laser.ranges) == 90
    (message,) = heard(simulator, "/lidar/points")
    points = rows(message)
    assert layout(message) == [("x", 0), ("y", 4), ("z", 8), ("intensity", 16), ("ring", 24)]
    assert (message.width, message.height, message.point_step, message.is_dense) == (90, 16, 32, True)
    assert on_walls(points).all()
    assert points["ring"].tolist() == np.repeat(np.arange(16), 90).tolist()
    ring = points[8 * 90 : 9 * 90]
    assert np.allclose(np.sqrt(ring["x"] ** 2 + ring["y"] ** 2 + ring["z"] ** 2), laser.ranges, atol=1e-5)


def test_both_topics_of_a_lidar_show_one_and_the_same_reading(post) -> None:
    noisy = scan(50, -0.4, 0.4, noise=noise(0.1)).replace("ray>", "lidar>")
    simulator = post(sensor(inside=noisy, type="lidar"), room=ROOM.replace("collision", "visual"))
    simulator.run(0.1)
    base = "/world/room/model/post/link/eye/sensor/lidar/scan"
    laser, cloud = simulator.bus.latest(base), simulator.bus.latest(f"{base}/points")
    assert laser.header.frame_id == "post/eye/lidar"
    assert np.allclose(np.hypot(rows(cloud)["x"], rows(cloud)["y"]), laser.ranges, atol=1e-5)
