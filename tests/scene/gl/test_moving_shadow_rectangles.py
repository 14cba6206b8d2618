"""Where the shadows of what moves can fall in the picture."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scene.gl.test_same_picture import EYE, LENS, SUN, agree, both, table_of, zoo
from tests.scene.test_ray_renderer import lit
from urdfkit.description.urdf.robot import Pose
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.moving_shadow_rectangles import shaded, union
from urdfkit.scene.pose_matrices import pose_matrix


def test_every_point_behind_a_box_is_in_the_rectangle() -> None:
    random = np.random.default_rng(7)
    lens, low, some = Lens(320, 240, 1.1), 0.05, 0
    everything = np.array([[-6.0, -6.0, 0.0, 6.0, 6.0, 3.0]])
    for _ in range(200):
        corner = random.uniform((-3, -3, 0), (3, 3, 2))
        box = np.append(corner, corner + random.uniform(0.05, 0.8, 3))
        towards = random.normal(size=3)
        towards /= np.linalg.norm(towards)
        frame = pose_matrix(Pose((*random.uniform(-4, 4, 2), 1.2), (0.0, *random.uniform((-0.2, -3), (0.5, 3)))))
        column, row, width, height = shaded(
            box[None], towards, everything, frame[:3, :3], frame[:3, 3], lens, low, slack=0.0
        )
        points = random.uniform(box[:3], box[3:], (400, 3)) - random.uniform(0, 15, (400, 1)) * towards
        points = points[((points >= everything[0, :3]) & (points <= everything[0, 3:])).all(axis=1)]
        seen = (points - frame[:3, 3]) @ frame[:3, :3]
        seen = seen[seen[:, 0] > low]
        x = (lens.width - 1) / 2 - lens.focal_length * seen[:, 1] / seen[:, 0]
        y = (lens.height - 1) / 2 - lens.focal_length * seen[:, 2] / seen[:, 0]
        inside = (x > 0) & (x < lens.width - 1) & (y > 0) & (y < lens.height - 1)
        some += int(inside.sum())
        assert (x[inside] >= column).all()
        assert (x[inside] <= column + width).all()
        assert (y[inside] >= row).all()
        assert (y[inside] <= row + height).all()
    assert some > 1000


def test_what_is_behind_the_camera_and_its_shadow_too_asks_for_nothing() -> None:
    box, everything = np.array([[-3.0, -0.5, 0.0, -2.0, 0.5, 1.0]]), np.array([[-9.0, -9, 0, 9, 9, 3]])
    up = np.array([0.0, 0.0, 1.0])
    found = shaded(box, up, everything, np.eye(3), np.array([0.0, 0.0, 1.5]), LENS, 0.05, 0.0)
    assert found == (0, 0, 0, 0)
    assert union([found, (3, 4, 5, 6), (10, 1, 2, 3)]) == (3, 1, 9, 9)
    assert union([found]) == found


@pytest.mark.opengl
@pytest.mark.parametrize("samples", [1, 4])
def test_only_that_part_of_the_picture_is_drawn_twice_and_it_is_the_same(monkeypatch, samples: int) -> None:
    from urdfkit.scene.gl import gl_renderer

    table = table_of(*zoo())
    gl, rays = both(table, lit(SUN, ambient=(0.3, 0.3, 0.3)))
    again = []
    inner = gl_renderer.GlRenderer._cast_shadows

    def noted(self, *arguments):
        again.append(inner(self, *arguments))
        return again[-1]

    monkeypatch.setattr(gl_renderer.GlRenderer, "_cast_shadows", noted)
    poses = np.tile([0, 0, 0, 0, 0, 0, 1.0], (10, 1))
    for lift in (0.0, 0.2, 0.5):
        poses[3, 2] = lift  # the cylinder
        table.place(poses)
        one, other = (each.take(LENS, EYE, samples=samples) for each in (gl, rays))
        agree(one, other, alike=0.99 if samples == 1 else 0.98)
    assert again[0] is None
    assert all(each is not None and 0 < each[2] * each[3] < 0.5 * LENS.width * LENS.height for each in again[1:])
    table.place(poses)
    still = gl.take(LENS, EYE, samples=samples)
    monkeypatch.setattr(gl_renderer, "LARGE", 0.0)  # draw all of it with both maps
    poses[3, 2] += 1e-9
    table.place(poses)
    whole = gl.take(LENS, EYE, samples=samples)
    assert again[-1] is None
    assert (still.rgb != whole.rgb).any(axis=2).sum() <= 4  # of 76,800, at the edge of what has moved by a nanometre
