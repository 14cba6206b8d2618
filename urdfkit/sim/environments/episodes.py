"""Episodes of a task in all worlds of a batch."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.description import Robot
from urdfkit.errors import UsageError
from urdfkit.sim.batch.batch import Batch
from urdfkit.sim.batch.joint_control import finite_ranges

Task = Callable[[Batch], tuple[ArrayLike, ArrayLike, ArrayLike]]
"""Returns the observations of all worlds, shape (n, …), rewards and whether each episode ends, shape (n,)."""
Observation = NDArray[np.float32]


class Episodes:
    """Episodes of a task in all worlds of a batch.

    Args:
        model: see `Batch`.
        task: the task.
        n: number of worlds.
        action_period: duration of an action [s].
        time_limit: duration of an episode [s].
        options: other arguments of `Batch`.

    Raises:
        UrdfkitError: the robot cannot be simulated, or an argument is invalid.

    Attributes:
        batch: the worlds.
        observations: of the present state; shape (n, …).
        rewards: of the present state; shape (n,).
        terminated: whether the task ended, or the state is no longer finite; shape (n,).
        truncated: whether the time limit is reached; shape (n,).
    """

    def __init__(
        self,
        model: Robot | str | Path,
        task: Task,
        n: int,
        *,
        action_period: float = 0.02,
        time_limit: float = 20.0,
        **options: Any,
    ) -> None:
        if not callable(task):
            raise UsageError(f"the task is {task!r}; use a function that returns observations, rewards and ends")
        self.batch, self._task, self._time_limit = Batch(model, n, **options), task, float(time_limit)
        self._steps = max(1, round(action_period / self.batch.dt))
        self._low, self._high = finite_ranges(self.batch.control)
        self.read()

    def step(self, actions: ArrayLike) -> None:
        """Apply actions from -1 to 1, the least and the greatest action of each joint, for an action period."""
        share = 0.5 * (np.clip(np.asarray(actions, dtype=float), -1.0, 1.0) + 1.0)
        self.batch.step(self._low + share * (self._high - self._low), self._steps)
        self.read()

    def reset(self, worlds: NDArray[np.bool_] | None = None, *, seed: int | None = None) -> None:
        """Start new episodes."""
        self.batch.reset(worlds, seed=seed)
        self.read()

    def read(self) -> None:
        """Call the task.

        Raises:
            UsageError: the task returns arrays of a wrong shape.
        """
        n, batch = self.batch.n, self.batch
        observations, rewards, ends = self._task(batch)
        self.observations: Observation = np.array(observations, dtype=np.float32)
        self.rewards = np.array(rewards, dtype=float)
        self.terminated = np.array(ends, dtype=bool)
        found = self.observations.shape[:1], self.rewards.shape, self.terminated.shape
        if found != ((n,),) * 3:
            raise UsageError(
                f"the task returned observations of shape {self.observations.shape}, rewards of shape {found[1]} and "
                f"ends of shape {found[2]}; the first dimension of each must be the number of worlds, {n}"
            )
        if batch.diverged.any():
            self.terminated |= batch.diverged
            self.rewards[batch.diverged] = self.observations[batch.diverged] = 0.0
        self.truncated = batch.t >= self._time_limit - 0.5 * batch.dt
