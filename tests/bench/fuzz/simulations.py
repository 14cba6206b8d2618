"""Simulations of changed robots and worlds that really step, with commands, pushes, spawned models and resets."""

from __future__ import annotations

import random
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from tests.bench.fuzz.descriptions import description, world_file
from tests.bench.fuzz.seed_files import seeds
from urdfkit.errors import SimulationError, UrdfkitError

if TYPE_CHECKING:
    from urdfkit.sim.simulator import Simulator

STEPS = 100
"""Steps of a simulation."""
_SIMPLE = ("simpleton", "rrbot")
"""Robots in changed worlds."""
_FORCES = (0.0, 1.0, -50.0, 1e4, 1e-9)


@cache
def _is_robot(path: Path) -> bool:
    """Return whether an unchanged file is a whole robot with masses."""
    from urdfkit.description.loading import load_repaired

    try:
        return any(link.inertial is not None for link in load_repaired(path).links)
    except UrdfkitError:
        return False


def prepare_kernels() -> None:
    """Load the kernels, which are no part of a case."""
    from urdfkit.app.simulation.kernel_compilation import prepare_kernel, prepare_rays

    class Silent:
        def isatty(self) -> bool:
            return False

        def write(self, _: str) -> None: ...

        def flush(self) -> None: ...

    prepare_kernel(Silent())  # type: ignore[arg-type]
    prepare_kernel(Silent(), world=True)  # type: ignore[arg-type]
    prepare_rays(Silent())  # type: ignore[arg-type]


def sim(folder: Path, rng: random.Random) -> str:
    """Simulate a changed robot, or an unchanged one in a changed world."""
    import numpy as np

    from urdfkit.description.loading import load_repaired
    from urdfkit.description.sdf import load_world
    from urdfkit.sim import Simulator, Spawn

    if rng.random() < 0.3:
        robot = load_repaired(rng.choice(_SIMPLE))
        path, original = world_file(folder, rng)
        world = load_world(path, package_path=[original.parent])
    else:
        original = rng.choice([each for each in seeds(".urdf", ".xacro") if "lint" not in each.parts])
        while not _is_robot(original):
            original = rng.choice(seeds(".urdf", ".xacro"))
        robot = load_repaired(description(folder, rng, original, bytes_share=0.03), package_path=[original.parents[1]])
        world = load_world(rng.choice(("empty", "empty", "cylinders", "void")))
    simulator = Simulator(
        robot,
        world=world,
        dt=rng.choice((None, None, None, 0.01, 1e-4)),
        seed=rng.randrange(1000),
        spawn=rng.choice((None, None, Spawn(z=1.0), Spawn(x=3.0, roll=2.0, twist=(1.0, 0.0, 0.0, 0.0, 0.0, 9.0)))),
        gravity=rng.choice((None, None, None, (0.0, 0.0, 0.0), (9.0, 0.0, -900.0))),
        fixed_base=rng.random() < 0.1,
        ros_distro=rng.choice((None, None, "kinetic", "humble")),
        strict=rng.random() < 0.1,
        density=rng.choice((1000.0, 1000.0, 1e-3, 1e6)),
        note=_check_note,
    )
    try:
        simulator.step(STEPS // 2)
        for _ in range(rng.choice((0, 1, 3))):
            with suppress(UrdfkitError):
                rng.choice(ACTIONS)(simulator, rng)
            simulator.step(STEPS // 4)
        simulator.step(STEPS // 4)
    except SimulationError as error:
        if "diverged" not in str(error):
            raise
        return "diverged"
    poses = [*map(tuple, simulator.link_poses()), *simulator.world.body_poses().values()]
    assert np.isfinite(np.array(poses)).all(), "a pose is not finite"
    return "stepped"


def _check_note(text: str) -> None:
    assert "\n" not in text, f"a warning of several lines: {text}"
    assert "Traceback" not in text, text


def _command(simulator: Simulator, rng: random.Random) -> None:
    if simulator.command_topics:
        simulator.command((rng.choice((0.5, 1e6)), 0.0, 0.0), (0.0, 0.0, rng.uniform(-3, 3)))


def _hold(simulator: Simulator, rng: random.Random) -> None:
    joints = simulator.kinematics.joint_names
    if joints:
        simulator.motors.hold(rng.choice(joints), rng.choice((0.0, 0.5, -10.0, 1e6)))


def _push(simulator: Simulator, rng: random.Random) -> None:
    names = simulator.kinematics.link_names
    force, torque, at = ([rng.choice(_FORCES) for _ in range(3)] for _ in range(3))
    simulator.world.push(rng.choice(names), force, torque, at=at, for_seconds=rng.choice((None, 0.01)))


def _spawn(simulator: Simulator, rng: random.Random) -> None:
    model = rng.choice(("unit_box", "ball", "coke_can", "simpleton", "wall"))
    simulator.world.spawn(model, [rng.uniform(-1, 1), rng.uniform(-1, 1), rng.choice((0.0, 0.5, 2.0))])


def _place(simulator: Simulator, rng: random.Random) -> None:
    name = rng.choice(simulator.world.names)
    simulator.world.place(name, [0.0, 0.0, rng.choice((0.1, 5.0, -3.0)), rng.uniform(-3, 3)])


def _remove(simulator: Simulator, rng: random.Random) -> None:
    simulator.world.remove(rng.choice(simulator.world.names))


def _reset(simulator: Simulator, rng: random.Random) -> None:
    simulator.reset()


ACTIONS: tuple[Callable[[Simulator, random.Random], None], ...] = (
    _command,
    _hold,
    _push,
    _spawn,
    _place,
    _remove,
    _reset,
)
"""What a case does between steps; the simulator may refuse an action."""
