"""Placements along a chain: the tip in the base, and the axis and origin of every step.

A step is a fixed placement followed by a turn about its z axis and a slide along it. Each is a linear function of one
variable, so one row of numbers describes a revolute, a prismatic and a mimic joint alike.
"""

import math

from urdfkit.kinematics.serial.kernel.compilation import Floats, Integers, inlined, stack
from urdfkit.kinematics.serial.kernel.trigonometry import sines_cosines

STEP = 16
"""Numbers of a step: rotation (9, by rows), translation (3), multiplier and offset of the turn, and of the slide."""
END = 12
"""Numbers of the placement of the tip after the last step: rotation (9, by rows), translation (3)."""
AXIS = 6
"""Numbers that `place` writes for a step: its axis and its origin in the base."""
BLOCK = 8
"""Steps whose sines and cosines are computed together."""
FAR = 1e5
"""From here on [rad] whole turns are taken off first."""
TURN = 2.0 * math.pi

Chain = tuple[Floats, Integers, int, int]
"""A chain: its steps, `STEP` numbers each, then `END`; the index of each step's variable, which are numbered in the
order of their first steps; the number of steps, and the number of variables."""


@inlined
def place(chain: Chain, q: Floats, pose: Floats, axes: Floats) -> None:
    """Compute the pose of the tip, and the axis and origin of each step, in the base.

    Args:
        chain: see `Chain`.
        q: the configuration.
        pose: written: rotation (9, by rows) and translation (3) of the tip.
        axes: written: `AXIS` numbers per step.
    """
    steps, variables, count, _ = chain
    angles = stack(8)
    sines = stack(8)
    cosines = stack(8)
    xx, xy, xz = 1.0, 0.0, 0.0
    yx, yy, yz = 0.0, 1.0, 0.0
    zx, zy, zz = 0.0, 0.0, 1.0
    px, py, pz = 0.0, 0.0, 0.0
    first = 0
    while first < count:
        here = min(BLOCK, count - first)
        for k in range(BLOCK):
            angles[k] = 0.0
        for k in range(here):
            s = STEP * (first + k)
            angle = steps[s + 12] * q[variables[first + k]] + steps[s + 13]
            if abs(angle) > FAR:
                angle -= TURN * math.floor(angle / TURN)
            angles[k] = angle
        sines_cosines(angles, sines, cosines)
        for k in range(here):
            s = STEP * (first + k)
            a = steps[s + 9]
            b = steps[s + 10]
            c = steps[s + 11]
            px += xx * a + xy * b + xz * c
            py += yx * a + yy * b + yz * c
            pz += zx * a + zy * b + zz * c
            a = steps[s]
            b = steps[s + 3]
            c = steps[s + 6]
            ux = xx * a + xy * b + xz * c
            uy = yx * a + yy * b + yz * c
            uz = zx * a + zy * b + zz * c
            a = steps[s + 1]
            b = steps[s + 4]
            c = steps[s + 7]
            vx = xx * a + xy * b + xz * c
            vy = yx * a + yy * b + yz * c
            vz = zx * a + zy * b + zz * c
            a = steps[s + 2]
            b = steps[s + 5]
            c = steps[s + 8]
            wx = xx * a + xy * b + xz * c
            wy = yx * a + yy * b + yz * c
            wz = zx * a + zy * b + zz * c
            slide = steps[s + 14] * q[variables[first + k]] + steps[s + 15]
            px += wx * slide
            py += wy * slide
            pz += wz * slide
            sine = sines[k]
            cosine = cosines[k]
            xx = cosine * ux + sine * vx
            yx = cosine * uy + sine * vy
            zx = cosine * uz + sine * vz
            xy = cosine * vx - sine * ux
            yy = cosine * vy - sine * uy
            zy = cosine * vz - sine * uz
            xz = wx
            yz = wy
            zz = wz
            g = AXIS * (first + k)
            axes[g] = wx
            axes[g + 1] = wy
            axes[g + 2] = wz
            axes[g + 3] = px
            axes[g + 4] = py
            axes[g + 5] = pz
        first += BLOCK
    s = STEP * count
    for k in range(3):
        a = steps[s + k]
        b = steps[s + k + 3]
        c = steps[s + k + 6]
        pose[k] = xx * a + xy * b + xz * c
        pose[k + 3] = yx * a + yy * b + yz * c
        pose[k + 6] = zx * a + zy * b + zz * c
    a = steps[s + 9]
    b = steps[s + 10]
    c = steps[s + 11]
    pose[9] = px + xx * a + xy * b + xz * c
    pose[10] = py + yx * a + yy * b + yz * c
    pose[11] = pz + zx * a + zy * b + zz * c


