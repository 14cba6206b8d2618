"""Principal moments in plain Python, next to numpy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.urdf.principal_moments import eigenvalues, is_possible, shown

entries = st.floats(-1, 1, allow_subnormal=False)
scales = st.sampled_from([1e-12, 1e-6, 1.0, 1e9])


@given(st.tuples(*[entries] * 6), scales)
def test_eigenvalues_equal_numpys(values, scale):
    xx, xy, xz, yy, yz, zz = (value * scale for value in values)
    expected = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    size = max(abs(expected))
    np.testing.assert_allclose(eigenvalues(xx, xy, xz, yy, yz, zz), expected, rtol=0, atol=4e-15 * size)


def test_exact_cases():
    assert eigenvalues(0, 0, 0, 0, 0, 0) == (0, 0, 0)
    assert eigenvalues(3, 0, 0, 1, 0, 2) == (1, 2, 3)
    np.testing.assert_allclose(eigenvalues(0.4, 0.1, 0.1, 0.4, 0.1, 0.2), (0.14384, 0.3, 0.55616), atol=5e-6)


def test_numbers_are_shown_so_that_the_inequality_can_be_seen():
    assert shown((0.1438447, 0.3, 0.5561553)) == ["0.144", "0.300", "0.556"]
    assert shown((1.0, 1.0, 2.0002)) == ["1.0000", "1.0000", "2.0002"]
    assert shown((1e-7, 2e-7, 9e-7)) == ["1e-07", "2e-07", "9e-07"]
    assert shown((100.0, 200.0, 400.0)) == ["100", "200", "400"]


@pytest.mark.parametrize(
    ("moments", "expected"),
    [
        ((1, 1, 2), True),
        ((1, 1, 2.001), True),  # rounded to three digits
        ((1, 1, 2.01), False),
        ((2.01, 1, 1), False),
        ((0, 1, 1), False),
        ((1e-8, 1, 1), True),
        ((1e-10, 1, 1), False),
        ((-1, -1, -1), False),
    ],
)
def test_possible_moments_are_positive_and_satisfy_the_triangle_inequality(moments, expected):
    xx, yy, zz = moments
    assert is_possible((xx, 0, 0, yy, 0, zz)) is expected
