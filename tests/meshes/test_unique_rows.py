import numpy as np

from urdfkit.meshes.triangle_mesh import unique_rows


def test_rows_are_told_apart_even_where_their_numbers_agree() -> None:
    a, b = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F], dtype=np.uint64).view(np.int64)
    rows = np.array([[b, 0], [0, a], [b, 0], [1, 2], [0, a]])
    first, where = unique_rows(rows)
    assert np.array_equal(rows[first[where]], rows)
    assert len(first) == 3
    chance = np.random.default_rng(0).integers(0, 9, (500, 4))
    first, where = unique_rows(chance)
    assert np.array_equal(chance[first[where]], chance)
    assert len(first) == len(np.unique(chance, axis=0))
