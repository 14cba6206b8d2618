import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.app.pictures.camera_placement import MARGIN, camera_direction, lens_of, placement
from urdfkit.errors import UsageError


@settings(max_examples=60, deadline=None)
@given(st.floats(-180, 180), st.floats(-89, 89), st.sampled_from([(400, 300), (300, 900)]), st.integers(0, 1000))
def test_everything_is_in_the_image_and_fills_it(
    azimuth: float, elevation: float, size: tuple[int, int], seed: int
) -> None:
    points = np.random.default_rng(seed).uniform(-1, 1, (20, 3)) * [2.0, 0.5, 1.0] + [5.0, 0.0, 1.0]
    lens = lens_of(*size)
    frame = placement(points, lens, azimuth, elevation)
    assert np.allclose(frame[:3, :3].T @ frame[:3, :3], np.eye(3), atol=1e-12)
    assert np.linalg.det(frame[:3, :3]) > 0
    assert frame[2, 2] > 0  # z of the camera points up
    depth, left, up = ((points - frame[:3, 3]) @ frame[:3, :3]).T
    assert depth.min() > 0
    filled = [
        np.abs(lens.focal_length * each / depth).max() / (edge / 2) for each, edge in zip((left, up), size, strict=True)
    ]
    assert max(filled) == pytest.approx(1 / MARGIN, rel=0.02)


def test_directions() -> None:
    assert camera_direction("front") == (0.0, 8.0, 1.0)
    assert camera_direction("30,-20") == (30.0, -20.0, 1.0)
    assert camera_direction("30,20,2") == (30.0, 20.0, 2.0)
    frame = placement(np.eye(3), lens_of(100, 100), 90.0, 0.0)
    assert frame[1, 3] > 1.0  # from the left
    assert np.allclose(frame[:3, 0], [0, -1, 0])


@pytest.mark.parametrize("text", ["frnt", "1", "1,2,3,4", "a,b", "0,91", "0,nan", "0,0,0", "0,0,-1"])
def test_invalid_directions(text: str) -> None:
    with pytest.raises(UsageError, match="--camera"):
        camera_direction(text)
