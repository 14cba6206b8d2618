"""One step of the compiled engine next to one of the reference, from random states, for every robot we ship.

Run it: ``python tests/bench/agreement.py [ROBOT …] [--states 1000] [--world house] [--seed 0] [--json]``. In the air,
at the ground and on it, upright and not, at rest and in motion, with motors, servos and efforts. Exit code 1 where the
two differ by more than 1e-9.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.reference_engine import ENGINES
from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.kinematics import Kinematics
from urdfkit.resources import find_model, robot_names
from urdfkit.scene import MeshLoader, lowest_point, scene_of
from urdfkit.sim.construction.rigid_bodies import bodies_of_model
from urdfkit.sim.construction.surface_parameters import surfaces_of
from urdfkit.sim.engine import Body, Ground
from urdfkit.sim.state.quaternion import from_rpy

Array = NDArray[np.float64]

AGREED = 1e-9
"""How far velocities, relative to the fastest, and positions [m or rad] may be apart after a step."""
OVERLAP = 1e-3
"""How deep a robot may be in something at the start [m]: no state of a simulation is deeper."""
TRIES = 200
"""Draws until a robot without overlap is given up."""
TARGETS = (
    *("motor_velocity", "motor_effort", "applied", "position_target", "velocity_target", "kp", "kd", "servo_effort"),
)


@dataclass(frozen=True)
class Drawn:
    """One state: what is to be set before the step."""

    q: Array
    v: Array
    targets: Mapping[str, Array]


@dataclass
class Agreement:
    """How far apart the two engines are after a step.

    Attributes:
        robot: its name.
        states: how many.
        touching: of these, those with a contact.
        iterated: of these, those that needed the iterative solver.
        velocity: greatest difference of v over max(1, greatest |v|).
        position: greatest difference of q [m or rad].
        apart: states in which either is beyond `AGREED`.
    """

    robot: str
    states: int = 0
    touching: int = 0
    iterated: int = 0
    velocity: float = 0.0
    position: float = 0.0
    apart: tuple[int, ...] = ()


def bodies_of(name: str) -> tuple[Body, ...]:
    """Return the bodies of a world."""
    world, meshes = load_world(name), MeshLoader()
    ground = world.ground.name if world.ground is not None else None
    return tuple(
        body for model in world.models for body in bodies_of_model(model, meshes, is_ground=model.name == ground)
    )


class Pair:
    """A robot in both engines.

    Args:
        robot: its name, with xacro arguments.
        world: the world around it, free bodies and all; only the ground when None.
    """

    def __init__(self, robot: str, world: str | None = None) -> None:
        model = find_model(robot.split())
        self.robot = load(model.path, arguments=model.arguments)
        self.bolted = self.robot.roots()[0].name == "world"
        self.kinematics = Kinematics(self.robot, floating_base=not self.bolted)
        self.scene = scene_of(self.robot)
        bodies = () if world is None else bodies_of(world)
        self.engines = [
            engine(
                self.kinematics,
                self.scene.with_role("collision"),
                surfaces=surfaces_of(self.robot),
                ground=Ground(),
                bodies=bodies,
            )
            for engine in ENGINES
        ]
        self.reach = 4.0 if bodies else 0.0

    def draw(self, random: np.random.Generator) -> Drawn:
        """Return a state in which the robot is in nothing else."""
        for _ in range(TRIES):
            positions = {name: self._position(name, random) for name in self.kinematics.joint_names}
            q = self.kinematics.configuration(positions, base=None if self.bolted else self._base(positions, random))
            if self._is_apart(q):
                return self._drawn(q, positions, random)
        raise SystemExit(f"{self.robot.name}: no state without overlap in {TRIES} draws")

    def _drawn(self, q: Array, positions: Mapping[str, float], random: np.random.Generator) -> Drawn:
        kinematics = self.kinematics
        speeds = {name: random.normal() * random.choice((0.0, 0.1, 1.0, 10.0)) for name in kinematics.joint_names}
        twist = None if self.bolted else random.normal(size=6) * random.choice((0.0, 0.3, 1.0, 3.0))
        t = {name: np.zeros(kinematics.model.nv) for name in TARGETS}
        t["servo_effort"][:] = math.inf
        for name in kinematics.joint_names:
            i, most = kinematics.velocity_index(name), self._effort(name) * random.choice((0.01, 0.1, 1.0))
            what = random.integers(4)
            if what == 1:
                t["motor_velocity"][i], t["motor_effort"][i] = 5.0 * random.normal(), most
            elif what == 2:
                t["kp"][i], t["kd"][i] = 10.0 ** random.uniform(0, 4), 10.0 ** random.uniform(-1, 2)
                t["position_target"][i], t["velocity_target"][i] = positions[name] + random.normal(), random.normal()
                t["servo_effort"][i] = most
            if what == 3 or random.integers(3) == 0:
                t["applied"][i] = 5.0 * random.normal()
        return Drawn(q, kinematics.velocity(speeds, base=twist), t)

    def _position(self, joint: str, random: np.random.Generator) -> float:
        lower, upper = self.kinematics.limits(joint)
        return float(random.uniform(max(lower, -math.pi), min(upper, math.pi)))

    def _base(self, positions: Mapping[str, float], random: np.random.Generator) -> Array:
        """Return a pose of the root link: in the air any way round, near the ground, or standing on it."""
        tilt = random.choice((0.0, 0.02, 0.3, math.pi))
        height = (random.uniform(0.2, 2.0), 0.0, random.uniform(-OVERLAP, 2e-3), -1e-5 * abs(random.normal()))
        quaternion = from_rpy(*(random.uniform(-tilt, tilt, 2) * (1.0, 0.5)), random.uniform(-math.pi, math.pi))
        base = np.array([*random.uniform(-self.reach, self.reach, 2), 0.0, *quaternion])
        low = lowest_point(self.scene, self.kinematics.link_poses(self.kinematics.configuration(positions, base=base)))
        base[2] = height[random.integers(4)] - (low or 0.0)
        return base

    def _is_apart(self, q: Array) -> bool:
        engine = self.engines[0]
        for name in TARGETS:
            getattr(engine, name)[:] = math.inf if name == "servo_effort" else 0.0
        engine.reset(q)
        engine.step()
        return all(contact.depth <= OVERLAP + 1e-4 for contact in engine.contacts())

    def _effort(self, joint: str) -> float:
        limit = self.robot.joint_by_name[joint].limit
        return math.inf if limit is None or limit.effort is None else limit.effort

    def step(self, drawn: Drawn) -> tuple[float, float, bool, bool]:
        """Return how far apart velocities and positions are, and whether it touched and was iterated."""
        ends = []
        for engine in self.engines:
            for name, values in drawn.targets.items():
                getattr(engine, name)[:] = values
            engine.reset(drawn.q, drawn.v)
            engine.step()
            v = np.concatenate([engine.v, *(body.twist for body in engine.bodies.values())])
            q = np.concatenate([engine.q, *(body.pose for body in engine.bodies.values())])
            ends.append((v, q))
        (v, q), (v_reference, q_reference) = ends
        scale = max(1.0, float(np.abs(v).max()), float(np.abs(drawn.v).max()))
        own = [contact for contact in self.engines[0].contacts() if contact.a in self.kinematics.link_names]
        return (
            float(np.abs(v - v_reference).max()) / scale,
            float(np.abs(q - q_reference).max()),
            bool(own),
            bool(self.engines[0].iterated),
        )


def compare(robot: str, *, states: int, seed: int = 0, world: str | None = None) -> Agreement:
    """Step from `states` random states; the same seed draws the same ones."""
    pair = Pair(robot, world)
    found = Agreement(robot)
    for number in range(states):
        velocity, position, touching, iterated = pair.step(pair.draw(np.random.default_rng([seed, number])))
        found.states += 1
        found.touching += touching
        found.iterated += iterated
        found.velocity, found.position = max(found.velocity, velocity), max(found.position, position)
        if not (velocity <= AGREED and position <= AGREED):
            found.apart += (number,)
    return found


def main() -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="all when left out")
    parser.add_argument("--states", type=int, default=1000, help="of each robot (default: 1000)")
    parser.add_argument("--world", help="a world with bodies around them (default: the ground alone)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    arguments = parser.parse_args()
    results: list[dict[str, Any]] = []
    for robot in arguments.robots or robot_names():
        found = compare(robot, states=arguments.states, seed=arguments.seed, world=arguments.world)
        results.append(asdict(found))
        share = f"{found.touching / found.states:.0%} touching, {found.iterated} iterated"
        more = f"; apart in {len(found.apart)}: {', '.join(map(str, found.apart[:8]))}" if found.apart else ""
        print(
            f"{robot}: {found.states} states, {share}, v {found.velocity:.1e}, q {found.position:.1e}{more}",
            file=sys.stderr,
            flush=True,
        )
    if arguments.json:
        print(json.dumps(results, indent=1))
    return 1 if any(result["apart"] for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
