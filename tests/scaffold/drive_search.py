"""Robots of random sizes and masses, and how far they are from what they are told: for a test and for a bench."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import UsageError
from urdfkit.resources import find_model
from urdfkit.scaffold import create
from urdfkit.scaffold.templates.template import Template
from urdfkit.sim import Simulator

LATERAL = 0.4
"""Of curves [m/s²]: what skids turns more than told by (LATERAL / (mu g))² (1 + (separation / base)²)."""
RAMP, SETTLED, SECONDS = 0.5, 0.9, 1.0
"""When it is told all of it, when it is measured from, and for how long."""


def drawn(template: Template, drive: str, seed: int) -> Iterator[dict[str, str]]:
    """Yield answers that the template takes, without end: sizes from 5 cm to 5 m, wheels from 5 mm, odd shapes."""
    chance = random.Random(f"{drive} {seed}")

    def between(low: float, high: float) -> float:
        return math.exp(chance.uniform(math.log(low), math.log(high)))

    while True:
        length = between(0.05, 5)
        width, radius = length * between(0.3, 2), max(0.005, length * between(0.02, 0.6))
        height, thick = min(length, width) * between(0.1, 1), max(0.005, radius * between(0.1, 3))
        sizes = {"base_length": length, "base_width": width, "base_height": height, "wheel_radius": radius}
        sizes["mass"] = length * width * height * between(10, 5000)
        if drive != "omni":
            sizes["wheel_width"] = thick
        if chance.random() < 0.5:
            sizes["wheel_separation"] = (width + thick) * between(1, 6)
        if drive != "diff" and chance.random() < 0.5:
            sizes["wheel_base"] = length * between(0.4, 3)
        given = {"name": "scout", "drive": drive, "picture": "no", **{key: f"{x:.4g}" for key, x in sizes.items()}}
        try:
            yield template.answers(given)
        except UsageError:
            continue


def made(template: Template, answers: dict[str, str], folder: Path) -> Robot:
    """Write a robot and load it."""
    create(template, answers | {"year": "2026", "into": "."}, folder)
    return load(find_model([f"{folder}/scout_description"]).path)


def commands(answers: dict[str, str]) -> list[tuple[float, float]]:
    """Return speeds [m/s] and rates [rad/s]: straight on, on the spot, and a curve as sharp as `LATERAL`."""
    if answers["drive"] == "omni":
        return [(0.3, 0.0), (0.0, 0.5), (0.5, LATERAL / 0.5)]
    top = 0.5 * float(answers["max_speed"])
    separation = float(answers["wheel_separation"])
    if answers["drive"] == "ackermann":
        return [(top, 0.0), (top, min(LATERAL / top, 0.4 * top / (float(answers["wheel_base"]) + separation)))]
    wide = separation * (2 if answers["drive"] == "skid" else 1)  # what the wheels have to make up for
    turn = min(LATERAL / top, 0.8 * top / wide)
    return [(top, 0.0), (0.0, turn), (top, turn)]


def errors(
    robot: Robot, v: float, w: float, *, settled: float = SETTLED, seconds: float = SECONDS
) -> tuple[float, float, float]:
    """Return how far it is from its speed and from its rate, relative to what was told, and its greatest tilt [rad]."""
    simulator = Simulator(robot, note=lambda _: None)
    while simulator.t < RAMP:
        share = (simulator.t + simulator.dt / 2) / RAMP
        simulator.command((v * share, 0, 0), (0, 0, w * share))
        simulator.step()
    simulator.command((v, 0, 0), (0, 0, w))
    simulator.run(settled - RAMP)
    way = turned = tilt = 0.0
    since, (x, y, _, *_, qz, qw) = simulator.t, simulator.link_poses()[0]
    while simulator.t < settled + seconds - 1e-9:
        simulator.command((v, 0, 0), (0, 0, w))
        simulator.run(0.1)
        before = (x, y), 2 * math.atan2(qz, qw)
        x, y, _, qx, qy, qz, qw = simulator.link_poses()[0]
        arc = math.remainder(2 * math.atan2(qz, qw) - before[1], 2 * math.pi)
        chord = math.dist((x, y), before[0])
        way += chord * (arc / 2 / math.sin(arc / 2) if abs(arc) > 1e-9 else 1.0)
        turned += arc
        tilt = max(tilt, math.hypot(qx, qy))
    t = simulator.t - since
    return abs(way / (v * t) - 1) if v else way, abs(turned / (w * t) - 1) if w else abs(turned), tilt
