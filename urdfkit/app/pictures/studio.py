"""A studio for pictures of a robot: soft light from a dome, a sun, and a floor that shows only shadows."""

import os
from dataclasses import replace
from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.app.pictures.camera_placement import lens_of, placement
from urdfkit.description.sdf import Plane
from urdfkit.linear_algebra import Array
from urdfkit.scene import Scene, Shape
from urdfkit.scene.extent import shape_bounds
from urdfkit.scene.lights import Lighting
from urdfkit.scene.pose_matrices import pose_matrices, upright
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.direct_lighting import DIRECTIONAL, LIGHT
from urdfkit.scene.rays.shading.surface_attributes import GLOSS

PICTURE, FILM = (100, 16), (30, 8)
"""Numbers of directions of the soft light and of the sun; each casts a shadow ray.

With 30 directions, the edges of their shadows can be seen on the floor. A film with 100 takes 2.4 times as long.
"""
SUN_RADIUS = 0.05
"""Tangent of the radius of the sun, which softens the edges of its shadow."""
SKY, SUN, AMBIENT = 0.3, 0.4, 0.28
"""Brightness of a horizontal surface by the dome, by the sun at right angles, and everywhere."""
TOWARDS_SUN = (0.35, -0.45, 1.0)
BACKGROUND = (0.945, 0.953, 0.965)
SHEEN = (0.07, 0.07, 0.07, 18.0)
"""Specular properties of surfaces without any, which give black parts their shape."""
FLOOR = "floor"


def studio_lighting(directions: tuple[int, int] = PICTURE) -> Lighting:
    """Return the lights of the studio, from `PICTURE` or `FILM`."""
    dome, disc = directions
    golden = pi * (3.0 - sqrt(5.0))
    sun = np.array(TOWARDS_SUN) / np.linalg.norm(TOWARDS_SUN)
    across = upright(sun)[:, :2]
    rows = []
    for k in range(disc):  # a sunflower on the disc of the sun
        out, turn = SUN_RADIUS * sqrt((k + 0.5) / disc), k * golden
        towards = sun + out * (np.cos(turn) * across[:, 0] + np.sin(turn) * across[:, 1])
        rows.append(_light(towards / np.linalg.norm(towards), SUN / disc, 1.0 / disc))
    for k in range(dome):  # more directions near the zenith, as much light from each
        height, turn = sqrt((k + 0.5) / dome), k * golden
        out = sqrt(1.0 - height * height)
        towards = np.array([out * np.cos(turn), out * np.sin(turn), height])
        rows.append(_light(towards, SKY / dome / height, 1.0 / dome))
    return Lighting(np.array(rows), (AMBIENT,) * 3, BACKGROUND)


def _light(towards: Array, brightness: float, specular: float) -> Array:
    row = np.zeros(LIGHT)
    row[0], row[1:4], row[4:7], row[18:21] = DIRECTIONAL, towards, brightness, specular
    row[11] = 1.0  # casts shadows
    return row


class Studio:
    """Renders pictures of the visual shapes of a robot, which stands on the floor.

    Args:
        scene: the shapes.
        poses: poses of the bodies while the floor is laid under them, x y z [m] and quaternion x y z w.
        directions: of the lights, `PICTURE` or `FILM`.

    Attributes:
        triangle_count: number of triangles of all meshes.
    """

    def __init__(self, scene: Scene, poses: ArrayLike, directions: tuple[int, int] = PICTURE) -> None:
        self._bodies = (*scene.bodies, FLOOR)
        shapes = scene.with_role("visual") or scene.with_role("collision")
        self._shapes = tuple(shapes)
        self._index = scene.body_index
        points = self.points(poses)
        lowest = float(points[:, 2].min())
        self._floor = np.array([0.0, 0.0, lowest - 1e-4 * float(np.ptp(points, axis=0).max()), 0.0, 0.0, 0.0, 1.0])
        lighting = studio_lighting(directions)
        level = AMBIENT + float((lighting.lights[:, 3] * lighting.lights[:, 4]).sum())  # where nothing casts a shadow
        red, green, blue = (channel / level for channel in BACKGROUND)
        plane = Shape(
            f"{FLOOR}/collision/0",
            FLOOR,
            "collision",
            Plane((0.0, 0.0, 1.0), (1.0, 1.0)),
            np.eye(4),
            (red, green, blue, 1.0),
            True,
        )
        lit = [shape if shape.gloss[3] else replace(shape, gloss=SHEEN) for shape in self._shapes]
        table = RayTable(Scene(self._bodies, (*self._shapes, plane)), (*lit, plane))
        self._renderer = RayRenderer(table, lighting, threads=os.cpu_count() or 1)
        self.triangle_count = table.triangle_count
        attributes = self._renderer.paint[3]
        attributes[attributes[:, GLOSS + 3] == 0.0, GLOSS:] = SHEEN

    def points(self, poses: ArrayLike) -> Array:
        """Return the corners of the boxes around the shapes [m]; shape (n, 3)."""
        matrices = pose_matrices(poses)
        found = []
        for shape in self._shapes:
            box = shape_bounds(shape, matrices[self._index[shape.body]])
            found += [np.where(np.array([k & 1, k & 2, k & 4]) > 0, box[1], box[0]) for k in range(8)]
        return np.array(found) if found else np.zeros((1, 3))

    def picture(
        self, poses: ArrayLike, frame: Array, width: int, height: int, *, is_transparent: bool = False, samples: int = 8
    ) -> NDArray[np.uint8]:
        """Render a picture.

        Args:
            poses: poses of the bodies, x y z [m] and quaternion x y z w.
            frame: placement of the camera, see `camera_placement.placement`; shape (4, 4).
            width: [px].
            height: [px].
            is_transparent: the floor is transparent except for its shadows.
            samples: rays per pixel at edges.

        Returns:
            Red, green and blue, and the opacity of transparent pictures; shape (height, width, 3 or 4).
        """
        self._renderer.table.place(np.vstack([np.asarray(poses, dtype=float).reshape(-1, 7), self._floor]))
        if not is_transparent:
            return self._renderer.take(lens_of(width, height), frame, samples=samples).rgb
        seen = self._renderer.take(lens_of(2 * width, 2 * height), frame)
        is_floor = (seen.shapes < 0) | (seen.shapes == len(self._renderer.table.shapes) - 1)
        rgb = seen.rgb / 255.0
        alpha = np.where(is_floor, np.clip(1.0 - (rgb / np.array(BACKGROUND)).min(axis=-1), 0.0, 1.0), 1.0)[..., None]
        color = np.where(is_floor[..., None], 0.0, rgb)
        blocks = np.concatenate([color * alpha, alpha], axis=-1).reshape(height, 2, width, 2, 4).mean(axis=(1, 3))
        blocks[..., :3] /= np.maximum(blocks[..., 3:], 1e-6)
        found: NDArray[np.uint8] = np.rint(255.0 * np.clip(blocks, 0.0, 1.0)).astype(np.uint8)
        return found


def camera_of(studio: Studio, poses: list[Any], size: tuple[int, int], direction: tuple[float, float, float]) -> Array:
    """Return the placement of a camera that sees the robot in all these poses; shape (4, 4)."""
    points = np.concatenate([studio.points(each) for each in poses])
    return placement(points, lens_of(*size), *direction)
