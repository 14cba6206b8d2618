"""Bodies and robots for tests of worlds."""

from __future__ import annotations

import numpy as np

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.scene import Shape, scene_of
from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.bodies import Body, Member, Piece

LEVEL = (0.0, 0.0, 0.0, 1.0)
SMOOTH = {"base": Surface(0.0, 0.0)}


def piece(geometry, mu=1.0, placement=None):
    placement = np.eye(4) if placement is None else placement
    return Piece(Shape("collision", "body", "collision", geometry, placement), Surface(mu, mu))


def cube(name, at, side=0.2, mass=1.0, mu=1.0, **options):
    inertia = np.eye(3) * mass * side**2 / 6.0
    return Body(name, (*at, *LEVEL), [piece(Box((side,) * 3), mu)], mass=mass, inertia=inertia, **options)


def slab(name, at, size, **options):
    return Body(name, (*at, *LEVEL), [piece(Box(size))], **options)


def ball(name, at, radius=0.1, mass=1.0, **options):
    inertia = np.eye(3) * 0.4 * mass * radius**2
    return Body(name, (*at, *LEVEL), [piece(Sphere(radius))], mass=mass, inertia=inertia, **options)


def can(name, at, radius=0.05, length=0.12, mass=0.5, kind=Cylinder):
    inertia = np.diag([mass * (3 * radius**2 + length**2) / 12.0] * 2 + [mass * radius**2 / 2.0])
    return Body(name, (*at, *LEVEL), [piece(kind(radius, length))], mass=mass, inertia=inertia)


def pill(name, at):
    return can(name, at, kind=Capsule)


def start(engine, x=0.0, y=0.0):
    q = engine.kinematics.neutral()
    q[:3] = x, y, 0.06
    return q


def rover(engine_of, **options):
    """A robot on wheels at the origin, with what else is wanted."""
    engine = engine_of("diff_drive", surfaces=SMOOTH, **options)
    engine.reset(start(engine))
    return engine


def rovers(engine_of, count, *, gap=1.0, **options):
    """So many robots in rows, all driving alike."""
    probe = engine_of("diff_drive")
    shapes = scene_of(probe.kinematics.robot).shapes
    others = [Member(probe.kinematics, shapes, SMOOTH, name=f"r{k}") for k in range(1, count)]
    engine = engine_of("diff_drive", surfaces=SMOOTH, others=others, **options)
    side = int(np.ceil(np.sqrt(count)))
    for k, robot in enumerate(engine.robots):
        robot.put(start(engine, gap * (k % side), gap * (k // side)))
        robot.motor_velocity[6:], robot.motor_effort[6:] = (7.0, 9.0), 1.0
    return engine
