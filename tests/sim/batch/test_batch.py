"""A batch: each world gives the bytes of a single simulation, with any number of worlds and threads."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sim.conftest import drive as drive_plugin
from urdfkit.errors import UnknownNameError, UsageError
from urdfkit.linear_algebra import Array
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.batch import Batch, Servo
from urdfkit.sim.engine import Engine
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.world.live_tuning import Tuning

BOXES = """<sdf version="1.9"><world name="boxes">
  <model name="floor"><static>true</static><link name="link"><collision name="floor"><geometry><plane/></geometry>
  </collision></link></model>
  <model name="box"><pose>0.6 0.05 0.1 0 0 0</pose><link name="link"><inertial><mass>0.5</mass><inertia><ixx>0.001</ixx>
    <iyy>0.001</iyy><izz>0.001</izz></inertia></inertial><collision name="box"><geometry><box><size>0.2 0.3 0.2</size>
    </box></geometry></collision></link></model>
</world></sdf>"""


def engine_of(simulator: Simulator) -> Engine:
    return simulator.world.builder.engine


def drive(motors: Motors, joint: str, action: float, mode: str | Servo) -> None:
    """Apply an action to a joint of a single simulation."""
    if isinstance(mode, Servo):
        motors.servo(joint, stiffness=mode.stiffness, damping=mode.damping, position=action)
    else:
        {"velocity": motors.drive, "position": motors.hold, "effort": motors.exert}[mode](joint, action)


def observed(batch: Batch) -> list[Array]:
    batch_arrays = (batch.positions, batch.velocities, batch.efforts, batch.base_pose, batch.base_twist)
    return [array.copy() for array in (*batch_arrays, batch.contact_forces())]


def assert_single(batch: Batch, world: int, single: Simulator) -> None:
    """Compare a world with a simulation, bit for bit."""
    state = single.state
    assert np.array_equal(batch.positions[world], [state.position(joint) for joint in batch.joints])
    assert np.array_equal(batch.velocities[world], [state.velocity(joint) for joint in batch.joints])
    assert np.array_equal(batch.base_pose[world], state.base_pose)
    if single.kinematics.floating_base:
        assert np.array_equal(batch.base_twist[world], state.v[:6])
    assert batch.t[world] == pytest.approx(engine_of(single).t, abs=1e-12)
    forces = np.zeros((len(batch.links), 3))
    for contact in state.contacts:
        for link, sign in ((contact.a, 1.0), (contact.b, -1.0)):
            if link in batch.links:
                forces[batch.links.index(link)] += sign * np.array(contact.force)
    assert np.allclose(batch.contact_forces()[world], forces, rtol=0, atol=1e-12)


CASES: dict[str, tuple[str, dict[str, Any], dict[str, str | Servo]]] = {
    "diff drive": ("simpleton", {}, {"left_wheel_joint": "velocity", "right_wheel_joint": "effort"}),
    "arm": ("seven_dof_arm", {"fixed_base": True}, {"shoulder_pan_joint": "position", "elbow_roll_joint": "effort",
                                                    "wrist_roll_joint": Servo(40.0, 3.0)}),
    "car": ("gem_e2", {"spawn": Spawn(x=1.0, yaw=0.4)}, {"left_steering_hinge_joint": "position",
                                                        "rear_left_wheel_joint": "velocity"}),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_each_world_gives_the_bytes_of_a_single_simulation(case: str) -> None:
    model, options, control = CASES[case]
    batch = Batch(model, 3, control=control, threads=2, **options)
    actions = np.array([[0.5 + 0.1 * world - 0.2 * k for k in range(len(control))] for world in range(3)])
    singles = [Simulator(model, **options) for _ in range(3)]
    for turn in range(4):
        batch.step(actions * (-1) ** turn, 50)
        for world, single in enumerate(singles):
            for k, (joint, mode) in enumerate(control.items()):
                drive(single.motors, joint, float(batch.actions[world, k]), mode)
            engine_of(single).step(50)
            single.state.advance(50)
            assert_single(batch, world, single)


@pytest.mark.slow
def test_worlds_with_other_bodies_give_the_bytes_of_a_single_simulation(tmp_path: Any) -> None:
    world = tmp_path / "boxes.sdf"
    world.write_text(BOXES)
    batch, single = Batch("simpleton", 5, world=world, threads=2), Simulator("simpleton", world=world)
    actions = np.linspace(4.0, 8.0, 10).reshape(5, 2)
    for joint, action in zip(batch.control.joints, actions[3], strict=True):
        single.motors.drive(joint, action)
    touched = 0
    for _ in range(30):
        batch.step(actions, 50)
        engine_of(single).step(50)
        single.state.advance(50)
        assert_single(batch, 3, single)
        touched += any("box" in (contact.a, contact.b) and "chassis" in (contact.a, contact.b)
                       for contact in single.state.contacts)  # fmt: skip
    assert touched > 3


def heap(count: int) -> str:
    """Return a world with boxes that fall on each other beside the robot."""
    _, _, model = BOXES.partition('  <model name="box">')
    box = '<model name="NAME">' + model.partition("</model>")[0] + "</model>"
    boxes = [
        box.replace("NAME", f"box{k}").replace("0.6 0.05 0.1", f"{0.8 + 0.03 * (k % 3)} {0.02 * k} {0.2 + 0.21 * k}")
        for k in range(count)
    ]
    return BOXES.partition('  <model name="box">')[0] + "".join(boxes) + "</world></sdf>"


@pytest.mark.parametrize("model", ["simpleton", "gem_e2", "heap"])
def test_no_step_reads_scratch_before_it_writes_it(model: str, tmp_path: Path) -> None:
    options: dict[str, Any] = {"spawn": Spawn(z=0.3, roll=0.4)}
    if model == "heap":
        (tmp_path / "heap.sdf").write_text(heap(8))
        model, options = "simpleton", {"world": tmp_path / "heap.sdf"}
    batches = [Batch(model, 2, threads=1, **options) for _ in range(2)]
    random = np.random.default_rng(2)
    for _ in range(100):
        actions = random.uniform(-1.0, 1.0, batches[0].actions.shape)
        for k, batch in enumerate(batches):
            if k:
                batch._memory.floats.scratch[:] = np.nan
                batch._memory.integers.scratch[:] = 1
            batch.step(actions, 10)
        for array, other in zip(*map(observed, batches), strict=True):
            assert array.tobytes() == other.tobytes()
    memories = [batch._memory for batch in batches]
    for name in ("s", "v", "memory", "last", "M"):
        assert memories[0][name].tobytes() == memories[1][name].tobytes()
    assert np.isfinite(batches[0].positions).all()


VARIED = {"chassis.mass": (0.5, 2.0), "left_wheel.mu": (0.1, 0.9), "gravity": (5.0, 12.0), "left_wheel_joint.effort":
          (0.05, 0.3), "right_wheel_joint.friction": (0.0, 0.02), "spawn.x": (-1.0, 1.0), "spawn.yaw": (-3.0, 3.0),
          "task.goal": lambda random: float(random.integers(5))}  # fmt: skip


def test_the_numbers_of_threads_and_worlds_change_no_byte() -> None:
    found = []
    for n, threads in ((1, 1), (9, 1), (9, 2), (9, 5), (4, 3)):
        batch = Batch("simpleton", n, vary=VARIED, threads=threads, seed=7)
        random = np.random.default_rng(1).uniform(-10, 10, (6, 9, 2))
        history = []
        for turn, actions in enumerate(random):
            batch.step(actions[:n], 40)
            batch.reset(np.arange(n) == turn)
            history.append(observed(batch))
        found.append((n, history, batch.parameters))
        batch.close()
    _, expected, parameters = found[1]
    for n, history, values in found:
        for moment, reference in zip(history, expected, strict=True):
            for array, other in zip(moment, reference, strict=True):
                assert array[:n].tobytes() == other[:n].tobytes()
        for name in VARIED:
            assert values[name].tobytes() == parameters[name][:n].tobytes()
    assert len({array.tobytes() for array in expected[0][3]}) == 9


def test_parameters_act_like_those_of_a_single_simulation() -> None:
    batch = Batch("simpleton", 3, vary=VARIED, threads=1, seed=3)
    batch.step([6.0, 4.0], 300)
    for world in range(3):
        value = {name: float(values[world]) for name, values in batch.parameters.items()}
        single = Simulator("simpleton", gravity=(0.0, 0.0, -value["gravity"]),
                           spawn=Spawn(x=value["spawn.x"], yaw=value["spawn.yaw"]))  # fmt: skip
        tuning = Tuning(single.world)
        tuning.set_mass("simpleton", value["chassis.mass"], link="chassis")
        tuning.set_mu("simpleton", value["left_wheel.mu"], link="left_wheel")
        engine_of(single).arrays["friction"][single.kinematics.velocity_index("right_wheel_joint")] = value[
            "right_wheel_joint.friction"
        ]
        single.motors.drive("left_wheel_joint", 6.0, value["left_wheel_joint.effort"])
        single.motors.drive("right_wheel_joint", 4.0)
        engine_of(single).step(300)
        single.state.advance(300)
        assert_single(batch, world, single)
        assert 0.01 < np.linalg.norm(batch.base_twist[world, :2]) < 1.0


def test_masses_of_fixed_links_and_start_positions_of_joints_vary() -> None:
    control: dict[str, str | Servo] = {"wrist_roll_joint": Servo(5.0, 0.1)}
    vary = {"wrist_roll_link.mass": (2.0, 2.0), "spawn.wrist_roll_joint": (0.3, 0.3), "wrist_roll_joint.kp": (9.0, 9.0)}
    batch = Batch("seven_dof_arm", 2, fixed_base=True, control=control, vary=vary, threads=1)
    assert batch.positions[:, batch.joints.index("wrist_roll_joint")].tolist() == [0.3, 0.3]
    batch.step([0.1], 100)
    single = Simulator("seven_dof_arm", fixed_base=True, spawn=Spawn(joints={"wrist_roll_joint": 0.3}))
    Tuning(single.world).set_mass("seven_dof_arm", 2.0, link="wrist_roll_link")
    single.motors.servo("wrist_roll_joint", stiffness=9.0, damping=0.1, position=0.1)
    engine_of(single).step(100)
    single.state.advance(100)
    assert_single(batch, 1, single)


def test_reset_restores_the_chosen_worlds_and_draws_their_parameters() -> None:
    vary = {"task.goal": (0.0, 1.0)}
    batch = Batch("simpleton", 4, threads=2, vary=vary, seed=1)
    start, goals = observed(batch), batch.parameters["task.goal"].copy()
    batch.step([5.0, 3.0], 200)
    moved, mask = observed(batch), np.array([True, False, True, False])
    batch.reset(mask)
    for array, before, after in zip(observed(batch)[:5], start, moved, strict=False):
        assert np.array_equal(array[mask], before[mask])
        assert np.array_equal(array[~mask], after[~mask])
    assert ((batch.parameters["task.goal"] == goals) == ~mask).all()
    assert batch.t.tolist() == [0.0, pytest.approx(0.2), 0.0, pytest.approx(0.2)]
    assert (batch.actions == np.where(mask[:, None], 0.0, [5.0, 3.0])).all()
    batch.step([5.0, 3.0], 200)
    assert np.array_equal(observed(batch)[3][mask], moved[3][mask])
    batch.reset(seed=1)
    assert np.array_equal(batch.parameters["task.goal"], goals)


def test_arrays_are_written_in_place() -> None:
    batch = Batch("simpleton", 2, threads=2)
    pose, forces, before = batch.base_pose, batch.contact_forces(), batch.base_pose.copy()
    batch.step([5.0, 5.0], 100)
    assert batch.base_pose is pose
    assert batch.contact_forces() is forces
    assert (pose[:, 0] > before[:, 0]).all()


@pytest.mark.parametrize("model", ["simpleton", "seven_dof_arm"])
def test_poses_of_links_are_those_of_a_single_simulation(model: str) -> None:
    options: dict[str, Any] = {"spawn": Spawn(x=0.3, y=-0.4, yaw=0.5), "fixed_base": model == "seven_dof_arm"}
    batch, other, single = (
        Batch(model, 2, threads=1, **options),
        Batch(model, 2, **options),
        Simulator(model, **options),
    )
    actions = np.full(len(batch.control.joints), 0.4)
    for _ in range(5):
        batch.step(actions, 40)
        poses = batch.link_poses()
    for joint, action, mode in zip(batch.control.joints, batch.actions[0], batch.control.modes, strict=True):
        drive(single.motors, joint, float(action), mode)
    engine_of(single).step(200)
    single.state.advance(200)
    assert np.array_equal(poses[1], single.link_poses())
    other.step(actions, 200)
    assert np.array_equal(other.positions, batch.positions)  # reading poses changes nothing
    assert batch.link_poses().base is poses.base


def test_a_world_that_diverges_stays_and_the_others_continue() -> None:
    batch = Batch("simpleton", 3, threads=2)
    batch._memory["v"][1, 2] = np.nan
    batch.step([5.0, 5.0], 100)
    assert batch.diverged.tolist() == [False, True, False]
    assert (batch.base_pose[[0, 2], 0] > 0.001).all()
    batch.reset(batch.diverged)
    batch.step([5.0, 5.0], 100)
    assert not batch.diverged.any()
    assert np.isfinite(batch.base_pose).all()


def test_the_default_control_is_that_of_joints_moved_by_plugins(write_rover: Callable[..., Path]) -> None:
    mast = """<link name="mast"><inertial><mass value="0.1"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0"
    izz="0.001"/></inertial></link><joint name="mast_joint" type="continuous"><parent link="base"/><child link="mast"/>
    <axis xyz="0 0 1"/></joint>"""
    batch = Batch(write_rover(drive_plugin("ros1") + mast), 1)
    assert set(batch.joints) == {"left_joint", "right_joint", "mast_joint"}
    assert batch.control.joints == ("left_joint", "right_joint")
    assert batch.control.modes == ("velocity", "velocity")
    without_plugin = Batch(write_rover(mast), 1)
    assert set(without_plugin.control.joints) == set(batch.joints)
    arm = Batch("seven_dof_arm", 1, fixed_base=True)
    assert arm.control.modes == ("position",) * len(arm.control.joints)
    assert arm.control.low[0] == -2.618


def test_actions_stay_within_the_limits_of_joints() -> None:
    batch = Batch("simpleton", 2, ranges={"left_wheel_joint": (-1.0, 2.0)})
    batch.step([[30.0, 30.0], [-30.0, -30.0]], 1)
    assert batch.actions.tolist() == [[2.0, 20.0], [-1.0, -20.0]]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"n": 0}, "invalid number of worlds 0"),
        ({"threads": 0}, "invalid number of threads 0"),
        ({"control": {"left_wheel_joint": "torque"}}, "unknown mode 'torque' of joint `left_wheel_joint`"),
        ({"ranges": {"left_wheel": (0, 1)}}, "no action; did you mean `left_wheel_joint`"),
        ({"ranges": {"left_wheel_joint": (1, 0)}}, r"range \(1, 0\) of `left_wheel_joint` is empty"),
        ({"vary": {"chassis.mass": 3}}, "`chassis.mass` varies by 3"),
        ({"vary": {"chassis.mass": (3, 2)}}, r"the interval of `chassis.mass` is 3 … 2"),
        ({"vary": {"chassis.mass": (0, 0)}}, "`chassis.mass` is 0 in world 0; it must be at least 1e-06"),
        ({"vary": {"chassis.weight": (1, 2)}}, "unknown parameter `chassis.weight`; use gravity"),
        ({"vary": {"left_wheel_joint.kp": (1, 2)}}, "joint `left_wheel_joint` has no such parameter"),
        ({"vary": {"camera_link_optical.mu": (1, 2)}}, "`camera_link_optical` has no collision shape"),
        ({"vary": {"gravity": lambda random: float("nan")}}, "`gravity` in world 0 is nan"),
        ({"fixed_base": True, "vary": {"spawn.x": (0, 1)}}, "`spawn.x` has no effect: the base"),
    ],
)
def test_invalid_arguments_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        Batch("simpleton", **{"n": 1, **options})


def test_unknown_names_and_wrong_actions_are_refused() -> None:
    with pytest.raises(UnknownNameError, match="did you mean `chassis`"):
        Batch("simpleton", 1, vary={"chasis.mass": (1, 2)})
    batch = Batch("simpleton", 2)
    with pytest.raises(UsageError, match=r"shape \(3,\); it must be \(2, 2\)"):
        batch.step([1.0, 2.0, 3.0])
    with pytest.raises(UsageError, match="the action of `right_wheel_joint` in world 1 is not finite"):
        batch.step([[0.0, 0.0], [0.0, np.inf]])
    with pytest.raises(UsageError, match="invalid number of steps `-1`"):
        batch.step(None, -1)
    with pytest.raises(UsageError, match=r"type int64 and shape \(2,\)"):
        batch.reset([0, 1])


def test_ranges_are_distances_to_static_bodies(tmp_path: Path) -> None:
    wall = """<model name="wall"><static>true</static><pose>3 0 1 0 0 0</pose><link name="link"><collision name="wall">
    <geometry><box><size>0.2 20 2</size></box></geometry></collision></link></model>"""
    world = tmp_path / "wall.sdf"
    world.write_text(BOXES.replace("</world>", f"{wall}</world>"))
    batch = Batch("simpleton", 3, world=world, vary={"spawn.x": (-1.0, 1.0), "spawn.yaw": (-0.5, 0.5)}, threads=1)
    batch.step(np.zeros(2), 10)
    angles = np.array([-0.2, 0.0, 0.3])
    rays = 2.0 * np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=1)
    chassis = pose_matrices(batch.link_poses()[:, batch.links.index("chassis")])
    assert np.ptp(np.arctan2(chassis[:, 1, 0], chassis[:, 0, 0])) > 0.1
    expected = (2.9 - chassis[:, 0, 3, None]) / np.einsum("nj,mj->nm", chassis[:, 0, :3], rays / 2.0)
    assert batch.ranges("chassis", rays) == pytest.approx(expected, abs=1e-9)
    assert (batch.ranges("chassis", [[-1.0, 0.0, 0.0]], far=7.0) == 7.0).all()
    down = batch.ranges("chassis", [[0.0, 0.0, -1.0]])[:, 0]
    assert down == pytest.approx(chassis[:, 2, 3] / chassis[:, 2, 2], abs=1e-9)
    with pytest.raises(UnknownNameError, match="no link `chasis`; did you mean `chassis`"):
        batch.ranges("chasis", rays)
    with pytest.raises(UsageError, match="a direction of a ray is zero"):
        batch.ranges("chassis", [[0.0, 0.0, 0.0]])
