"""Vector environment of Gymnasium: a robot in many worlds."""

from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from urdfkit.description import Robot
from urdfkit.sim.environments.episodes import Episodes, Observation, Task
from urdfkit.sim.environments.robot_environment import spaces

Numbers = NDArray[np.float64]


class RobotVectorEnvironment(VectorEnv[Observation, NDArray[np.float32], Numbers]):
    """Environment with a robot in many worlds, see `RobotEnvironment`.

    An episode that ends is followed by a new one in the same call of `step`, which returns the first observation of the
    new episode. ``infos["final_obs"]`` has the last observations, ``infos["_final_obs"]`` the mask of ended episodes.

    Args:
        model: see `Batch`.
        task: function of a `Batch`, see `Task`.
        num_envs: number of worlds.
        render_mode: None; the environment renders no images.
        options: ``action_period`` and ``time_limit``, see `Episodes`, and arguments of `Batch`.

    Attributes:
        batch: the worlds.
    """

    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.SAME_STEP}  # noqa: RUF012  (annotated in gymnasium)

    def __init__(
        self, model: Robot | str | Path, task: Task, num_envs: int = 1, render_mode: str | None = None, **options: Any
    ) -> None:
        self.num_envs, self.render_mode = num_envs, render_mode
        self._episodes = Episodes(model, task, num_envs, **options)
        self.batch = self._episodes.batch
        self.single_observation_space, self.single_action_space = spaces(self._episodes)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start an episode in every world. The first one without a seed draws a seed."""
        is_first = self._np_random is None
        super().reset(seed=seed)
        if seed is None and is_first:
            seed = int(self.np_random.integers(2**31))
        self._episodes.reset(seed=seed)
        return self._episodes.observations, {}

    def step(self, actions: NDArray[np.float32]) -> tuple[Observation, Numbers, Any, Any, dict[str, Any]]:
        """Apply one action in each world for an action period."""
        now, infos = self._episodes, dict[str, Any]()
        now.step(actions)
        rewards, terminated, truncated = now.rewards, now.terminated, now.truncated
        done = terminated | truncated
        if done.any():
            infos = {"final_obs": now.observations, "_final_obs": done}
            now.reset(done)
        return now.observations, rewards, terminated, truncated, infos

    def close_extras(self, **kwargs: Any) -> None:
        """End the threads."""
        self.batch.close()
