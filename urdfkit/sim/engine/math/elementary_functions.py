"""Sine, cosine and the exponential, of additions and multiplications alone.

The C library computes them otherwise on processors with fused multiply-add than on those without, and its versions
differ. These are FreeBSD's msun (k_sin.c, k_cos.c, e_rem_pio2.c, e_exp.c), within 1 ulp of the exact value.
"""

import math

from urdfkit.sim.engine.compilation import compiled, inlined

S = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
C = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
"""π/2 as a sum; a multiple of one of the first two by up to 2²⁰ is exact."""
FAR = 1e6
"""From here on [rad] whole turns are taken off first."""
TURN, TURN_REST = 2.0 * math.pi, 2.4492935982947064e-16
WHOLE = 6755399441055744.0
"""1.5·2⁵²: a smaller number is rounded to a whole one by adding this and taking it off again."""

P = (
    1.66666666666666019037e-01,
    -2.77777777770155933842e-03,
    6.61375632143793436117e-05,
    -1.65339022054652515390e-06,
    4.13813679705723846039e-08,
)
LOG_2 = (6.93147180369123816490e-01, 1.90821492927058770002e-10)
LOG2_E = 1.44269504088896338700
LEAST = -708.0
"""Below this the exponential is taken for 0: less than the least normal number."""


@inlined
def sine_cosine(angle: float) -> tuple[float, float]:
    """Return sine and cosine of an angle [rad]; NaN where it is not finite."""
    if not abs(angle) < FAR:
        within = abs(angle) % TURN
        within -= (abs(angle) - within) / TURN * TURN_REST
        angle = within if angle > 0.0 else -within
    quarters = (angle * (2.0 / math.pi) + WHOLE) - WHOLE
    # The angle less so many quarters, as a sum x + y.
    rest = angle - quarters * HALF_PI[0]
    most = rest - quarters * HALF_PI[1]
    little = quarters * HALF_PI[2] - ((rest - most) - quarters * HALF_PI[1])
    x = most - little
    y = (most - x) - little
    z = x * x
    w = z * z
    r = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5])
    v = z * x
    sine = x - ((z * (0.5 * y - v * r) - y) - v * S[0])
    r = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]))
    half = 0.5 * z
    w = 1.0 - half
    cosine = w + (((1.0 - w) - half) + (z * r - x * y))
    # Of the quarters, how many of four: -2, -1, 0, 1, 2.
    part = quarters - 4.0 * ((0.25 * quarters + WHOLE) - WHOLE)
    if abs(part) == 1.0:
        sine, cosine = part * cosine, -part * sine
    elif abs(part) == 2.0:
        sine, cosine = -sine, -cosine
    return sine, cosine


@compiled
def exponential(x: float) -> float:
    """Return e to the power of a number that is not positive."""
    if not x > LEAST:
        return 0.0
    n = (x * LOG2_E + WHOLE) - WHOLE
    high, low = x - n * LOG_2[0], n * LOG_2[1]
    x = high - low
    t = x * x
    c = x - t * (P[0] + t * (P[1] + t * (P[2] + t * (P[3] + t * P[4]))))
    y = 1.0 - ((low - (x * c) / (2.0 - c)) - high)
    return math.ldexp(y, int(n))
