"""Rows of bodies that touch: sliding, sticking, rolling, hitting, standing."""

from __future__ import annotations

import math

import numpy as np

from fidelity.row import Row, distance
from fidelity.scene import G, Run, Scene, Thing, tilted

BOX_MU = 0.5
FRICTION_ANGLE = math.atan(BOX_MU)
ON_GROUND = (0.0, 0.0, 0.05, 0.0, 0.0, 0.0)
LYING = (0.0, 0.0, 0.1, math.pi / 2, 0.0, 0.0)
BALL = (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)


def stopping(direction: float) -> Row:
    """Return the row of a box that slides in a direction [rad] of the world."""
    way = 2.0**2 / (2 * BOX_MU * G)

    def error(run: Run) -> float:
        twist = (2.0 * math.cos(direction), 2.0 * math.sin(direction), 0, 0, 0, 0)
        end = run(Scene("box", 1.5, spawn=ON_GROUND, twist=twist))[-1].base.position
        return distance(end[:2], (way * math.cos(direction), way * math.sin(direction)))

    name = "straight" if not direction else "diagonally"
    return Row(f"box sliding {name}: stopping distance", f"v²/2μg = {way:.4f} m", "m", error, 1e-6, 3e-5, 1e-7)


def threshold(run: Run) -> float:
    """Return the relative error of the angle at which a box begins to slide: by 10 mm in 2 s."""
    # Those 10 mm take 5 mm/s² and so an angle a little beyond atan μ, which is known as well.
    right = FRICTION_ANGLE + math.asin(0.005 / G * math.cos(FRICTION_ANGLE))
    low, high = 0.5, 1.5
    while high - low > 2e-4:
        share = (low + high) / 2
        end = run(tilted(share * FRICTION_ANGLE, Scene("box", 2.0, spawn=ON_GROUND)))[-1].base.position
        if distance(end[:2], (0.0, 0.0)) > 0.01:
            high = share
        else:
            low = share
    return abs((low + high) / 2 * FRICTION_ANGLE / right - 1.0)


def creep(run: Run) -> float:
    """Return how far a box moves in 2 s below its friction angle [m]."""
    end = run(tilted(0.9 * FRICTION_ANGLE, Scene("box", 2.0, spawn=ON_GROUND)))[-1].base.position
    return distance(end, ON_GROUND[:3])


def downhill(run: Run) -> float:
    """Return the relative error of the way of a box above its friction angle."""
    angle = 1.2 * FRICTION_ANGLE
    end = run(tilted(angle, Scene("box", 2.0, spawn=ON_GROUND)))[-1].base.position
    return abs(end[0] / (2.0 * G * (math.sin(angle) - BOX_MU * math.cos(angle))) - 1.0)


def tipping(run: Run) -> float:
    """Return the relative error of the angle at which a tall box tips over."""
    low, high = 0.8, 1.2
    while high - low > 2e-4:
        share = (low + high) / 2
        scene = Scene("tall_box", 3.0, spawn=(0.0, 0.0, 0.15, 0.0, 0.0, 0.0))
        end = run(tilted(share * math.atan(1 / 3), scene))[-1].base.position
        if end[2] < 0.1:
            high = share
        else:
            low = share
    return abs((low + high) / 2 - 1.0)


def push(run: Run) -> float:
    """Return the relative error of the way of a crate that is pushed."""
    crate = Thing("crate", (0.2, 0.2, 0.2), (0.0, 0.0, 0.1), 2.0, mu=0.3)
    end = run(Scene("post", 1.0, spawn=(0,) * 6, things=(crate,), push=("crate", 10.0)))[-1]
    return abs(end.things["crate"].position[0] / (0.5 * (10.0 / 2.0 - 0.3 * G)) - 1.0)


def held(run: Run) -> float:
    """Return how far a crate moves that is pushed by less than friction holds [m]."""
    crate = Thing("crate", (0.2, 0.2, 0.2), (0.0, 0.0, 0.1), 2.0, mu=0.3)
    end = run(Scene("post", 2.0, things=(crate,), push=("crate", 5.5)))[-1]
    return distance(end.things["crate"].position, crate.position)


def rolling(model: str, factor: float, name: str, form: str) -> Row:
    """Return the row of a round body that rolls down an incline."""

    def error(run: Run) -> float:
        scene = Scene(model, 1.0, spawn=LYING if model == "can" else BALL)
        end = run(tilted(0.1, scene))[-1].base.position
        return abs(end[0] / (0.5 * factor * G * math.sin(0.1)) - 1.0)

    return Row(f"{name} rolling down an incline: acceleration", f"{form}·g·sin θ", "", error, 1e-9, 1e-9)


def bowling(run: Run) -> float:
    """Return how far from the closed form is the velocity of a ball that slides, then rolls [m/s]."""
    end = run(Scene("ball", 2.0, spawn=BALL, twist=(1, 0, 0, 0, 0, 0)))[-1].base
    return distance(end.linear, (5.0 / 7.0, 0.0, 0.0))


def side_spin(run: Run) -> float:
    """Return how far from the closed form is the velocity of a ball thrown askew with back and side spin [m/s]."""
    end = run(Scene("ball", 3.0, spawn=BALL, twist=(1.0, 0.3, 0.0, 0.0, -40.0, 7.0)))[-1].base
    return distance(end.linear, ((5.0 - 2.0 * 0.1 * 40.0) / 7.0, 0.3 * 5.0 / 7.0, 0.0))


