"""Environments of Gymnasium: the library's own check, seeds, ends of episodes, and both kinds alike."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from urdfkit.errors import SimulationError, UsageError
from urdfkit.sim.batch import Batch

gymnasium = pytest.importorskip("gymnasium")

from urdfkit.sim.environments import ID  # noqa: E402

GOAL = {"task.x": (-1.0, 1.0), "task.y": (-1.0, 1.0), "spawn.yaw": (-3.0, 3.0)}


def goal(batch: Batch) -> tuple[Any, Any, Any]:
    """Return the position relative to the goal; the nearer, the better."""
    there = np.stack([batch.parameters["task.x"], batch.parameters["task.y"]], axis=1)
    error = there - batch.base_pose[:, :2]
    distance = np.linalg.norm(error, axis=1)
    return np.hstack([error, batch.base_pose[:, 5:], batch.velocities]), -distance, distance < 0.05


def height(batch: Batch) -> tuple[Any, Any, Any]:
    return batch.base_pose[:, 2:3], batch.t, batch.base_pose[:, 2] < -0.5


def make(**options: Any) -> Any:
    return gymnasium.make(ID, model="simpleton", task=goal, vary=GOAL, **options)


def make_vector(n: int, **options: Any) -> Any:
    return gymnasium.make_vec(ID, num_envs=n, model="simpleton", task=goal, vary=GOAL, **options)


@pytest.mark.filterwarnings("ignore:.*A Box observation space (minimum|maximum) value is")
def test_gymnasium_checks_the_environment() -> None:
    from gymnasium.utils.env_checker import check_env

    check_env(make().unwrapped, skip_render_check=False)


def test_a_seed_repeats_episodes() -> None:
    runs = []
    for _ in range(2):
        environment = make(time_limit=0.2)
        observations = [environment.reset(seed=3)[0]]
        observations += [environment.step(np.array([0.5, -0.2], np.float32))[0] for _ in range(5)]
        observations.append(environment.reset()[0])
        runs.append(np.stack(observations))
    assert np.array_equal(*runs)
    assert not np.array_equal(runs[0][0], runs[0][-1])
    assert not np.array_equal(make().reset()[0], make().reset()[0])


def test_an_episode_ends_at_its_time_limit_and_at_its_goal() -> None:
    environment = make(time_limit=0.1, action_period=0.02)
    environment.reset(seed=0)
    ends = [environment.step(environment.action_space.sample())[2:4] for _ in range(5)]
    assert ends == [(False, False)] * 4 + [(False, True)]
    falling = gymnasium.make(ID, model="simpleton", task=height, world="void", control={"left_wheel_joint": "effort"})
    falling.reset(seed=0)
    ends = [falling.step(np.zeros(1, np.float32))[2] for _ in range(20)]
    assert ends.index(True) == 15  # 0.5 m take 0.319 s


def test_actions_span_the_ranges_of_the_joints() -> None:
    environment = make(ranges={"left_wheel_joint": (-2.0, 6.0)})
    environment.reset(seed=0)
    for action, expected in ((-1.0, (-2.0, -20.0)), (0.0, (2.0, 0.0)), (1.0, (6.0, 20.0))):
        environment.step(np.full(2, action, np.float32))
        assert tuple(environment.unwrapped.batch.actions[0]) == pytest.approx(expected)


def test_a_vector_environment_starts_the_next_episode_in_the_same_step() -> None:
    environment = make_vector(4, time_limit=0.06)
    first, _ = environment.reset(seed=5)
    assert first.shape == (4, 6)
    actions = np.tile(np.array([0.4, -0.4], np.float32), (4, 1))
    for _ in range(2):
        observations, rewards, terminated, truncated, infos = environment.step(actions)
        assert not truncated.any()
        assert infos == {}
    before = observations
    observations, rewards, terminated, truncated, infos = environment.step(actions)
    assert truncated.all()
    assert infos["_final_obs"].all()
    assert not terminated.any()
    assert rewards == pytest.approx(-np.linalg.norm(infos["final_obs"][:, :2], axis=1), rel=1e-5)
    assert np.abs(infos["final_obs"] - before).max() < 1.0
    assert (environment.unwrapped.batch.t == 0.0).all()
    assert not (observations == first).all(axis=1).any()
    environment.close()


def test_one_world_of_a_vector_environment_is_the_single_environment() -> None:
    single, many = make(), make_vector(1)
    observations = [single.reset(seed=9)[0], many.reset(seed=9)[0][0]]
    assert np.array_equal(*observations)
    action = np.array([0.3, 0.1], np.float32)
    for _ in range(10):
        assert np.array_equal(single.step(action)[0], many.step(action[None])[0][0])
    many.close()


def test_a_world_that_diverges_ends_its_episode_with_finite_observations() -> None:
    environment = make_vector(2)
    environment.reset(seed=0)
    environment.unwrapped.batch.parameters["task.x"][:] = 5.0
    memory = environment.unwrapped.batch._memory
    memory["v"][1, 0] = np.nan
    _, rewards, terminated, _, infos = environment.step(np.zeros((2, 2), np.float32))
    assert terminated.tolist() == [False, True]
    assert rewards[1] == 0.0
    assert np.isfinite(infos["final_obs"]).all()
    environment.close()


@pytest.mark.parametrize("ranges", [(-1.0, np.inf), (-np.inf, 1.0)])
def test_a_joint_without_a_limit_on_one_side_needs_a_range(ranges: tuple[float, float]) -> None:
    with pytest.raises(SimulationError, match="joint `left_wheel_joint` has no limit for its action; use ranges="):
        make(ranges={"left_wheel_joint": ranges})


def test_wrong_tasks_are_refused() -> None:
    with pytest.raises(UsageError, match="the task is None"):
        gymnasium.make(ID, model="simpleton", task=None)
    with pytest.raises(UsageError, match=r"rewards of shape \(2,\).*number of worlds, 1"):
        gymnasium.make(ID, model="simpleton", task=lambda batch: (batch.positions, [0.0, 1.0], [False]))
