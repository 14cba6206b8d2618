"""Where something ends in a picture."""

from __future__ import annotations

import numpy as np

from urdfkit.scene.rays.kernels import kernel


def found(picture, alike=8):
    numbers = np.empty(picture.shape[0] * picture.shape[1], dtype=np.int64)
    mask = np.zeros(picture.shape[:2], dtype=bool)
    mask.ravel()[numbers[: kernel("outline")(picture, alike, numbers)]] = True
    return mask


def test_both_sides_of_every_edge_are_found_in_any_channel() -> None:
    random = np.random.default_rng(0)
    picture = random.integers(0, 30, (23, 31, 3), dtype=np.uint8)
    truth = np.zeros(picture.shape[:2], dtype=bool)
    for axis in (0, 1):
        differs = np.abs(np.diff(picture.astype(int), axis=axis)).max(axis=2) > 8
        truth |= np.pad(differs, [(0, 1), (0, 0)] if axis == 0 else [(0, 0), (0, 1)])
        truth |= np.pad(differs, [(1, 0), (0, 0)] if axis == 0 else [(0, 0), (1, 0)])
    assert np.array_equal(found(picture), truth)


def test_nothing_ends_in_an_even_picture_nor_in_one_pixel() -> None:
    assert not found(np.full((4, 5, 3), 200, dtype=np.uint8)).any()
    assert not found(np.zeros((1, 1, 3), dtype=np.uint8)).any()
    assert not found(np.cumsum(np.ones((3, 9, 3), dtype=np.uint8), axis=1, dtype=np.uint8)).any()
