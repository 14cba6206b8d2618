"""Sines and cosines of several angles at once, of additions and multiplications alone.

The polynomials are those of FreeBSD's msun (k_sin.c, k_cos.c, e_rem_pio2.c), within 1 ulp of the exact value.
"""

import math

from urdfkit.kinematics.serial.kernel.compilation import Floats, inlined

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
WHOLE = 6755399441055744.0
"""1.5·2⁵²: a smaller number is rounded to a whole one by adding this and taking it off again."""


@inlined
def sines_cosines(angles: Floats, sines: Floats, cosines: Floats) -> None:
    """Compute sines and cosines of eight angles of less than 10⁶ rad, four at a time: there are no branches."""
    for k in range(8):
        angle = angles[k]
        quarters = (angle * (2.0 / math.pi) + WHOLE) - WHOLE
        x = ((angle - quarters * HALF_PI[0]) - quarters * HALF_PI[1]) - quarters * HALF_PI[2]
        z = x * x
        sine = x + x * z * (S[0] + z * (S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5])))))
        tail = z * (C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5])))))
        cosine = 1.0 - 0.5 * z + z * tail
        # Quarters modulo four, in -2 .. 2: odd ones swap sine and cosine.
        of_four = quarters - 4.0 * ((quarters * 0.25 + WHOLE) - WHOLE)
        odd = of_four == 1.0 or of_four == -1.0
        low = cosine if odd else sine
        high = sine if odd else cosine
        sines[k] = -low if (of_four == -1.0 or of_four == 2.0 or of_four == -2.0) else low
        cosines[k] = -high if (of_four == 1.0 or of_four == 2.0 or of_four == -2.0) else high
