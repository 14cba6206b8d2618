"""The robot simpleton: a sound description, mended as its README states, that drives as commanded."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.description.xacro.expand import expand
from urdfkit.kinematics import Kinematics, TransformTree
from urdfkit.lint import lint
from urdfkit.resources import find_model, robots_dir, templates_dir
from urdfkit.scaffold import load_template
from urdfkit.sim import Simulator

HOME = robots_dir() / "simpleton"


@pytest.fixture(scope="module")
def robot():
    return load(find_model(["simpleton"]).path)


@pytest.fixture(scope="module")
def kinematics(robot):
    return Kinematics(robot)


def plugin(robot, filename):
    blocks = [*robot.gazebo, *(sensor for block in robot.gazebo for sensor in block.sensors)]
    return next(p.element for block in blocks for p in block.plugins if p.filename == filename)


def test_links_and_joints(robot):
    assert robot.name == "simpleton"
    assert [link.name for link in robot.roots()] == ["base_footprint"]
    assert robot.link_by_name["base_footprint"].inertial is None
    assert set(robot.link_by_name) == {
        "base_footprint",
        "chassis",
        "left_wheel",
        "right_wheel",
        "caster",
        "camera",
        "camera_link_optical",
    }
    assert {joint.name for joint in robot.joints if joint.is_movable} == {"left_wheel_joint", "right_wheel_joint"}


def test_nothing_to_find():
    assert [str(finding) for finding in lint([HOME])] == []


def test_masses_and_inertias_are_those_of_solid_bodies(robot):
    def inertia(link):
        i = robot.link_by_name[link].inertial.inertia
        return np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])

    assert robot.link_by_name["chassis"].inertial.mass == 1.0
    np.testing.assert_allclose(
        inertia("chassis"), np.diag([0.3**2 + 0.1**2, 0.5**2 + 0.1**2, 0.5**2 + 0.3**2]) / 12, rtol=1e-12
    )
    for wheel in ("left_wheel", "right_wheel"):
        across = 0.2 * (3 * 0.1**2 + 0.1**2) / 12
        np.testing.assert_allclose(inertia(wheel), np.diag([across, 0.2 * 0.1**2 / 2, across]), rtol=1e-12)
    np.testing.assert_allclose(inertia("caster"), np.eye(3) * 2 / 5 * 0.1 * 0.05**2, rtol=1e-12)
    np.testing.assert_allclose(inertia("camera"), np.eye(3) * 0.05 * 0.05**2 / 6, rtol=1e-12)


def test_centres_of_mass_are_inside_the_bodies(robot):
    for link in robot.links:
        if link.inertial is not None:
            assert link.inertial.origin.xyz == link.collisions[0].origin.xyz, link.name


def test_stands_on_the_ground_with_the_chassis_level(robot, kinematics):
    height = dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.neutral()), strict=True))
    for wheel in ("left_wheel", "right_wheel"):
        assert height[wheel][2] - robot.link_by_name[wheel].collisions[0].geometry.radius == pytest.approx(0, abs=1e-15)
    assert height["caster"][2] - robot.link_by_name["caster"].collisions[0].geometry.radius == pytest.approx(
        0, abs=1e-15
    )
    np.testing.assert_allclose(height["chassis"][3:], [0, 0, 0, 1], atol=1e-15)


def test_the_drive_knows_its_wheels(robot):
    drive = plugin(robot, "libgazebo_ros_diff_drive.so")
    text = {child.tag: child.text for child in drive.children}
    left, right = (robot.joint_by_name[text[side]] for side in ("leftJoint", "rightJoint"))
    assert left.origin.xyz[1] > 0 > right.origin.xyz[1]
    assert float(text["wheelSeparation"]) == pytest.approx(left.origin.xyz[1] - right.origin.xyz[1], rel=1e-15)
    assert float(text["wheelDiameter"]) == 2 * robot.link_by_name["left_wheel"].collisions[0].geometry.radius
    assert float(text["wheelTorque"]) == left.limit.effort == right.limit.effort
    assert left.axis == right.axis == (0, 1, 0)
    assert text["robotBaseFrame"] in robot.link_by_name


def test_the_camera_publishes_in_a_frame_that_is_there(robot):
    camera = plugin(robot, "libgazebo_ros_camera.so")
    text = {child.tag: child.text for child in camera.children}
    assert text["frameName"] in robot.link_by_name
    assert f"{text['cameraName']}/{text['imageTopicName']}" == "simpleton/camera1/image_raw"


@pytest.mark.parametrize(("height", "pitch"), [(0.0, 0.0), (0.5, 0.6)])
def test_camera_arguments_and_optical_frame(height, pitch):
    arguments = {"camera_height": str(height), "camera_pitch": str(pitch)}
    kinematics = Kinematics(load(find_model(["simpleton"]).path, arguments=arguments))
    pose = dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.neutral()), strict=True))
    np.testing.assert_allclose(pose["camera"][:3], [0.125, 0, 0.225 + height], atol=1e-12)
    x, y, z, w = pose["camera_link_optical"][3:]
    forward = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]  # its z
    rightward = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]  # its x
    np.testing.assert_allclose(forward, [math.cos(pitch), 0, -math.sin(pitch)], atol=1e-12)
    np.testing.assert_allclose(rightward, [0, -1, 0], atol=1e-12)


@pytest.mark.check_urdf
def test_other_readers_agree(tmp_path):
    path = tmp_path / "simpleton.urdf"
    path.write_text(expand(find_model(["simpleton"]).path).xml)
    done = subprocess.run(["check_urdf", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "root Link: base_footprint" in done.stdout
    assert done.stderr == ""


def test_mujoco_agrees_on_the_mass(tmp_path, robot):
    import mujoco

    model = mujoco.MjModel.from_xml_string(expand(find_model(["simpleton"]).path).xml)
    assert model.njnt == 2
    # MuJoCo welds the root to the world, with everything that is fixed to it: only the wheels are bodies of their own.
    assert model.body_mass.sum() == pytest.approx(0.4)


def test_yourdfpy_places_every_link_where_we_do(tmp_path, kinematics):
    import yourdfpy

    path = tmp_path / "simpleton.urdf"
    path.write_text(expand(find_model(["simpleton"]).path).xml)
    peer = yourdfpy.URDF.load(str(path))
    turned = {"left_wheel_joint": 0.7, "right_wheel_joint": -2.0}
    peer.update_cfg(turned)
    tree = TransformTree(kinematics)
    q = kinematics.configuration(turned)
    for link in kinematics.link_names:
        ours = tree.placement(link, "base_footprint", q).homogeneous
        np.testing.assert_allclose(ours, peer.get_transform(link, "base_footprint"), atol=1e-12)


def drive(command, *, ramp, seconds):
    """Drive on a command that is ramped up, and integrate the ideal unicycle next to it."""
    simulator = Simulator("simpleton", note=lambda _: None)
    x = y = yaw = 0.0
    dt = simulator.dt
    for step in range(round(seconds / dt)):
        f = min(1.0, (step + 0.5) * dt / ramp)
        v, w = (f * part for part in command)
        if step * dt < ramp + dt:
            simulator.command((v, 0, 0), (0, 0, w))
            simulator.step()
        x += v * math.cos(yaw + w * dt / 2) * dt
        y += v * math.sin(yaw + w * dt / 2) * dt
        yaw += w * dt
    simulator.run(seconds - simulator.t)
    return simulator, (x, y, yaw)


def base(simulator):
    x, y, z, qx, qy, qz, qw = simulator.link_poses()[0]
    tilt = math.hypot(qx, qy)
    return x, y, z, 2 * math.atan2(qz, qw), tilt


@pytest.mark.parametrize("command", [(0.5, 0.5), (0.5, 0.0), (-0.5, 0.3), (0.0, 1.0)])
def test_drives_as_commanded(command):
    simulator, (x, y, yaw) = drive(command, ramp=0.5, seconds=10)
    found = base(simulator)
    assert math.hypot(found[0] - x, found[1] - y) < 0.005
    assert abs(math.remainder(found[3] - yaw, 2 * math.pi)) < 0.008
    assert abs(found[2]) < 1e-6
    assert found[4] < 1e-6


def test_neither_slips_nor_tips_when_it_starts_and_stops_at_once():
    simulator = Simulator("simpleton", note=lambda _: None)
    worst = 0.0
    for v, w in ((0.5, 0.0), (-0.5, 0.0), (0.5, 1.0), (0.0, 0.0)):
        simulator.command((v, 0, 0), (0, 0, w))
        for _ in range(100):
            simulator.step(10)
            worst = max(worst, base(simulator)[4])
    x, y, _, yaw, _ = base(simulator)
    (ox, oy, _), (_, _, qz, qw) = next(iter(simulator.odometry().values()))
    assert worst < 1e-3
    assert math.hypot(x - ox, y - oy) < 1e-3
    assert abs(math.remainder(yaw - 2 * math.atan2(qz, qw), 2 * math.pi)) < 1e-3


def test_it_is_laid_out_as_a_new_robot():
    template = load_template(templates_dir() / "robot")
    answers = template.answers({"name": "simpleton", "ros": "noetic"}) | {"year": "2026", "into": "."}
    made = {target for _, target in template.files(answers)}
    there = {path.relative_to(HOME) for path in HOME.rglob("*") if path.is_file()}
    extra = {Path("README.md"), Path("simpleton_description/urdf/camera.xacro")}
    assert there == made | extra
