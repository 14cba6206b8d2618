"""Parameters of the worlds of a batch that are drawn at random: masses, friction, gains, gravity, start poses."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import UnknownNameError, UsageError
from urdfkit.kinematics.pinocchio_model import spatial_inertia
from urdfkit.sim.batch.joint_control import SERVO_LIMIT
from urdfkit.sim.batch.world_memory import WorldMemory
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.layout.tree_arrays import UPPER
from urdfkit.sim.engine.state_conversion import set_configuration
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.arguments import nearest
from urdfkit.sim.world.live_tuning import LEAST_MASS, Tuned, Tuning

Distribution = tuple[float, float] | Callable[[np.random.Generator], float]
"""Interval of a uniform distribution, or a function that draws a number."""
Setter = Callable[[int, float], None]
"""Sets a parameter of a world: its number, and the value."""

GAINS, RESISTANCES = ("kp", "kd"), ("damping", "friction")
"""Parameters of joints with a servo, and of all joints: arrays of the engine."""
JOINT_PARAMETERS = ("effort", *GAINS, *RESISTANCES)
POSE = ("x", "y", "z", "roll", "pitch", "yaw")
TASK, SPAWN, GRAVITY = "task", "spawn", "gravity"


class RandomParameters:
    """Parameters that are drawn for each world and in each reset.

    Each world has its own random numbers, which depend on the seed and its number alone.

    Args:
        simulator: the simulation that is copied.
        memory: memory of the worlds.
        vary: name → distribution.
        limits: joint → array of the engine with its effort limit, for the joints with actions.
        seed: seed of the random numbers.

    Raises:
        UsageError: a name or distribution is invalid.
        UnknownNameError: a link or joint is unknown.

    Attributes:
        values: name → value in each world; arrays of shape (n,).
    """

    def __init__(
        self,
        simulator: Simulator,
        memory: WorldMemory,
        vary: Mapping[str, Distribution],
        limits: Mapping[str, str | None],
        seed: int,
    ) -> None:
        self._simulator, self._memory, self._limits = simulator, memory, limits
        self._n = len(memory.advance)
        self._distributions = {name: _distribution(name, each) for name, each in vary.items()}
        self.values = {name: np.zeros(self._n) for name in vary}
        self._robot = simulator.world.builder.robot_list[0]
        self._links = {each.name: each for each in Tuning(simulator.world).links(simulator.name)}
        self._masses: dict[str, Tuned] = {}
        self._poses: list[str] = []
        self._setters = {name: self._setter(name) for name in vary}
        self.seed(seed)

    def seed(self, seed: int) -> None:
        """Restart the random numbers of all worlds."""
        self._random = [np.random.default_rng((seed, world)) for world in range(self._n)]

    def draw(self, worlds: NDArray[np.int64]) -> None:
        """Draw new values for some worlds, which are in their initial state, and apply them."""
        if not self._setters:
            return
        for world in worlds.tolist():
            random = self._random[world]
            for name, draw in self._distributions.items():
                value = draw(random)
                if not isfinite(value):
                    raise UsageError(f"the value of `{name}` in world {world} is {value}; it must be finite")
                self.values[name][world] = value
                self._setters[name](world, value)
            if self._masses:
                self._set_masses(world)
            if self._poses:
                self._set_start(world)

    def _setter(self, name: str) -> Setter:
        """Return the function that sets a parameter, or only checks it if it is set together with others."""
        subject, _, kind = name.rpartition(".")
        memory = self._memory
        if name == GRAVITY:
            return self._set_gravity
        if subject == TASK:
            return _nothing
        if subject == SPAWN:
            return self._spawn_setter(kind)
        if kind == "mass":
            link = self._link(subject)
            if link.mass is None:
                raise UsageError(f"the mass of link `{subject}` has no effect in this simulation")
            self._masses[name] = link
            return _positive(name, LEAST_MASS, _nothing)
        if kind == "mu":
            if self._link(subject).mu is None:
                raise UsageError(f"link `{subject}` has no collision shape, so its friction has no effect")
            return _positive(name, 0.0, self._friction_setter(subject))
        index = self._simulator.kinematics.velocity_index(subject) if kind in JOINT_PARAMETERS else 0
        field = self._limits.get(subject) if kind == "effort" else kind
        if kind not in JOINT_PARAMETERS or (kind in GAINS and self._limits.get(subject) != SERVO_LIMIT) or not field:
            names = [GRAVITY, "spawn.x", "spawn.yaw", "LINK.mass", "LINK.mu", "task.NAME"]
            names += [f"JOINT.{each}" for each in JOINT_PARAMETERS]
            why = f"joint `{subject}` has no such parameter" if kind in JOINT_PARAMETERS else f"use {', '.join(names)}"
            raise UsageError(f"unknown parameter `{name}`; {why}")
        values = memory[field]

        def set_gain(world: int, value: float) -> None:
            values[world, index] = value

        return _positive(name, 0.0, set_gain)

    def _link(self, name: str) -> Tuned:
        if name not in self._links:
            raise UnknownNameError(f"no link `{name}` in robot `{self._robot.name}`{nearest(name, self._links)}")
        return self._links[name]

    def _spawn_setter(self, name: str) -> Setter:
        kinematics = self._robot.kinematics
        if name in POSE and not kinematics.floating_base:
            raise UsageError(f"`spawn.{name}` has no effect: the base of robot `{self._robot.name}` is fixed")
        if name not in POSE:
            kinematics.velocity_index(name)
        self._poses.append(name)
        return _nothing

    def _set_gravity(self, world: int, value: float) -> None:
        for name in ("gravity", "gravity_last_step"):
            self._memory[name][world] = 0.0, 0.0, -value

    def _friction_setter(self, link: str) -> Setter:
        engine, memory = self._simulator.world.builder.engine, self._memory
        shapes = [k for k, each in enumerate(engine.collision_shapes) if each.link == link and each.owner == 0]
        surface = self._robot.surfaces.get(link, Surface())
        # Wheels with rollers keep the ratio of their coefficients.
        scale = surface.mu2 / surface.mu1 if surface.mu1 > 0 and surface.fdir1 is not None else 1.0
        ground = 100.0 if engine.ground is None else engine.ground.mu
        fields = [memory[name] for name in ("shape_mu", "shape_mu2", "floor_mu", "floor_mu2")]

        def set_friction(world: int, mu: float) -> None:
            values = mu, mu * scale, min(mu, ground), min(mu * scale, ground)
            for field, value in zip(fields, values, strict=True):
                field[world, shapes] = value

        return set_friction

    def _set_masses(self, world: int) -> None:
        """Set the inertia of all bodies with links of varied mass; inertia changes in proportion to the mass."""
        kinematics, changed = self._robot.kinematics, dict[int, Any]()
        for name, link in self._masses.items():
            frame = kinematics.model.frames[kinematics.frame(link.name)]
            own = spatial_inertia(self._robot.kinematics.robot.link_by_name[link.name])
            joint = frame.parentJoint
            # Dynamic parameters (mass, first and second moments) are additive.
            part = frame.placement.act(own).toDynamicParameters()
            part *= (self.values[name][world] - (link.mass or 0.0)) / own.mass
            before = changed.get(joint, kinematics.model.inertias[joint])
            changed[joint] = type(own).FromDynamicParameters(before.toDynamicParameters() + part)
        for joint, inertia in changed.items():
            self._memory["mass"][world, joint - 1] = inertia.mass
            self._memory["centre"][world, joint - 1] = inertia.lever
            self._memory["tensor"][world, joint - 1] = inertia.inertia[UPPER]

    def _set_start(self, world: int) -> None:
        """Set the start pose and the start positions of joints."""
        robot, builder = self._robot, self._simulator.world.builder
        drawn = {name: float(self.values[f"{SPAWN}.{name}"][world]) for name in self._poses}
        joints = {**robot.spawn.joints, **{name: value for name, value in drawn.items() if name not in POSE}}
        pose: dict[str, Any] = {name: value for name, value in drawn.items() if name in POSE}
        spawn: Spawn = replace(robot.spawn, **pose, joints=joints)
        ground = None if builder.ground is None else builder.ground.height
        base = spawn.place(robot.kinematics, robot.scene, ground)
        q, v = spawn.configuration(robot.kinematics, base)
        memory: Any = self._memory
        row: Any = {name: memory[name][world] for name in ("tree_body", "first_s", "s")}
        set_configuration(robot.kinematics.model, row, q)
        memory["v"][world, : len(v)] = v


def _distribution(name: str, value: Distribution) -> Callable[[np.random.Generator], float]:
    """Return a function that draws numbers.

    Raises:
        UsageError: the interval is invalid.
    """
    if callable(value):
        return lambda random: float(value(random))
    try:
        low, high = (float(bound) for bound in value)
    except (TypeError, ValueError):
        raise UsageError(f"`{name}` varies by {value!r}; use (low, high) or a function of a Generator") from None
    if not (isfinite(low) and isfinite(high) and low <= high):
        raise UsageError(f"the interval of `{name}` is {low:g} … {high:g}; it must be finite and not empty")
    return lambda random: float(random.uniform(low, high))


def _nothing(world: int, value: float) -> None:
    """Set nothing."""


def _positive(name: str, least: float, setter: Setter) -> Setter:
    """Return a setter that refuses values below the least one.

    Raises:
        UsageError: in calls with such a value.
    """

    def checked(world: int, value: float) -> None:
        if value < least:
            raise UsageError(f"`{name}` is {value:g} in world {world}; it must be at least {least:g}")
        setter(world, value)

    return checked
