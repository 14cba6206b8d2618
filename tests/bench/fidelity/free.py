"""Rows of free motion: falling, spinning, swinging."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from fidelity.row import Row, distance, elliptic_k
from fidelity.scene import G, Look, Pose, Run, Scene

INERTIA = np.array([0.02, 0.05, 0.06])
SPIN = (0.01, 3.0, 0.02)
LENGTH = 2.0 / 3.0
"""Of the mathematical pendulum that swings as the rod does: (I + m·l²)/(m·l) [m]."""


def free_fall(run: Run) -> float:
    """Fall for two seconds."""
    end = run(Scene("box", 2.0, ground=False, spawn=(0, 0, 100, 0, 0, 0)))[-1]
    return distance(end.base.position, (0.0, 0.0, 100.0 - 0.5 * G * 4.0))


def projectile(run: Run) -> float:
    """Throw a body that spins."""
    end = run(Scene("spinner", 2.0, ground=False, spawn=(0, 0, 50, 0.3, 0.2, 1.0), twist=(3, -2, 8, 1, 2, 3)))[-1]
    return distance(end.base.position, (6.0, -4.0, 50.0 + 16.0 - 0.5 * G * 4.0))


def _rotation(pose: Pose) -> np.ndarray:
    x, y, z, w = pose.quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _spinning(run: Run) -> list[Look]:
    """Let a body spin about its middle axis, nearly, for a minute."""
    return run(Scene("spinner", 60.0, ground=False, gravity=(0, 0, 0), twist=(0, 0, 0, *SPIN), every=0.05))


def _body_rates(looks: Sequence[Look]) -> np.ndarray:
    return np.array([_rotation(look.base).T @ look.base.angular for look in looks])


def spin_energy(run: Run) -> float:
    """Return the worst relative error of energy."""
    rates = _body_rates(_spinning(run))
    energy = (rates**2) @ INERTIA
    return float(np.abs(energy / ((np.array(SPIN) ** 2) @ INERTIA) - 1.0).max())


def spin_momentum(run: Run) -> float:
    """Return the worst relative error of angular momentum, as a vector."""
    start = INERTIA * SPIN
    worst = 0.0
    for look in _spinning(run):
        R = _rotation(look.base)
        now = R @ (INERTIA * (R.T @ look.base.angular))
        worst = max(worst, float(np.linalg.norm(now - start) / np.linalg.norm(start)))
    return worst


def tumbling(run: Run) -> float:
    """Return the relative error of the time between tumbles (Landau and Lifshitz, Mechanics, §37)."""
    looks = _spinning(run)
    middle, crossings = _body_rates(looks)[:, 1], []
    for k in range(len(looks) - 1):
        if middle[k] * middle[k + 1] < 0.0:
            share = middle[k] / (middle[k] - middle[k + 1])
            crossings.append(looks[k].t + share * (looks[k + 1].t - looks[k].t))
    if len(crossings) < 2:
        return math.inf
    one, two, three = INERTIA
    twice, square = float(np.array(SPIN) ** 2 @ INERTIA), float((INERTIA * SPIN) @ (INERTIA * SPIN))
    near, far = (two - one) * (twice * three - square), (three - two) * (square - twice * one)
    if square < twice * two:
        near, far = far, near
    half = 2.0 * elliptic_k(near / far) * math.sqrt(one * two * three / far)
    return abs(float(np.diff(crossings).mean()) / half - 1.0)


def pendulum(amplitude: float) -> Row:
    """Return the row of a pendulum of an amplitude [rad]."""
    period = 4.0 * math.sqrt(LENGTH / G) * elliptic_k(math.sin(amplitude / 2) ** 2)

    def error(run: Run) -> float:
        # Near the crossing after ten periods and a quarter, the angle tells how late it is.
        at = round(10.25 * period / 0.005) * 0.005
        end = run(Scene("pendulum", at, ground=False, joints={"hinge": (amplitude, 0.0)}))[-1]
        angle = end.joints["hinge"][0]
        fastest = 2.0 * math.sqrt(G / LENGTH) * math.sin(amplitude / 2)
        late = angle / fastest + (at - 10.25 * period)
        return abs(late) / (10.25 * period)

    return Row(
        f"pendulum, {math.degrees(amplitude):.0f}°, period",
        f"4·√(l/g)·K(sin² α/2) = {period:.5f} s",
        "",
        error,
        2e-6,
        4e-5,
    )


def _energy(look: Look) -> float:
    (a, da), (b, db) = look.joints["shoulder"], look.joints["elbow"]
    kinetic = potential = x = z = 0.0
    angle, rate = a, da
    for _ in range(2):
        # Centre and end of a rod that hangs along -z and turns about y.
        vx, vz = x - 0.5 * rate * math.cos(angle), z + 0.5 * rate * math.sin(angle)
        kinetic += 0.5 * (vx * vx + vz * vz) + 0.5 * 0.01 * rate * rate
        x, z = x - rate * math.cos(angle), z + rate * math.sin(angle)
        angle, rate = a + b, da + db
    potential = G * (-0.5 * math.cos(a)) + G * (-math.cos(a) - 0.5 * math.cos(a + b))
    return kinetic + potential


def double_pendulum(run: Run) -> float:
    """Return the worst error of the energy within a minute [J]."""
    joints = {"shoulder": (2.0, 0.0), "elbow": (1.0, 0.0)}
    looks = run(Scene("double_pendulum", 60.0, ground=False, joints=joints, every=0.05))
    energies = [_energy(look) for look in looks]
    worst = max(abs(energy - energies[0]) for energy in energies)
    return worst if math.isfinite(worst) else math.inf


def top(run: Run) -> float:
    """Return the relative error of the slow precession of a heavy top."""
    nutation, spin, lever = 1.0, 60.0, 0.2
    across, axial = 0.01 + lever**2, 0.02
    a, b, c = across * math.cos(nutation), -axial * spin, G * lever
    rate = (-b - math.sqrt(b * b - 4 * a * c)) / (2 * a)
    joints = {
        "yaw": (0.0, rate),
        "nutation": (nutation, 0.0),
        "spin": (0.0, spin - rate * math.cos(nutation)),
    }
    end = run(Scene("top", 5.0, ground=False, joints=joints))[-1]
    return abs(end.joints["yaw"][0] / (5.0 * rate) - 1.0)


ROWS = (
    Row("free fall, 2 s", "½·g·t² = 19.62 m", "m", free_fall, 1e-9, 1e-9),
    Row("spinning projectile, 2 s", "v·t − ½·g·t²", "m", projectile, 1e-8, 1e-8),
    Row("torque-free spin, 60 s: energy", "constant", "", spin_energy, 1e-11, 1e-9),
    Row("torque-free spin, 60 s: angular momentum", "constant vector", "", spin_momentum, 1e-10, 2e-9),
    Row(
        "torque-free spin about the intermediate axis: tumbling period",
        "2·K(k²)·√(I₁I₂I₃/…)",
        "",
        tumbling,
        1e-6,
        1e-6,
        1e-7,
    ),
    pendulum(0.1),
    pendulum(math.pi / 2),
    pendulum(2.5),
    Row("double pendulum, 60 s: energy, of 31 J in motion", "constant", "J", double_pendulum, 1e-3, 0.5),
    Row("heavy top: precession", "A·cos θ·Ω² − C·ω·Ω + m·g·l = 0", "", top, 1e-9, 1e-9),
)
