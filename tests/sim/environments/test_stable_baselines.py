"""The vector environment of Stable-Baselines3: ends of episodes, and PPO on it."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3")

EXAMPLE = Path(__file__).parents[3] / "docs" / "tutorials" / "drive_to_goal.py"


def test_the_last_observation_of_an_episode_is_in_its_info() -> None:
    example = runpy.run_path(str(EXAMPLE))
    environment = example["RobotVecEnv"]("simpleton", example["drive_to_goal"], 3, time_limit=0.2,
                                         vary=example["VARY"], action_period=0.1)  # fmt: skip
    environment.seed(4)
    first = environment.reset()
    actions = np.full((3, 2), 0.5, np.float32)
    _, _, done, infos = environment.step(actions)
    assert not done.any()
    assert infos == [{}, {}, {}]
    observations, rewards, done, infos = environment.step(actions)
    assert done.all()
    assert [info["TimeLimit.truncated"] for info in infos] == [True] * 3
    last = np.stack([info["terminal_observation"] for info in infos])
    assert (last[:, 3] > 0.01).all()  # it drives
    assert (np.abs(observations[:, 3]) < 1e-6).all()  # and starts again at rest
    assert rewards.dtype == np.float32
    environment.seed(4)
    assert np.array_equal(environment.reset(), first)
    environment.close()


@pytest.mark.slow
def test_ppo_runs_on_it() -> None:
    from stable_baselines3 import PPO

    example = runpy.run_path(str(EXAMPLE))
    environment = example["RobotVecEnv"]("simpleton", example["drive_to_goal"], 4, **example["OPTIONS"])
    policy = PPO("MlpPolicy", environment, n_steps=8, batch_size=16, seed=0)
    before = policy.policy.state_dict()["action_net.weight"].clone()
    policy.learn(64)
    assert not np.array_equal(before, policy.policy.state_dict()["action_net.weight"])
    environment.close()
