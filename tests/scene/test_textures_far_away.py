"""Textures that are smaller than a pixel: their mean is seen, not one of their texels by chance."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scene.gl.test_same_picture import agree, both, table_of
from tests.scene.test_paint import mesh_of, opaque
from tests.scene.test_ray_renderer import lit
from urdfkit.description.urdf.robot import Pose
from urdfkit.scene import TriMesh
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays.shading.materials import mip_levels

LENS = Lens(80, 60, 1.0)
EYE = pose_matrix(Pose((-30.0, 0.3, 1.5), (0.0, 0.05, 0.1)))


def floor(pixels: np.ndarray, repeats: float) -> TriMesh:
    """Return a square of 60 m with a texture that is repeated."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
    return TriMesh(
        30 * corners,
        np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32),
        uv=(repeats * (corners[:, :2] + 1) / 2).astype(np.float32),
        textures=(opaque(pixels),),
        face_textures=np.zeros(2, dtype=np.int32),
    )


def checkers() -> np.ndarray:
    """Return 2 × 2 squares, black and white, of 32 × 32 texels each."""
    return np.kron(np.array([[0, 255], [255, 0]]), np.ones((32, 32)))[..., None].repeat(3, axis=2).astype(np.uint8)


def test_a_chequered_floor_at_a_grazing_angle_looks_like_many_samples_per_pixel() -> None:
    renderer = RayRenderer(table_of(mesh_of(floor(checkers(), 60.0))), lit(ambient=(1.0, 1.0, 1.0)))
    once = renderer.take(LENS, EYE).rgb[..., 0].astype(float)
    large = Lens(8 * LENS.width, 8 * LENS.height, LENS.field_of_view)
    fine = renderer.take(large, EYE)
    many = fine.rgb[..., 0].astype(float).reshape(LENS.height, 8, LENS.width, 8).mean(axis=(1, 3))
    seen = (fine.shapes >= 0).reshape(LENS.height, 8, LENS.width, 8).all(axis=(1, 3))
    off = np.abs(once - many)[seen]
    assert seen.mean() > 0.4
    assert np.sqrt((off**2).mean()) < 8  # one texel by chance is off by 85 of 255
    far = seen & (np.arange(LENS.height)[:, None] < np.flatnonzero(seen.any(axis=1))[0] + 4)
    assert np.abs(once[far] - 127.5).max() < 30  # grey, without a pattern of its own


def test_smaller_copies_are_means_down_to_one_texel() -> None:
    pixels = np.random.default_rng(1).integers(0, 256, (5, 8, 4), dtype=np.uint8)
    sizes = [each.shape[:2] for each in mip_levels(pixels)]
    assert sizes == [(5, 8), (2, 4), (1, 2), (1, 1)]
    second = list(mip_levels(pixels))[1]
    assert second[1, 2] == pytest.approx(pixels[2:4, 4:6].astype(float).mean(axis=(0, 1)), abs=0.51)
    (last,) = list(mip_levels(np.full((1, 1, 4), 7, dtype=np.uint8)))
    assert (last == 7).all()


@pytest.mark.opengl
@pytest.mark.parametrize("repeats", [4.0, 60.0, 600.0])
def test_opengl_sees_the_same(repeats: float) -> None:
    gl, rays = both(table_of(mesh_of(floor(checkers(), repeats))), lit(ambient=(1.0, 1.0, 1.0)))
    for eye in (EYE, pose_matrix(Pose((0.0, 0.0, 12.0), (0.0, 1.2, 0.4)))):
        agree(gl.take(LENS, eye), rays.take(LENS, eye))
