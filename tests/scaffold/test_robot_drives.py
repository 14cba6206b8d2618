"""What `urdfkit new robot` writes is a robot: it lints clean, stands, drives as commanded, never slips or tips."""

import math
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.errors import UsageError
from urdfkit.lint import lint
from urdfkit.resources import find_model, templates_dir
from urdfkit.scaffold import create, load_template
from urdfkit.sim import Simulator

TEMPLATE = load_template(templates_dir() / "robot")


def made(folder, **given):
    """Write a robot and load it."""
    answers = TEMPLATE.answers({"name": "scout", **given}) | {"year": "2026", "into": "."}
    create(TEMPLATE, answers, Path(folder))
    return load(find_model([f"{folder}/scout_description"]).path)


def start_and_stop(robot):
    """Return the greatest tilt, and how far odometry is from the truth, on full commands from rest and back to it."""
    simulator = Simulator(robot, note=lambda _: None)
    tilt = 0.0
    for v, w in ((0.5, 0.0), (0.5, 1.0), (0.0, 0.0)):
        simulator.command((v, 0, 0), (0, 0, w))
        for _ in range(100):
            simulator.step(10)
            tilt = max(tilt, math.hypot(*simulator.link_poses()[0, 3:5]))
    x, y, z = simulator.link_poses()[0, :3]
    (ox, oy, _), _ = next(iter(simulator.odometry().values()))
    return simulator, tilt, math.dist((x, y), (ox, oy)), z


@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_drives_and_stops(tmp_path, ros):
    simulator, tilt, slip, z = start_and_stop(made(tmp_path, ros=ros))
    assert simulator.link_poses()[0, 0] > 0.4
    assert tilt < 1e-3
    assert slip < 1e-3
    assert abs(z) < 1e-6
    simulator.run(1)
    rest = simulator.link_poses()[0].copy()
    simulator.run(1)
    assert abs(simulator.link_poses()[0] - rest).max() < 1e-9


@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_circle_is_the_ideal_one(tmp_path, ros):
    simulator = Simulator(made(tmp_path, ros=ros), note=lambda _: None)
    ramp, dt = 0.5, simulator.dt
    while simulator.t < ramp:
        f = min(1.0, (simulator.t + dt / 2) / ramp)
        simulator.command((0.5 * f, 0, 0), (0, 0, 0.5 * f))
        simulator.step()
    simulator.command((0.5, 0, 0), (0, 0, 0.5))
    simulator.run(10 - simulator.t)
    turned = 0.5 * (10 - ramp / 2)  # on a circle of radius 1 m, whatever the ramp
    x, y = simulator.link_poses()[0, :2]
    assert math.dist((x, y), (math.sin(turned), 1 - math.cos(turned))) < 0.005


@pytest.mark.slow
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    size=st.tuples(st.floats(0.1, 1.5), st.floats(0.1, 1.0), st.floats(0.03, 0.6)),
    wheel=st.tuples(st.floats(0.03, 0.3), st.floats(0.01, 0.1)),
    mass=st.floats(0.5, 100),
    ros=st.sampled_from(["jazzy", "noetic"]),
)
def test_every_size_that_is_accepted_is_a_good_robot(size, wheel, mass, ros):
    names = ("base_length", "base_width", "base_height", "wheel_radius", "wheel_width")
    given = dict(zip(names, map("{:.3f}".format, (*size, *wheel)), strict=True)) | {"mass": f"{mass:.2f}", "ros": ros}
    with tempfile.TemporaryDirectory() as folder:
        try:
            robot = made(folder, **given)
        except UsageError as error:
            density = mass / math.prod(size)  # only wheels too large for the base, and no known materials, are refused,
            too_tall = size[2] > 1.5 * size[0] and "veer off" in str(error)  # and bodies that limit the torque too much
            assert wheel[0] + 0.001 > 0.8 * size[0] or density < 2.1 or density > 18000 or too_tall
            return
        assert [str(finding) for finding in lint([folder])] == []
        _, tilt, slip, _ = start_and_stop(robot)
        assert tilt < 5e-3
        assert slip < 5e-3
