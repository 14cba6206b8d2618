"""Towers and walls that are nudged: when they come to rest, and whether they stand.

    python tests/bench/towers.py [--seconds 10] [--nudge 0.02] [tower-24 ...]

A tower has 24 boxes, in the turned ones each layer is turned against the one below. A wall has eight rows of eight
bricks, every second row shifted by a quarter of a brick. After a second, the top layer gets the speed of `--nudge`.
Printed are when the last body sleeps, the greatest speed of any body in the last second, how far the worst body is
from its place at the end, and the CPU time of a step, as a mean and the worst of 50 steps.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np

from urdfkit.description import load
from urdfkit.description.urdf.robot import Box
from urdfkit.kinematics import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine import Engine, Surface
from urdfkit.sim.engine.bodies import Body, Piece

SIDE, LAYERS = 0.1, 24
BRICK = (0.2, 0.1, 0.1)
BLOCK = 50


def brick(name: str, size: tuple[float, float, float], x: float, z: float, yaw: float) -> Body:
    """Return a box of 1 kg with friction 1."""
    squares = np.array(size) ** 2 / 12.0
    pieces = [Piece(Shape("collision", "body", "collision", Box(size), np.eye(4)), Surface(1.0, 1.0))]
    pose = (x, 0.0, z, 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    return Body(name, pose, pieces, mass=1.0, inertia=np.diag(squares.sum() - squares))


def tower(turn: float) -> list[Body]:
    """Return a tower whose layers are turned by an angle [rad], one against the other."""
    size = (SIDE, SIDE, SIDE)
    return [brick(f"b{k}", size, 0.0, SIDE * (k + 0.5), k * turn) for k in range(LAYERS)]


def wall() -> list[Body]:
    """Return a wall of 8 x 8 bricks."""
    return [
        brick(f"b{8 * row + k}", BRICK, BRICK[0] * (k + 0.25 * (row % 2)), BRICK[2] * (row + 0.5), 0.0)
        for row in range(8)
        for k in range(8)
    ]


SCENES = {
    "tower-24": lambda: tower(0.0),
    "tower-24-turned-10": lambda: tower(math.radians(10.0)),
    "tower-24-turned-45": lambda: tower(math.radians(45.0)),
    "wall-8x8": wall,
}


def nudged(name: str, nudge: float) -> Engine:
    """Return a scene after a second, in which the top layer has just got a speed along x [m/s]."""
    bodies = SCENES[name]()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "post.urdf"
        path.write_text('<robot name="post"><link name="post"/></robot>')
        engine = Engine(Kinematics(load(path)), [], bodies=bodies)
    engine.step(1000)
    top = max(body.pose[2] for body in bodies)
    for body in bodies:
        if body.pose[2] > top - 0.01:
            engine.bodies[body.name].place(engine.bodies[body.name].pose, (nudge, 0.0, 0.0, 0.0, 0.0, 0.0))
    return engine


def displacement(name: str, engine: Engine) -> float:
    """Return how far the worst body is from its place [m]."""
    return max(float(np.linalg.norm(engine.bodies[b.name].pose[:3] - np.array(b.pose[:3]))) for b in SCENES[name]())


def run(name: str, seconds: float, nudge: float) -> str:
    """Return the line of a scene."""
    engine = nudged(name, nudge)
    slept, times, speeds = math.inf, [], []
    while engine.t < 1.0 + seconds:
        start = time.process_time()
        engine.step(BLOCK)
        times.append((time.process_time() - start) / BLOCK)
        speeds.append(max(float(np.abs(each.twist[:3]).max()) for each in engine.bodies.values()))
        if all(each.asleep for each in engine.bodies.values()):
            slept = engine.t - 1.0
            break
    off = displacement(name, engine)
    mean = float(np.mean(times))
    return (
        f"{name:20s} {slept:6.2f} {1e3 * max(speeds[-20:]):10.3f} {1e3 * off:10.3f} "
        f"{1e6 * mean:9.1f} {max(times) / mean:6.1f}"
    )


def main() -> None:
    """Measure the named scenes, or all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("scene", nargs="*", default=list(SCENES))
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--nudge", type=float, default=0.02, help="speed of the top layer after a second [m/s]")
    options = parser.parse_args()
    print("scene                asleep [s]  fastest [mm/s]  off [mm]  step [µs]  worst/mean")
    for name in options.scene:
        print(run(name, options.seconds, options.nudge), flush=True)


if __name__ == "__main__":
    main()
