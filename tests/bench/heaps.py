"""Random heaps in a tray: when they fall asleep, how deep bodies are in each other, and what a second of them costs.

    python tests/bench/heaps.py [--seeds 50] [--seconds 10] [--scene 30-boxes ...] [--worst]

Each scene drops boxes (or boxes, balls, cans on their side and upright), each turned at random, into a tray: once for
each seed. For each scene it prints how many heaps sleep within `IN_TIME` seconds and how many ever do, the time until
they do, the fastest body of heaps that are awake at the end, the deepest overlap at rest and the CPU time of a
simulated second from the start until the last body sleeps.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from urdfkit.description import load
from urdfkit.description.urdf.robot import Box, Cylinder, Geometry, Sphere
from urdfkit.kinematics import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine import Engine, Surface
from urdfkit.sim.engine.bodies import Body, Piece

IN_TIME = 6.0
"""How long a heap may take to fall asleep [s]."""
PROCESSES = 2
LEVEL = (0.0, 0.0, 0.0, 1.0)
ROBOT = '<robot name="post"><link name="post"/></robot>'
SIDE = 0.12
"""Of a box [m]; balls and cans are as wide."""


def piece(geometry: Geometry) -> Piece:
    """Return a collision shape with friction 1."""
    return Piece(Shape("collision", "body", "collision", geometry, np.eye(4)), Surface(1.0, 1.0))


def box(name: str, pose: tuple[float, ...]) -> Body:
    """Return a box of 1 kg."""
    return Body(name, pose, [piece(Box((SIDE,) * 3))], mass=1.0, inertia=np.eye(3) * SIDE**2 / 6.0)


def ball(name: str, pose: tuple[float, ...]) -> Body:
    """Return a ball of 1 kg."""
    radius = SIDE / 2.0
    return Body(name, pose, [piece(Sphere(radius))], mass=1.0, inertia=np.eye(3) * 0.4 * radius**2)


def can(name: str, pose: tuple[float, ...]) -> Body:
    """Return a can of half a kilogram."""
    radius, length, mass = SIDE / 2.0, SIDE, 0.5
    across = mass * (3.0 * radius**2 + length**2) / 12.0
    inertia = np.diag([across, across, mass * radius**2 / 2.0])
    return Body(name, pose, [piece(Cylinder(radius, length))], mass=mass, inertia=inertia)


@dataclass(frozen=True)
class Scene:
    """How many bodies of which kinds fall into a tray of which size."""

    count: int
    half: float
    makers: tuple[Callable[[str, tuple[float, ...]], Body], ...]


SCENES = {
    "30-boxes": Scene(30, 0.3, (box,)),
    "80-boxes": Scene(80, 0.4, (box,)),
    "200-boxes": Scene(200, 0.55, (box,)),
    "60-mixed": Scene(60, 0.4, (box, ball, can)),
}


def bodies_of(scene: Scene, seed: int) -> list[Body]:
    """Return the walls of the tray, and what is tumbled above it."""
    rng = np.random.default_rng(seed)
    at, long = scene.half + 0.025, 2.0 * scene.half + 0.1
    walls = [
        Body(
            f"wall{k}",
            (at * x, at * y, 1.0, *LEVEL),
            [piece(Box((0.05 if x else long, 0.05 if y else long, 4.0)))],
            static=True,
        )
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    side = int(2.0 * scene.half / 0.18)
    bodies = []
    for k in range(scene.count):
        row, column, layer = k % side - (side - 1) / 2.0, k // side % side - (side - 1) / 2.0, k // side**2
        turned = rng.normal(size=4)
        turned /= np.linalg.norm(turned)
        maker = scene.makers[k % len(scene.makers)]
        bodies.append(maker(f"b{k}", (0.18 * row, 0.18 * column, 0.15 + 0.21 * layer, *turned)))
    return [*walls, *bodies]


def world(scene: Scene, seed: int) -> Engine:
    """Return a heap about to fall."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "post.urdf"
        path.write_text(ROBOT)
        kinematics = Kinematics(load(path))
    return Engine(kinematics, [], bodies=bodies_of(scene, seed))


@dataclass(frozen=True)
class Outcome:
    """What became of a heap: when the last body fell asleep, see the module."""

    slept: float
    awake: int
    fastest: float
    depth: float
    cpu: float


def run(name: str, seed: int, seconds: float) -> Outcome:
    """Let a heap fall until all of it sleeps, or for so long."""
    engine = world(SCENES[name], seed)
    started, slept = time.process_time(), float("inf")
    while engine.t < seconds:
        engine.step(50)
        if all(body.asleep for body in engine.bodies.values()):
            slept = engine.t
            break
    cpu = (time.process_time() - started) / engine.t
    awake = [body for body in engine.bodies.values() if not body.asleep]
    fastest = max((float(np.abs(body.twist).max()) for body in awake), default=0.0)
    depth = max((contact.depth for contact in engine.contacts()), default=0.0)
    return Outcome(slept, len(awake), fastest, depth, cpu)


def report(name: str, outcomes: list[Outcome], worst: bool) -> None:
    """Print the row of a scene, and its slowest seeds."""
    slept = np.array([each.slept for each in outcomes])
    ever = slept[np.isfinite(slept)]
    times = f"{np.median(ever):5.2f} {ever.max():5.2f}" if len(ever) else "    -     -"
    cpu = [each.cpu for each in outcomes]
    print(
        f"{name:10s} {np.sum(slept <= IN_TIME):4d}/{len(slept):<4d} {len(ever):4d}/{len(slept):<4d} {times}"
        f" {max(each.fastest for each in outcomes) * 1e3:10.3f}"
        f" {max(each.depth for each in outcomes) * 1e6:9.1f} {np.median(cpu):7.3f} {max(cpu):7.3f}",
        flush=True,
    )
    if worst:
        for seed in np.argsort(-slept, kind="stable")[:8]:
            each = outcomes[seed]
            print(
                f"    seed {seed}: slept {each.slept:.2f}, awake {each.awake}, {each.fastest * 1e3:.3f} mm/s, "
                f"{each.depth * 1e6:.1f} um, {each.cpu:.3f}",
                flush=True,
            )


def main() -> None:
    """Run all seeds of the scenes in two processes and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seeds", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=10.0, help="how long a heap may take before it is given up")
    parser.add_argument("--scene", nargs="+", choices=list(SCENES), default=list(SCENES))
    parser.add_argument("--worst", action="store_true", help="list the eight slowest seeds of each scene")
    options = parser.parse_args()
    print("scene      in time   ever      sleep, median and max [s]   fastest [mm/s, mrad/s]  overlap [um]  CPU s/s")
    with ProcessPoolExecutor(PROCESSES) as pool:
        for name in options.scene:
            n = options.seeds
            report(name, list(pool.map(run, [name] * n, range(n), [options.seconds] * n)), options.worst)


if __name__ == "__main__":
    main()
