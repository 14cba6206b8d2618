"""The scenes go as they must in our engine, their checks can fail, and the peers are given the same."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin

import numpy as np
import pytest

from tests.bench.peers.correctness_checks import arc_motion, resting_pose, skid_rate
from tests.bench.peers.engine_scene import InUrdfkit
from tests.bench.peers.scene import CALL, Check, Motor, Running, Scene, Servo
from tests.bench.peers.scenes import SCENES, robots

BY_NAME = {scene.name: scene for scene in SCENES}
names = pytest.mark.parametrize("name", list(BY_NAME))


def wrong(scene: Scene) -> list[str]:
    return [check.what for check in scene.check(InUrdfkit(scene)) if not check.ok]


def changed(name: str, **changes: object) -> Scene:
    scene = BY_NAME[name]
    return replace(scene, things=tuple(replace(thing, **changes) for thing in scene.things))  # type: ignore[arg-type]


def in_mujoco(scene: Scene) -> Running:
    pytest.importorskip("mujoco")
    from tests.bench.peers.mujoco_scene import Mujoco, Settings

    return Mujoco().build(scene)(Settings())


def in_pybullet(scene: Scene) -> Running:
    pytest.importorskip("pybullet")
    from tests.bench.peers.pybullet_scene import Pybullet, Settings

    return Pybullet().build(scene)(Settings())


@names
def test_a_scene_goes_as_it_must(name: str) -> None:
    scene = BY_NAME[name]
    running = InUrdfkit(scene)
    checks = scene.check(running)
    assert checks
    assert [check for check in checks if not check.ok] == []
    # And again from there, as it is looked at after it was measured.
    assert all(check.ok for check in scene.check(running))


def test_names_are_unique_and_every_target_is_of_a_peer() -> None:
    assert len(BY_NAME) == len(SCENES)
    assert {peer for scene in SCENES for peer in scene.targets} == {"mujoco", "pybullet"}


def test_a_robot_that_stands_still_is_found_out() -> None:
    assert wrong(changed("diff-drive", motors={})) == ["speed", "turning rate"]
    assert wrong(changed("skid-steer", motors={})) == ["turning rate"]
    assert "turning rate" in wrong(changed("ackermann", poses=()))


def test_a_robot_that_drives_backwards_is_found_out() -> None:
    motors = {
        joint: Motor(-motor.speed, motor.effort) for joint, motor in BY_NAME["diff-drive"].things[0].motors.items()
    }
    assert wrong(changed("diff-drive", motors=motors)) == ["speed", "turning rate"]


def test_one_robot_of_many_that_stands_still_is_found_out() -> None:
    scene = robots(3)
    still = replace(scene.things[1], motors={})
    assert wrong(replace(scene, things=(scene.things[0], still, scene.things[2]))) == ["speed", "turning rate"]


def test_an_arm_that_sags_is_found_out() -> None:
    weak = dict.fromkeys(BY_NAME["arm"].things[0].servos, Servo(2000.0, 60.0, 5.0))
    assert wrong(changed("arm", servos=weak)) == ["off the pose"]


def test_a_box_that_falls_is_found_out() -> None:
    scene = BY_NAME["stack-asleep"]
    aside = replace(scene.things[2], at=(0.15, 0.0, 0.5))
    assert wrong(replace(scene, things=(*scene.things[:2], aside, *scene.things[3:]))) == ["out of place"]


def test_a_value_that_is_no_number_is_wrong() -> None:
    assert not Check("speed", float("nan"), 1.0, 0.1, "m/s").ok
    assert not Check("speed", float("inf"), float("inf"), 0.1, "m/s").ok


@pytest.mark.parametrize(("speed", "rate"), [(0.5, 0.4), (0.5, -0.7), (0.3, 0.0), (-0.2, 0.3)])
def test_speed_and_turning_rate_are_those_of_the_arc(speed: float, rate: float) -> None:
    def pose(t: float) -> tuple[float, ...]:
        heading = 3.0 + rate * t  # passes ±π
        if rate:
            x, y = speed / rate * (sin(heading) - sin(3.0)), -speed / rate * (cos(heading) - cos(3.0))
        else:
            x, y = speed * t * cos(3.0), speed * t * sin(3.0)
        return x, y, 0.0, 0.0, 0.0, sin(0.5 * heading), cos(0.5 * heading)

    assert arc_motion(pose(0.0), pose(2.0)) == pytest.approx((speed, rate), abs=1e-12)


def test_skidding_wheels_turn_a_robot_where_friction_has_no_moment_left() -> None:
    rate = skid_rate(3.0, 0.08, 0.2, 0.2)
    slip = np.array([0.08 * 3.0 - rate * 0.2, -rate * 0.2])  # of the wheel at (0.2, -0.2)
    force = slip / np.linalg.norm(slip)
    assert 0.2 * force[1] + 0.2 * force[0] == pytest.approx(0.0, abs=1e-15)


def test_servos_rest_where_they_carry_the_weight() -> None:
    thing = BY_NAME["arm"].things[0]
    goal = dict.fromkeys(thing.servos, 0.0) | {"joint1": 0.5 * pi}  # stretched out forwards, all but the first link
    rest = resting_pose(thing, goal)
    # Six links of 1 kg and 0.2 m whose centres are 0.1 m from their hinges; the 1 cm aside turns down with the sag.
    moment = 9.81 * sum(0.2 * k + 0.1 for k in range(6))
    assert (rest["joint1"] - goal["joint1"]) * thing.servos["joint1"].stiffness == pytest.approx(moment, rel=0.02)


def test_knocks_come_to_and_fro() -> None:
    scene = BY_NAME["stack-awake"]
    running, felt = InUrdfkit(scene), list[float]()
    running.knock = lambda k, speed: felt.append(speed)  # type: ignore[method-assign]
    running.advance(4 * CALL)
    assert felt == [-scene.knock, scene.knock, -scene.knock, scene.knock]


def test_poses_take_turns_until_one_is_held() -> None:
    scene = BY_NAME["arm"]
    running, seen = InUrdfkit(scene), list[int]()
    running.set_targets = lambda k, number: seen.append(number)  # type: ignore[method-assign]
    running.advance(3 * CALL)
    running.hold(7)
    running.advance(5 * CALL)
    assert seen == [1, 2, 3, 7]
    running.swing()
    running.advance(2 * CALL)
    assert seen == [1, 2, 3, 7, 9, 10]


@pytest.mark.parametrize("name", ["diff-drive", "arm", "stack-awake"])
def test_many_steps_in_a_call_are_the_same_as_one_by_one(name: str) -> None:
    poses = []
    for at_once in (True, False):
        running = InUrdfkit(BY_NAME[name])
        running.advance(350, at_once=at_once)
        poses.append(running.base(0) if name != "arm" else tuple(running.position(0, f"joint{k}") for k in range(7)))
        assert running.steps == 350
    assert poses[0] == poses[1]


@pytest.mark.parametrize("peer", [in_mujoco, in_pybullet])
def test_many_steps_of_a_peer_are_the_same_as_one_by_one(peer: object) -> None:
    found = []
    for at_once in (True, False):
        running = peer(BY_NAME["diff-drive"])  # type: ignore[operator]
        running.advance(500, at_once=at_once)
        found.append(running.base(0))
        running.close()
    assert found[0][0] > 0.1
    assert found[0] == pytest.approx(found[1], abs=1e-9)


@pytest.mark.parametrize("name", ["diff-drive", "skid-steer", "ackermann", "arm", "mobile-manipulator"])
def test_mujoco_is_given_the_same_masses(name: str) -> None:
    mujoco = pytest.importorskip("mujoco")
    scene = BY_NAME[name]
    theirs, ours = in_mujoco(scene), InUrdfkit(scene)
    mujoco.mj_forward(theirs.model, theirs.state)  # type: ignore[attr-defined]
    M = np.zeros((theirs.model.nv, theirs.model.nv))  # type: ignore[attr-defined]
    for d in range(len(M)):
        mujoco.mj_mulM(theirs.model, theirs.state, M[d], np.eye(len(M))[d])  # type: ignore[attr-defined]
    # Joints come in another order: what does not depend on it is compared.
    assert np.linalg.eigvalsh(M) == pytest.approx(np.linalg.eigvalsh(ours.engine.mass_matrix()), rel=1e-9)
    assert theirs.model.opt.timestep == ours.engine.dt  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", ["diff-drive", "skid-steer", "ackermann", "mobile-manipulator", "stack-awake"])
def test_pybullet_is_given_the_same_masses_and_places(name: str) -> None:
    p = pytest.importorskip("pybullet")
    scene = BY_NAME[name]
    theirs, ours = in_pybullet(scene), InUrdfkit(scene)
    for k, body in enumerate(theirs._things):  # type: ignore[attr-defined]
        options = {"physicsClientId": theirs._world}  # type: ignore[attr-defined]
        masses = [p.getDynamicsInfo(body, j, **options)[0] for j in range(-1, p.getNumJoints(body, **options))]
        if not scene.loose:
            model = ours.engine.robots[k].kinematics.model
            assert sum(masses) == pytest.approx(sum(inertia.mass for inertia in model.inertias), rel=1e-9)
        assert theirs.base(k) == pytest.approx(ours.base(k), abs=1e-7)  # it computes places in single precision
    theirs.close()


def test_links_of_a_robot_do_not_touch_each_other_in_mujoco() -> None:
    pytest.importorskip("mujoco")
    running = in_mujoco(BY_NAME["mobile-manipulator"])
    running.advance(1000)
    names = [(running.model.geom(c.geom1).name, running.model.geom(c.geom2).name) for c in running.state.contact]  # type: ignore[attr-defined]
    assert names
    assert all("floor" in pair for pair in names)


def test_our_engine_tells_how_many_boxes_sleep() -> None:
    assert InUrdfkit(BY_NAME["stack-awake"]).asleep() == 0
    assert InUrdfkit(BY_NAME["diff-drive"]).asleep() is None
