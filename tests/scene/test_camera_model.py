"""Lenses next to OpenCV: Brown's distortion, and a calibration that finds what a lens was made of."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from tests.scene.test_ray_renderer import lit, rendering
from urdfkit.description.urdf.robot import Mesh, Pose
from urdfkit.meshes.textures import Texture
from urdfkit.scene import Shape, TriMesh
from urdfkit.scene.camera_model import Distortion, Lens
from urdfkit.scene.pose_matrices import pose_matrix

LENSES = [
    Lens(640, 480, 1.1, Distortion(-0.28, 0.09, 0.001, -0.0015, -0.01)),
    Lens(640, 480, 0.9, Distortion(0.12, -0.05, -0.002, 0.001, 0.0)),
]

COLUMNS, ROWS, SQUARE = 9, 6, 0.06
"""Inner corners of the board, and the edge of its squares [m]."""

OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
"""Turns optical axes (z forward, x right, y down) into those of a camera that looks along x."""


def matrix(lens: Lens) -> np.ndarray:
    f = lens.focal_length
    return np.array([[f, 0, (lens.width - 1) / 2], [0, f, (lens.height - 1) / 2], [0, 0, 1]])


def coefficients(lens: Lens) -> np.ndarray:
    d = lens.distortion
    return np.array([d.k1, d.k2, d.p1, d.p2, d.k3])


@pytest.mark.parametrize("lens", LENSES)
def test_every_pixel_looks_where_opencv_projects_it_from(lens: Lens) -> None:
    directions = np.empty((lens.width * lens.height, 3))
    directions[lens.order] = lens.directions
    points = directions @ OPTICAL  # in optical axes
    seen = points[:, 2] > 0
    assert seen.mean() > 0.99
    back, _ = cv2.projectPoints(points[seen], np.zeros(3), np.zeros(3), matrix(lens), coefficients(lens))
    row, column = np.divmod(np.flatnonzero(seen), lens.width)
    assert np.abs(back[:, 0] - np.column_stack([column, row])).max() < 1e-6


def board() -> Shape:
    """Return a checkerboard in the plane x = 0, in squares of a texture as sharp as its texels."""
    across, up = COLUMNS + 1, ROWS + 1
    squares = np.add.outer(np.arange(up), np.arange(across)) % 2 * 255
    framed = np.kron(np.pad(squares, 1, constant_values=255), np.ones((64, 64))).astype(np.uint8)
    texture = Texture(np.dstack([framed] * 3 + [np.full_like(framed, 255)]))
    y, z = (across + 2) * SQUARE / 2, (up + 2) * SQUARE / 2
    corners = np.array([[0, y, -z], [0, -y, -z], [0, -y, z], [0, y, z]], dtype=np.float32)
    mesh = TriMesh(
        corners, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32),
        uv=np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32), textures=(texture,),
        face_textures=np.zeros(2, dtype=np.int32),
    )  # fmt: skip
    return Shape("board", "board", "visual", Mesh("board.obj"), np.eye(4), mesh=mesh)


def views(lens: Lens) -> list[np.ndarray]:
    """Return placements of cameras that look at the board from all around, up to 40 degrees, and see all of it."""
    away = 0.46 / np.tan(lens.field_of_view / 2)
    found = []
    turns = ((0, 0), (0.5, 0), (-0.5, 0.1), (0, 0.5), (0.1, -0.5), (0.4, 0.4), (-0.4, 0.4), (0.4, -0.4), (-0.4, -0.4))
    for k, (turn, tilt) in enumerate((*turns, (-0.7, 0.0), (0.7, 0.1))):
        towards = pose_matrix(Pose((0, 0, 0), (0.1 * (k % 3 - 1), tilt, turn)))
        aside = np.eye(4)
        aside[:3, 3] = (-away - 0.03 * (k % 4), 0.08 * (k % 3 - 1), 0.06 * (k % 2 - 0.5))
        found.append(towards @ aside)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("lens", LENSES)
def test_opencv_calibrates_a_camera_to_what_it_was_given(lens: Lens) -> None:
    shot = rendering(board(), lighting=lit(ambient=(1.0, 1.0, 1.0)))
    column, row = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    grid = np.column_stack([column.ravel(), row.ravel(), np.zeros(column.size)]).astype(np.float32) * SQUARE
    objects, images = [], []
    for view in views(lens):
        picture = shot.take(lens, view, samples=4)
        grey = cv2.cvtColor(picture.rgb, cv2.COLOR_RGB2GRAY)
        found, corners = cv2.findChessboardCorners(grey, (COLUMNS, ROWS))
        if not found:
            continue
        fine = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 60, 1e-4)
        images.append(cv2.cornerSubPix(grey, corners, (5, 5), (-1, -1), fine))
        objects.append(grid)
    assert len(images) >= 9
    error, k, d, _, _ = cv2.calibrateCamera(objects, images, (lens.width, lens.height), None, None)
    assert error < 0.2  # [px]
    true = matrix(lens)
    assert k[0, 0] == pytest.approx(true[0, 0], rel=0.005)
    assert k[1, 1] == pytest.approx(true[1, 1], rel=0.005)
    assert k[0, 2] == pytest.approx(true[0, 2], rel=0.005)
    assert k[1, 2] == pytest.approx(true[1, 2], rel=0.005)
    # The coefficients go together; what counts is where they put the picture's points.
    outer = np.stack(np.meshgrid(np.linspace(-0.45, 0.45, 9), np.linspace(-0.35, 0.35, 9), [1.0]), -1).reshape(-1, 3)
    outer *= (np.tan(lens.field_of_view / 2) * 2, np.tan(lens.field_of_view / 2) * 1.5, 1.0)
    here, _ = cv2.projectPoints(outer, np.zeros(3), np.zeros(3), true, coefficients(lens))
    there, _ = cv2.projectPoints(outer, np.zeros(3), np.zeros(3), k, d)
    assert np.abs(here - there).max() < 1.5


@pytest.mark.parametrize(("width", "height"), [(64, 48), (1, 1), (3, 5), (63, 49), (6, 2), (640, 480)])
def test_rays_come_tile_by_tile_and_each_pixel_once(width: int, height: int) -> None:
    lens = Lens(width, height, 1.2)
    row, column = np.divmod(np.arange(width * height), width)
    within = (row % 4) * 4 + column % 4
    assert np.array_equal(lens.order, np.lexsort((within, column // 4, row // 4)))
    row, column = np.divmod(lens.order, width)
    assert np.array_equal(lens.directions, lens.towards(column.astype(float), row.astype(float)))