def _drop(run: Run) -> tuple[float, float]:
    looks = run(Scene("box", 1.0, spawn=(0.0, 0.0, 0.55, 0.0, 0.0, 0.0), every=0.005))
    heights = np.array([look.base.position[2] for look in looks]) - 0.05
    down = int(np.argmax(heights < 1e-3))
    return float(heights[down:].max()) if down else math.inf, float(-heights.min())


def rebound(run: Run) -> float:
    """Return how high a box bounces that falls half a metre [m]; 1 mm and less is not told from lying."""
    return max(0.0, _drop(run)[0] - 1e-3)


def sinking(run: Run) -> float:
    """Return how deep it gets [m]; infinite for a box that is thrown up between two looks."""
    rebound, depth = _drop(run)
    return max(0.0, depth) if rebound < 0.05 else math.inf


def head_on(run: Run) -> float:
    """Return how far from the closed form is the common velocity of two balls after they hit [m/s]."""
    target = Thing("target", (0.1,), (1.0, 0.0, 0.0), 3.0, mu=0.3)
    scene = Scene("ball", 1.0, ground=False, gravity=(0, 0, 0), twist=(2, 0, 0, 0, 0, 0), things=(target,), every=0.5)
    end = run(scene)[-1]
    return max(distance(end.base.linear, (0.8, 0, 0)), distance(end.things["target"].linear, (0.8, 0, 0)))


def askew(run: Run) -> float:
    """Return what two balls that meet off centre gain together: momentum and angular momentum [SI]."""
    target = Thing("target", (0.1,), (1.0, 0.1, 0.03), 3.0, mu=0.3)
    twist = (2.0, 0.0, 0.0, 3.0, 10.0, -5.0)
    scene = Scene("ball", 1.0, ground=False, gravity=(0, 0, 0), twist=twist, things=(target,), every=0.5)
    looks = run(scene)
    sums = []
    for look in (looks[0], looks[-1]):
        linear, angular = np.zeros(3), np.zeros(3)
        for pose, mass, inertia in ((look.base, 2.0, 0.008), (look.things["target"], 3.0, target.inertia[0])):
            linear += mass * np.array(pose.linear)
            angular += inertia * np.array(pose.angular) + mass * np.cross(pose.position, pose.linear)
        sums.append(np.concatenate([linear, angular]))
    return float(np.linalg.norm(sums[1] - sums[0]))


def stack(run: Run) -> float:
    """Return how far a box of a stack of five gets in 10 s [m]."""
    things = tuple(Thing(f"box{k}", (0.2, 0.2, 0.2), (0.0, 0.0, 0.1 + 0.2 * k), 1.0) for k in range(4))
    top = (0.0, 0.0, 0.85, 0.0, 0.0, 0.0)
    end = run(Scene("box", 10.0, spawn=top, things=things))[-1]
    off = [distance(end.things[thing.name].position, thing.position) for thing in things]
    return max(*off, distance(end.base.position, top[:3]))


def standing(run: Run) -> float:
    """Return how far a box at rest is from where it was put, after 10 s [m]."""
    end = run(Scene("box", 10.0, spawn=ON_GROUND))[-1].base.position
    return distance(end, ON_GROUND[:3])


ROWS = (
    stopping(0.0),
    stopping(math.pi / 4),
    Row("box on an incline: angle of slip", "atan μ = 26.57°", "", threshold, 0.001, 0.001, 1e-3),
    Row("box at 0.9 of that angle, 2 s: creep", "0", "m", creep, 1e-9, 1e-9),
    Row("box sliding downhill", "g·(sin θ − μ·cos θ)", "", downhill, 1e-9, 1e-9),
    Row("tall box on an incline: angle of tipping", "atan w/h = 18.43°", "", tipping, 0.001, 0.001, 1e-3),
    Row("crate pushed by 10 N, 1 s", "½·(F/m − μg)·t²", "", push, 1e-9, 1e-9),
    Row("crate pushed by less than μmg, 2 s", "0", "m", held, 1e-9, 1e-9),
    rolling("can", 2 / 3, "solid cylinder", "2/3"),
    rolling("ball", 5 / 7, "solid sphere", "5/7"),
    Row("ball that slides, then rolls", "5/7·v", "m/s", bowling, 1e-9, 1e-9),
    Row("ball with back and side spin", "(5·v − 2·r·ω)/7", "m/s", side_spin, 1e-9, 1e-9),
    Row("box dropped 0.5 m: rebound", "0", "m", rebound, 1e-9, 1e-9),
    Row("box dropped 0.5 m: penetration", "0", "m", sinking, 1e-9, 1e-9),
    Row("box at rest, 10 s", "0", "m", standing, 1e-12, 1e-12),
    Row("head-on impact of two balls: common velocity", "m·v/(m + M) = 0.8 m/s", "m/s", head_on, 1e-8, 1e-8, 1e-8),
    Row("oblique impact of two spinning balls: total momentum", "constant", "SI", askew, 1e-10, 1e-10),
    Row("five boxes stacked, 10 s", "0", "m", stack, 1e-9, 1e-9),
)
