"""Live parameters of a running simulation: friction, masses, gravity, controller gains.

Only the simulation changes; the description does not. A change of mass or friction builds the engine again and
transfers its state, as for a spawned entity. Changes persist after a reset.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

from urdfkit.description.sdf import World, WorldModel
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.kinematics.pinocchio_model import spatial_inertia
from urdfkit.sim.construction.loading import valid_gravity
from urdfkit.sim.engine import Surface
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.state.arguments import nearest, number
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.world.live_world import LiveWorld
from urdfkit.sim.world.simulated_robot import SimulatedRobot

LEAST_MASS = 1e-6
"""Minimum mass [kg]."""


@dataclass(frozen=True, slots=True)
class Tuned:
    """Live parameters of a link or a model.

    Attributes:
        name: name of the link or model.
        mass: mass [kg]; None if it has no effect or cannot be changed.
        mu: smaller friction coefficient; None without contacts.
    """

    name: str
    mass: float | None
    mu: float | None


class Tuning:
    """Live parameters of a simulation.

    Args:
        world: the world of the simulation.
    """

    def __init__(self, world: LiveWorld) -> None:
        self._world = world
        self._masses: dict[tuple[int, str], float] = {}

    # Gravity

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Gravity [m/s²]."""
        x, y, z = self._world.description.gravity
        return x, y, z

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Change gravity [m/s²]; sleeping bodies wake.

        Raises:
            SimulationError: the vector is invalid, see `valid_gravity`.
        """
        x, y, z = valid_gravity(gravity)
        builder = self._world.builder
        builder.description = replace(builder.description, gravity=(x, y, z))
        builder.engine.arrays["gravity"][:] = x, y, z

    # Links and models

    def links(self, robot: str) -> tuple[Tuned, ...]:
        """Return the parameters of a robot's links.

        Raises:
            SimulationError: unknown robot.
        """
        found = self._world.robots[robot]
        touches = {shape.body for shape in found.shapes}
        return tuple(
            Tuned(
                link.name,
                self._mass(found, link.name)
                if _moves(found, link.name) and link.name not in found.weightless
                else None,
                found.surfaces.get(link.name, Surface()).mu if link.name in touches else None,
            )
            for link in found.robot.links
        )

    @property
    def models(self) -> tuple[Tuned, ...]:
        """Parameters of the world's models."""
        builder = self._world.builder
        found = []
        for model in builder.description.models:
            links = [link for _, _, link in model.all_links()]
            touching = [shape.surface.mu for link in links for shape in link.collisions]
            heavy = not model.static and not builder.entity(model.name).robots
            mass = sum(link.inertial.mass for link in links) if heavy else None
            found.append(Tuned(model.name, mass, min(touching, default=None)))
        return tuple(found)

    def set_mass(self, name: str, mass: float, link: str = "") -> None:
        """Change the mass of a robot's link or of a model; inertia changes in proportion.

        Args:
            name: name of the robot or model.
            mass: mass [kg].
            link: link of the robot; empty for a model.

        Raises:
            SimulationError: unknown name, the mass has no effect, or the value is invalid.
        """
        mass = number(mass, "the mass", "kg")
        if not (isfinite(mass) and mass >= LEAST_MASS):
            raise SimulationError(f"a mass of {mass:g} kg cannot be simulated; it must be at least {LEAST_MASS:g} kg")
        if not link:
            factor = mass / self._existing(self._model(name).mass, f"the mass of `{name}`")
            self._change(name, lambda model: _heavier(model, factor))
            return
        robot = self._world.robots[name]
        before = self._existing(self._link(name, link).mass, f"the mass of link `{link}`")
        model, own = robot.kinematics.model, spatial_inertia(robot.robot.link_by_name[link])
        frame = model.frames[robot.kinematics.frame(link)]
        # Dynamic parameters (mass, first and second moments) are additive; see Pinocchio's FromDynamicParameters.
        part = frame.placement.act(own).toDynamicParameters() * ((mass - before) / own.mass)
        joint = frame.parentJoint
        model.inertias[joint] = type(own).FromDynamicParameters(model.inertias[joint].toDynamicParameters() + part)
        self._masses[id(robot), link] = mass
        self._world.builder.rebuild()

    def set_mu(self, name: str, mu: float, link: str = "") -> None:
        """Change the friction of a robot's link or of a model, in all directions.

        Args:
            name: name of the robot or model.
            mu: friction coefficient.
            link: link of the robot; empty for a model.

        Raises:
            SimulationError: unknown name, no contacts, or the coefficient is negative or not finite.
        """
        mu = number(mu, "the friction coefficient", "")
        if not (isfinite(mu) and mu >= 0):
            raise SimulationError(f"the friction coefficient is {mu:g}; it must be finite and not negative")
        if not link:
            self._existing(self._model(name).mu, f"the friction of `{name}`")
            self._change(name, lambda model: _rougher(model, mu))
            return
        self._existing(self._link(name, link).mu, f"the friction of link `{link}`")
        robot = self._world.robots[name]
        surface = robot.surfaces.get(link, Surface())
        # Wheels with rollers keep the ratio of their coefficients.
        scale = surface.mu2 / surface.mu1 if surface.mu1 > 0 and surface.fdir1 is not None else 1.0
        robot.surfaces = {**robot.surfaces, link: replace(surface, mu1=mu, mu2=mu * scale)}
        self._world.builder.rebuild()

    # Gains

    @property
    def gains(self) -> dict[str, Gains]:
        """``ROBOT/CONTROLLER/JOINT`` → gains, for every loaded controller with gains."""
        return {path: joint_pids[0].gains for path, joint_pids in self._joint_pids().items()}

    def set_gains(self, path: str, gains: Gains) -> None:
        """Change the gains of a controller for one of its joints; its integral is reset.

        Raises:
            SimulationError: unknown path, or a gain is invalid.
        """
        joint_pids = self._joint_pids()
        if path not in joint_pids:
            raise UnknownNameError(f"no gains `{path}`{nearest(path, joint_pids)}")
        for letter, gain in (("p", gains.p), ("i", gains.i), ("d", gains.d)):
            if not (isfinite(gain) and gain >= 0):
                raise SimulationError(f"gain `{letter}` is {gain:g}; it must be finite and not negative")
        for joint_pid in joint_pids[path]:
            joint_pid.gains = joint_pid.integral.gains = gains
            joint_pid.integral.reset()
        for robot in self._world.robots.values():
            for controller in robot.plugins.controllers:
                controller.wake()
        self._world.scheduler.invalidate()

    def _joint_pids(self) -> dict[str, list[JointPid]]:
        found: dict[str, list[JointPid]] = {}
        for robot in self._world.robots.values():
            for controller in robot.plugins.controllers:
                for path, joint_pid in controller.joint_pids():
                    found.setdefault(f"{robot.name}/{path}", []).append(joint_pid)
        return found

    def _mass(self, robot: SimulatedRobot, link: str) -> float | None:
        written = robot.robot.link_by_name[link].inertial
        if written is None or not written.mass:
            return None
        return self._masses.get((id(robot), link), written.mass)

    def _link(self, robot: str, link: str) -> Tuned:
        found = {each.name: each for each in self.links(robot)}
        if link not in found:
            raise UnknownNameError(f"no link `{link}` in robot `{robot}`{nearest(link, found)}")
        return found[link]

    def _model(self, name: str) -> Tuned:
        found = {each.name: each for each in self.models}
        if name not in found:
            raise UnknownNameError(f"no model `{name}` in the world{nearest(name, found)}")
        return found[name]

    def _existing(self, value: float | None, what: str) -> float:
        if value is None:
            raise SimulationError(f"{what} has no effect in this simulation, or cannot be changed while it runs")
        return value

    def _change(self, name: str, change: Any) -> None:
        """Replace the description of a model by `change(model)`."""
        builder = self._world.builder
        entity = builder.entity(name)
        if entity.robots:
            raise SimulationError(f"`{name}` has movable joints and cannot be changed while it runs")
        description: World = builder.description
        changed = {model.name: change(model) for model in description.models if model.name == name}
        builder.description = replace(
            description, models=tuple(changed.get(model.name, model) for model in description.models)
        )
        entity.source = changed[name]
        builder.rebuild()


def _moves(robot: SimulatedRobot, link: str) -> bool:
    frame = robot.kinematics.model.frames[robot.kinematics.frame(link)]
    return bool(frame.parentJoint != 0)


def _heavier(model: WorldModel, factor: float) -> WorldModel:
    links = []
    for link in model.links:
        own = link.inertial
        grown = {name: getattr(own, name) * factor for name in ("mass", "ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
        links.append(replace(link, inertial=replace(own, **grown)))
    return replace(model, links=tuple(links), models=tuple(_heavier(inner, factor) for inner in model.models))


def _rougher(model: WorldModel, mu: float) -> WorldModel:
    links = []
    for link in model.links:
        collisions = (replace(each, surface=replace(each.surface, mu=mu, mu2=mu)) for each in link.collisions)
        links.append(replace(link, collisions=tuple(collisions)))
    return replace(model, links=tuple(links), models=tuple(_rougher(inner, mu) for inner in model.models))
