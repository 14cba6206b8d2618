"""Laser scans: ranges to walls whose distance is known, fields, limits, rates, and nothing done for nobody."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import LASER, ROOM, heard, noise, scan, sensor, wall
from tests.suggestions import contains
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.sim import Spawn
from urdfkit.sim.plugins.sensors.lidars.scan_pattern import Scan, scan_of


def distances(angles, *, far=30.0):
    """Return how far the walls of `ROOM` are from its origin; infinite beyond `far`."""
    with np.errstate(divide="ignore"):
        found = np.minimum(
            np.where(np.cos(angles) > 0, 3 / np.cos(angles), 60 / -np.cos(angles)),
            np.where(np.sin(angles) > 0, 2 / np.sin(angles), np.inf),
        )
    return np.where(found < far, found, np.inf)


def test_a_scan_is_what_geometry_says(post) -> None:
    (message,) = heard(post(sensor(LASER)), "/scan")
    angles = np.linspace(-0.5, 1.5, 181)
    assert np.allclose(message.ranges, distances(angles), rtol=1e-6)
    assert message.header.frame_id == "eye"
    assert (message.angle_min, message.angle_max) == (-0.5, 1.5)
    assert message.angle_increment == pytest.approx(2 / 180)
    assert (message.range_min, message.range_max) == (0.1, 30.0)
    assert (message.time_increment, message.scan_time) == (0.0, 0.0)
    assert message.ranges.dtype == message.intensities.dtype == np.float32
    east = angles < np.arctan2(2, 3)
    assert np.array_equal(message.intensities, np.where(east, 120, 50))


def test_the_robot_and_the_sensor_may_be_turned(post) -> None:
    turned = sensor(LASER, more="<pose>0.2 0 0 0 0 0.3</pose>")
    (message,) = heard(post(turned, spawn=Spawn(x=0.5, y=0.25, z=0.0, yaw=0.4)), "/scan")
    x, y = 0.5 + 0.2 * np.cos(0.4), 0.25 + 0.2 * np.sin(0.4)
    angles = np.linspace(-0.5, 1.5, 181) + 0.7
    with np.errstate(divide="ignore"):
        east = np.where(np.cos(angles) > 0, (3 - x) / np.cos(angles), np.inf)
        north = np.where(np.sin(angles) > 0, (2 - y) / np.sin(angles), np.inf)
    assert np.allclose(message.ranges, np.minimum(east, north), rtol=1e-6)


def test_what_is_too_far_is_infinite(post) -> None:
    everywhere = sensor(LASER, inside=scan(360, -3.1, 3.1))
    (message,) = heard(post(everywhere), "/scan")
    true = distances(np.linspace(-3.1, 3.1, 360))
    assert np.isinf(true).any()
    assert np.allclose(message.ranges, true, rtol=1e-6)


def test_what_is_nearer_than_the_least_range_is_not_seen(post) -> None:
    near = wall("housing", 0, 0, 0.05, 0.05)
    (message,) = heard(post(sensor(LASER), room=ROOM + near), "/scan")
    assert np.allclose(message.ranges, distances(np.linspace(-0.5, 1.5, 181)), rtol=1e-6)


def test_resolution_multiplies_samples(post) -> None:
    fine = scan().replace("<resolution>1<", "<resolution>2<")
    (message,) = heard(post(sensor(LASER, inside=fine)), "/scan")
    assert len(message.ranges) == 362
    assert message.angle_increment == pytest.approx(2 / 361)


def test_the_middle_ring_makes_the_scan(post) -> None:
    (message,) = heard(post(sensor(LASER, inside=scan(rings=5, spread=0.4))), "/scan")
    assert np.allclose(message.ranges, distances(np.linspace(-0.5, 1.5, 181)), rtol=1e-6)


def test_it_comes_at_its_rate_in_simulated_time(post) -> None:
    messages = heard(post(sensor(LASER, rate=40)), "/scan", 1.0)
    stamps = [m.header.stamp.sec + 1e-9 * m.header.stamp.nanosec for m in messages]
    assert np.allclose(stamps, np.arange(1, 41) * 0.025)


def test_nothing_is_done_for_nobody_but_the_last_one_can_be_had(post) -> None:
    simulator = post(sensor(LASER))
    simulator.run(1.0)
    topic = simulator.bus.advertise("/scan", "sensor_msgs/msg/LaserScan")
    assert topic.count == 10
    surroundings = simulator.surroundings
    assert not surroundings.is_used
    assert np.allclose(topic.latest.ranges, distances(np.linspace(-0.5, 1.5, 181)), rtol=1e-6)
    assert surroundings.is_used


def test_noise_is_drawn_from_the_seed_whoever_listens(post) -> None:
    noisy = sensor(LASER, inside=scan(noise=noise(0.1)))

    def last(*, seed: int, listen: bool):
        simulator = post(noisy, seed=seed)
        if listen:
            return heard(simulator, "/scan", 0.5)[-1]
        simulator.run(0.5)
        return simulator.bus.latest("/scan")

    first = last(seed=1, listen=True)
    assert np.array_equal(first.ranges, last(seed=1, listen=False).ranges)
    assert not np.array_equal(first.ranges, last(seed=2, listen=True).ranges)


def test_noise_has_its_mean_and_deviation_and_stays_within_limits(post) -> None:
    noisy = scan(20_000, -0.5, 0.5, noise=noise(0.02, 0.01))
    messages = heard(post(sensor(LASER, inside=noisy, rate=100)), "/scan", 0.5)
    angles = np.linspace(-0.5, 0.5, 20_000)
    off = np.concatenate([m.ranges - distances(angles) for m in messages])
    assert len(off) == 10**6
    assert abs(off.mean() - 0.01) < 5 * 0.02 / 1000
    assert abs(off.std() - 0.02) < 5 * 0.02 / np.sqrt(2e6)
    far = scan(2000, -0.5, 0.5, far=3.01, noise=noise(0.5))
    (message,) = heard(post(sensor(LASER, inside=far)), "/scan")
    assert message.ranges[np.isfinite(message.ranges)].max() <= np.float32(3.01)
    assert np.array_equal(np.isinf(message.ranges), distances(np.linspace(-0.5, 0.5, 2000)) >= 3.01)


def test_ray_meets_collisions_and_gpu_ray_visuals(post) -> None:
    room = wall("felt", 3.05, 0, 0.1, 10) + wall("seen", 5.05, 0, 0.1, 20, role="visual")
    ahead = scan(1, 0, 0)
    for type, distance in (("ray", 3.0), ("gpu_ray", 5.0)):
        (message,) = heard(post(sensor(LASER, inside=ahead, type=type), room=room), "/scan")
        assert message.ranges[0] == pytest.approx(distance)


@pytest.mark.parametrize(
    ("written", "topic"),
    [
        ("<topicName>scan</topicName>", "/scan"),
        ("<robotNamespace>/ns</robotNamespace><topicName>scan</topicName>", "/ns/scan"),
        ("<robotNamespace>/ns</robotNamespace><topicName>/scan</topicName>", "/scan"),
        ("<robotNamespace/><topicName>scan</topicName>", "/post/scan"),
        ("<robotNamespace>ns</robotNamespace>", "/world"),
    ],
)
def test_ros_1_names_its_topics(post, written: str, topic: str) -> None:
    (message,) = heard(post(sensor(f'<plugin name="l" filename="libgazebo_ros_laser.so">{written}</plugin>')), topic)
    assert message.header.frame_id == "world"


def test_a_reset_starts_the_count_again(post) -> None:
    simulator = post(sensor(LASER, inside=scan(noise=noise(0.1))))
    first = heard(simulator, "/scan", 0.2)
    simulator.reset()
    again = heard(simulator, "/scan", 0.2)
    assert [m.header.stamp for m in first] == [m.header.stamp for m in again]
    assert all(np.array_equal(a.ranges, b.ranges) for a, b in zip(first, again, strict=True))


@pytest.mark.parametrize(
    ("wrong", "reported"),
    [
        (sensor(LASER, inside=scan(0)), "<horizontal> has 0 samples; it must have at least one"),
        (sensor(LASER, inside=scan(9, 1.0, -1.0)), "<horizontal> goes from 1 to -1 rad"),
        (sensor(LASER, inside=scan().replace("<min>0.1", "<min>-0.1")), "<min> is -0.1 m; it must be zero or greater"),
        (sensor(LASER, inside=scan(far=0.05)), "the range of the lidar, 0.1 m to 0.05 m, is empty"),
        (sensor(LASER, inside=""), "a lidar has no <ray>"),
        (sensor(type="gpu_lidar", inside=""), "a lidar has no <lidar>"),
        (sensor(LASER, inside=scan("many")), "<samples> is `many`; it must be a finite number"),
        (sensor(LASER, inside=scan(9_000_000)), "9000000 × 1 rays are more than 4000000"),
        (sensor(LASER, inside=scan(noise=noise(-1))), "<stddev> is `-1`; it must be a finite number, 0 or greater"),
        (
            sensor(LASER, inside=scan(noise="<noise><type>gausian</type></noise>")),
            "unknown noise type `gausian`; did you mean `gaussian`?",
        ),
        (sensor(LASER, more="<pose>1 2 3</pose>"), "<pose> is `1 2 3`; it must be 6 finite numbers"),
        (sensor(LASER, rate="often"), "<update_rate> is `often`"),
    ],
)
def test_a_sensor_that_makes_no_sense_is_left_out_by_name_and_the_rest_runs(post, wrong: str, reported: str) -> None:
    notes: list[str] = []
    good = sensor(LASER.replace("scan<", "good<"))
    simulator = post(wrong + good, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "post.urdf:" in note
    assert "; sensor `lidar` is ignored" in note
    assert heard(simulator, "/good")


FAN = "<samples>8</samples><max_angle>1</max_angle>"
RANGE = "<range><min>0.5</min><max>2</max></range>"


@pytest.mark.parametrize(
    ("written", "pattern"),
    [
        ("<range><max>inf</max></range>", Scan(640, 0.0, 0.0, 1, 0.0, 0.0, 0.0, np.inf)),
        (
            f"<scan><horizontal>{FAN}<resolution>0.5</resolution></horizontal><vertical>{FAN}</vertical></scan>{RANGE}",
            Scan(4, 0.0, 1.0, 8, 0.0, 1.0, 0.5, 2.0),
        ),
    ],
)
def test_what_a_lidar_lacks_has_the_defaults_of_sdformat(written: str, pattern: Scan) -> None:
    element = document_of(Source("s.urdf", f"<sensor><lidar>{written}</lidar></sensor>"))
    assert scan_of(SensorTag("s", "gpu_lidar", (), element)) == pattern
