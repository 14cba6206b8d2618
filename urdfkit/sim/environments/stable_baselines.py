"""Vector environment of Stable-Baselines3, which has its own interface of vector environments."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from urdfkit.description import Robot
from urdfkit.sim.environments.episodes import Task
from urdfkit.sim.environments.vector_environment import RobotVectorEnvironment


class RobotVecEnv(VecEnv):  # type: ignore[misc]
    """Vector environment of Stable-Baselines3 with a robot in many worlds.

    Args:
        model: see `RobotVectorEnvironment`.
        task: see `RobotVectorEnvironment`.
        num_envs: number of worlds.
        options: other arguments of `RobotVectorEnvironment`.
    """

    def __init__(self, model: Robot | str | Path, task: Task, num_envs: int, **options: Any) -> None:
        self._environment = own = RobotVectorEnvironment(model, task, num_envs, **options)
        super().__init__(num_envs, own.single_observation_space, own.single_action_space)

    def reset(self) -> Any:
        """Start an episode in every world, with the seed of `seed`."""
        observations, _ = self._environment.reset(seed=self._seeds[0])
        self._reset_seeds()
        return observations

    def step_async(self, actions: Any) -> None:
        """Store the actions of the next step."""
        self._actions = actions

    def step_wait(self) -> Any:
        """Apply the actions."""
        observations, rewards, terminated, truncated, found = self._environment.step(self._actions)
        done = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for world in np.flatnonzero(done).tolist():
            infos[world]["terminal_observation"] = found["final_obs"][world]
            infos[world]["TimeLimit.truncated"] = bool(truncated[world] and not terminated[world])
        return observations, rewards.astype(np.float32), done, infos

    def close(self) -> None:
        """End the threads."""
        self._environment.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute of the environment, once for each world."""
        return [getattr(self._environment, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Set an attribute of the environment."""
        setattr(self._environment, attr_name, value)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """Call a method of the environment once; return the result for each world."""
        result = getattr(self._environment, method_name)(*args, **kwargs)
        return [result for _ in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> Sequence[bool]:
        """Return that no world is wrapped."""
        return [False for _ in self._get_indices(indices)]
