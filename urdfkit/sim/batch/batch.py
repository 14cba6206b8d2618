"""Batch: many worlds of one robot, advanced together."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.description import Robot
from urdfkit.errors import UnknownNameError, UsageError
from urdfkit.linear_algebra import Array
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.batch.joint_control import Control, JointControl
from urdfkit.sim.batch.observations import LinkForces, Observations
from urdfkit.sim.batch.parameters import Distribution, RandomParameters
from urdfkit.sim.batch.world_memory import WorldMemory
from urdfkit.sim.engine.simulation_memory import ADVANCE, LINK_POSES, STEPS, TERMS
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.arguments import nearest

if TYPE_CHECKING:
    from urdfkit.sim.batch.range_finder import RangeFinder

GROUPS_EACH = 4
"""Groups of worlds for each thread: a thread that finishes a group early advances another."""


class Batch:
    """Copies of one world with a robot, advanced together in several threads.

    Plugins do not run: actions set motors and servos of the engine, and observations are arrays of its state. A world
    gives the same bytes in a batch of any size, with any number of threads, and alone in a `Simulator`.

    Args:
        robot: see `Simulator`.
        n: number of worlds.
        control: joint → ``velocity``, ``position``, ``effort`` or a `Servo`, in the order of the actions. When None,
            the joints that the robot's plugins move, or all joints if they move none: continuous joints by velocity,
            others by position.
        ranges: joint → least and greatest action; the limits of the joint for other joints.
        vary: parameter → interval of a uniform distribution, or a function that draws a number from a
            `numpy.random.Generator`. Drawn for each world and in each reset. Parameters are ``gravity`` [m/s²]
            (downwards), ``spawn.x`` and other poses and joints of a `Spawn`, ``LINK.mass`` [kg], ``LINK.mu``,
            ``JOINT.kp``, ``JOINT.kd``, ``JOINT.effort``, ``JOINT.damping``, ``JOINT.friction``, and ``task.NAME`` for
            numbers that are for the caller only, such as goals.
        threads: number of threads; one for each processor core when None.
        seed: seed of the random numbers.
        options: other arguments of `Simulator`: ``world``, ``dt``, ``spawn``, ``gravity``, ``fixed_base``, …

    Raises:
        UrdfkitError: the robot or world cannot be simulated, or an argument is invalid.

    Attributes:
        n: number of worlds.
        simulator: the simulation that the worlds are copies of.
        dt: length of a step [s].
        control: control of the joints by the actions.
        parameters: name → value in each world, of the parameters that vary; arrays of shape (n,).
        actions: the last actions, within their ranges; shape (n, joints with actions).
        diverged: worlds whose state is no longer finite; they stay as they are until they are reset; shape (n,).

    Examples:
        >>> import numpy as np
        >>> from urdfkit.sim.batch import Batch
        >>> worlds = Batch("simpleton", 4, world="house", vary={"spawn.x": (0.0, 1.0)}, threads=1)
        >>> worlds.step(np.full((4, 2), 5.0), steps=1000)  # both wheels at 5 rad/s for a second
        >>> worlds.t
        array([1., 1., 1., 1.])
        >>> worlds.joints
        ('left_wheel_joint', 'right_wheel_joint')
        >>> worlds.velocities.round(2)[0]
        array([5., 5.])
        >>> worlds.positions.shape, worlds.efforts.shape, worlds.base_pose.shape
        ((4, 2), (4, 2), (4, 7))
        >>> worlds.base_twist[:, 0].round(1)  # forwards [m/s]
        array([0.5, 0.5, 0.5, 0.5])
        >>> worlds.reset(worlds.base_pose[:, 0] > 1.0)  # only worlds whose robot has passed x = 1 m
        >>> worlds.close()
    """

    def __init__(
        self,
        robot: Robot | str | Path,
        n: int,
        *,
        control: Control | None = None,
        ranges: Mapping[str, Sequence[float]] | None = None,
        vary: Mapping[str, Distribution] | None = None,
        threads: int | None = None,
        seed: int = 0,
        **options: Any,
    ) -> None:
        if not isinstance(n, int) or n < 1:
            raise UsageError(f"invalid number of worlds {n!r}; use an integer greater than zero")
        threads = _cores() if threads is None else threads
        if not isinstance(threads, int) or threads < 1:
            raise UsageError(f"invalid number of threads {threads!r}; use an integer greater than zero")
        self.n, self.simulator = n, Simulator(robot, seed=seed, **options)
        self.dt = self.simulator.dt
        engine = self.simulator.world.builder.engine
        self.control = JointControl(self.simulator, control, ranges)
        engine.evaluate()
        count = 1 if threads == 1 else min(n, threads * GROUPS_EACH)
        groups = np.arange(n) * count // n
        self._spans = [np.searchsorted(groups, [group, group + 1]).tolist() for group in range(count)]
        self._memory = memory = WorldMemory(engine.arrays, groups, engine.kernel)
        self._columns = np.array([memory.floats.column(name) + dof for name, dof in self.control.targets])
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None
        self._observations = Observations(self.simulator, memory)
        self._range_finder: RangeFinder | None = None
        self._contacts = LinkForces(self.simulator, memory)
        limits = dict(zip(self.control.joints, self.control.limits, strict=True))
        self._parameters = RandomParameters(self.simulator, memory, vary or {}, limits, seed)
        self.parameters = self._parameters.values
        self.actions = np.zeros((n, len(self.control.joints)))
        self.diverged = np.zeros(n, dtype=bool)
        self.reset()

    def __repr__(self) -> str:
        """Return the number of worlds, and the robot and world."""
        return f"<Batch of {self.n} × {self.simulator.name} in world {self.simulator.world.name}>"

    # Time

    def step(self, actions: ArrayLike | None = None, steps: int = 1) -> None:
        """Set the actions and advance all worlds; the observations are then those of the new state.

        Args:
            actions: one per joint of `control`, the same or others in each world; shape (n, joints) or a shape that
                broadcasts to it. When None, the previous ones stay.
            steps: number of steps of `dt`.

        Raises:
            UsageError: the shape is wrong, an action is not a number, or `steps` is not zero or greater.
        """
        if not isinstance(steps, int) or steps < 0:
            raise UsageError(f"invalid number of steps `{steps}`; use an integer, zero or greater")
        if actions is not None:
            self._act(actions)
        if self._pool is None:
            self._advance(steps, self._spans[0])
        else:
            for each in [self._pool.submit(self._advance, steps, span) for span in self._spans]:
                each.result()

    def reset(self, worlds: ArrayLike | None = None, *, seed: int | None = None) -> None:
        """Restore the initial state of worlds, and draw their parameters again.

        Args:
            worlds: mask of shape (n,); all worlds when None.
            seed: restart the random numbers of all worlds with this seed.

        Raises:
            UsageError: the mask has another shape or type.
        """
        if seed is not None:
            self._parameters.seed(seed)
        chosen = np.arange(self.n) if worlds is None else np.flatnonzero(self._mask(worlds))
        self._memory.restore(chosen)
        self.actions[chosen] = self._memory.floats.rows[np.ix_(chosen, self._columns)]
        self.diverged[chosen] = False
        self._parameters.draw(chosen)
        for world in chosen.tolist():
            self._memory.advance[world](1, TERMS)
            self._observations.read(world, world + 1)

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()

    def _act(self, actions: ArrayLike) -> None:
        targets = np.asarray(actions, dtype=float)
        try:
            targets = np.broadcast_to(targets, self.actions.shape)
        except ValueError:
            raise UsageError(f"the actions have the shape {targets.shape}; it must be {self.actions.shape}") from None
        if not np.isfinite(targets).all():
            world, joint = np.argwhere(~np.isfinite(targets))[0].tolist()
            raise UsageError(f"the action of `{self.control.joints[joint]}` in world {world} is not finite")
        self.actions[:] = self.control.clipped(targets)
        self._memory.floats.rows[:, self._columns] = self.actions

    def _advance(self, steps: int, span: Sequence[int]) -> None:
        """Advance some worlds and read their observations. Compiled code releases the lock of the interpreter."""
        first, beyond = span
        diverged = self.diverged
        for world, advance in enumerate(self._memory.advance[first:beyond], first):
            if not diverged[world] and advance(steps, ADVANCE) < steps:
                diverged[world] = True
        self._observations.read(first, beyond)

    def _mask(self, worlds: ArrayLike) -> NDArray[np.bool_]:
        mask = np.asarray(worlds)
        if mask.shape != (self.n,) or mask.dtype != bool:
            raise UsageError(f"the mask has type {mask.dtype} and shape {mask.shape}; it must be bool, ({self.n},)")
        return mask

    # Observations

    @property
    def t(self) -> Array:
        """Simulated time of each world since its reset [s]; shape (n,)."""
        return np.asarray(self._memory["counts"][:, STEPS] * self.dt)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints in the observations: those with one degree of freedom, without mimic joints."""
        return self._observations.joints

    @property
    def positions(self) -> Array:
        """Positions of `joints` [rad] or [m]; shape (n, joints). The same array after every step."""
        return self._observations.positions

    @property
    def velocities(self) -> Array:
        """Velocities of `joints` [rad/s] or [m/s]; shape (n, joints). The same array after every step."""
        return self._observations.velocities

    @property
    def efforts(self) -> Array:
        """Efforts of motors and servos in the last step [N·m] or [N]; shape (n, joints). The same array."""
        return self._observations.efforts

    @property
    def base_pose(self) -> Array:
        """Position [m] and quaternion x y z w of the root link; shape (n, 7). The same array after every step."""
        return self._observations.base_pose

    @property
    def base_twist(self) -> Array:
        """Twist of the root link in its own axes [m/s, rad/s], linear first; shape (n, 6). The same array."""
        return self._observations.base_twist

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links, in the order of `contact_forces` and `link_poses`.

        Examples:
            >>> from urdfkit.sim.batch import Batch
            >>> Batch("simpleton", 2, threads=1).links[:3]
            ('base_footprint', 'chassis', 'left_wheel')
        """
        return tuple(self.simulator.kinematics.link_names)

    def contact_forces(self) -> Array:
        """Return the sum of the contact forces on each link in the last step, in the world's axes [N].

        Returns:
            The same array in each call, overwritten; shape (n, links, 3).

        Examples:
            >>> from urdfkit.sim.batch import Batch
            >>> worlds = Batch("simpleton", 2, vary={"gravity": (9.0, 10.0)}, threads=1)
            >>> worlds.step(steps=1000)
            >>> worlds.contact_forces()[:, :, 2].sum(axis=1) / worlds.parameters["gravity"]  # mass of the robot [kg]
            array([1.55, 1.55])
        """
        return self._contacts.read()

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of each link in the world.

        Returns:
            The same array in each call, overwritten; shape (n, links, 7).

        Examples:
            >>> from urdfkit.sim.batch import Batch
            >>> worlds = Batch("simpleton", 2, threads=1)
            >>> worlds.link_poses()[:, worlds.links.index("left_wheel"), :3].round(3)
            array([[0.  , 0.21, 0.1 ],
                   [0.  , 0.21, 0.1 ]])
        """
        self._memory["read_s"][:] = self._memory["s"]
        for advance in self._memory.advance:
            advance(0, LINK_POSES)
        return self._memory["link_pose"][:, : len(self.links)]

    def ranges(self, link: str, directions: ArrayLike, far: float = inf) -> Array:
        """Return distances from a link to the collision shapes of static bodies, as a lidar; shape (n, rays).

        The rays do not hit the robot and bodies that move.

        Args:
            link: the link whose origin the rays start at.
            directions: of the rays, in the axes of the link; shape (rays, 3).
            far: result without a nearer hit [m].

        Raises:
            UnknownNameError: no such link.
            UsageError: a direction is zero or not finite.

        Examples:
            >>> from urdfkit.sim.batch import Batch
            >>> worlds = Batch("simpleton", 2, world="house", threads=1)
            >>> worlds.ranges("chassis", [[1, 0, 0], [0, 1, 0]], far=10.0).round(2)  # to the front and to the left
            array([[4.92, 0.82],
                   [4.92, 0.82]])
        """
        if self._range_finder is None:
            from urdfkit.sim.batch.range_finder import RangeFinder  # imports numba

            self._range_finder = RangeFinder(self.simulator)
        if link not in self.links:
            raise UnknownNameError(f"no link `{link}`{nearest(link, self.links)}")
        poses = self.link_poses()[:, self.links.index(link)]
        return self._range_finder.measure(pose_matrices(poses), directions, far)


def _cores() -> int:
    """Return the number of processor cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
