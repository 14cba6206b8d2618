"""Environment of Gymnasium with one robot."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from urdfkit.description import Robot
from urdfkit.sim.environments.episodes import Episodes, Observation, Task


def spaces(episodes: Episodes) -> tuple[Any, Any]:
    """Return the spaces of the observations and the actions of one world."""
    observation = Box(-np.inf, np.inf, episodes.observations.shape[1:], np.float32)
    return observation, Box(-1.0, 1.0, (len(episodes.batch.control.joints),), np.float32)


class RobotEnvironment(gymnasium.Env[Observation, NDArray[np.float32]]):
    """Environment with one robot. An action from -1 to 1 is the least to the greatest action of a joint.

    Args:
        model: see `Batch`.
        task: function of a `Batch` with one world, see `Task`.
        render_mode: None; the environment renders no images.
        options: ``action_period`` and ``time_limit``, see `Episodes`, and arguments of `Batch`.

    Attributes:
        batch: the world.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012  (annotated in gymnasium)

    def __init__(self, model: Robot | str | Path, task: Task, render_mode: str | None = None, **options: Any) -> None:
        self.render_mode = render_mode
        self._episodes = Episodes(model, task, 1, **{"threads": 1, **options})
        self.batch = self._episodes.batch
        self.observation_space, self.action_space = spaces(self._episodes)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start an episode; parameters that vary are drawn again. The first one without a seed draws a seed."""
        is_first = self._np_random is None
        super().reset(seed=seed)
        if seed is None and is_first:
            seed = int(self.np_random.integers(2**31))
        self._episodes.reset(seed=seed)
        return self._episodes.observations[0], {}

    def step(self, action: NDArray[np.float32]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Apply an action for an action period."""
        now = self._episodes
        now.step(action)
        return now.observations[0], float(now.rewards[0]), bool(now.terminated[0]), bool(now.truncated[0]), {}