@inlined
def geometric_jacobian(chain: Chain, pose: Floats, axes: Floats, row: int, column: int, jacobian: Floats) -> None:
    """Compute the Jacobian at the tip in the axes of the base, linear rows first.

    Args:
        chain: see `Chain`.
        pose: see `place`.
        axes: see `place`.
        row: numbers in memory from one row to the next.
        column: numbers in memory from the column of one variable to that of the next.
        jacobian: written: six rows, one column per variable.
    """
    steps, variables, count, _ = chain
    cleared = 0
    for k in range(count):
        turn = steps[STEP * k + 12]
        slide = steps[STEP * k + 14]
        g = AXIS * k
        x = axes[g]
        y = axes[g + 1]
        z = axes[g + 2]
        a = pose[9] - axes[g + 3]
        b = pose[10] - axes[g + 4]
        c = pose[11] - axes[g + 5]
        j = column * variables[k]
        if variables[k] == cleared:  # its first step
            for r in range(6):
                jacobian[j + row * r] = 0.0
            cleared += 1
        jacobian[j] += turn * (y * c - z * b) + slide * x
        jacobian[j + row] += turn * (z * a - x * c) + slide * y
        jacobian[j + 2 * row] += turn * (x * b - y * a) + slide * z
        jacobian[j + 3 * row] += turn * x
        jacobian[j + 4 * row] += turn * y
        jacobian[j + 5 * row] += turn * z


@inlined
def rotation_vector(goal: Floats, pose: Floats, turn: Floats) -> None:
    """Compute the rotation from the tip to the target as axis times angle, in the axes of the base.

    Args:
        goal: rotation of the target, by rows.
        pose: see `place`.
        turn: written: three numbers [rad].
    """
    m = stack(9)
    for i in range(3):
        for j in range(3):
            total = 0.0
            for k in range(3):
                total += goal[3 * i + k] * pose[3 * j + k]
            m[3 * i + j] = total
    x = 0.5 * (m[7] - m[5])
    y = 0.5 * (m[2] - m[6])
    z = 0.5 * (m[3] - m[1])
    cosine = 0.5 * (m[0] + m[4] + m[8] - 1.0)
    sine = math.sqrt(x * x + y * y + z * z)
    if cosine > -0.999:
        scale = 1.0 if sine < 1e-9 else math.atan2(sine, cosine) / sine
        turn[0] = scale * x
        turn[1] = scale * y
        turn[2] = scale * z
    else:
        # Near half a turn the axis is that of the symmetric part.
        angle = math.atan2(sine, cosine)
        flat = 1.0 - cosine
        x2 = math.sqrt(max(0.0, (m[0] - cosine) / flat))
        y2 = math.sqrt(max(0.0, (m[4] - cosine) / flat))
        z2 = math.sqrt(max(0.0, (m[8] - cosine) / flat))
        if x2 >= y2 and x2 >= z2:
            y2 = math.copysign(y2, m[1] + m[3])
            z2 = math.copysign(z2, m[2] + m[6])
            sign = 1.0 if x >= 0.0 else -1.0
        elif y2 >= z2:
            x2 = math.copysign(x2, m[1] + m[3])
            z2 = math.copysign(z2, m[5] + m[7])
            sign = 1.0 if y >= 0.0 else -1.0
        else:
            x2 = math.copysign(x2, m[2] + m[6])
            y2 = math.copysign(y2, m[5] + m[7])
            sign = 1.0 if z >= 0.0 else -1.0
        turn[0] = sign * angle * x2
        turn[1] = sign * angle * y2
        turn[2] = sign * angle * z2
