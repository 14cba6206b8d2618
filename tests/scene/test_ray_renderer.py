"""Pictures: every pixel where geometry has it, colours as light falls, shadows where something stands between."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urdfkit.description.sdf import Light, Plane, World
from urdfkit.description.urdf.robot import Box, Mesh, Pose, Sphere
from urdfkit.scene import Scene, Shape, TriMesh
from urdfkit.scene.camera_model import Distortion, Lens
from urdfkit.scene.lights import Lighting, lighting_of
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays import RayTable

DOWN = Pose((0.0, 0.0, 5.0), (0.0, np.pi / 2, 0.0))
"""A camera at a height of 5 m that looks straight down; the picture's up is the world's x."""

NO_AIR = Lighting(ambient=(0.0, 0.0, 0.0), background=(0.0, 0.0, 1.0))


def visual(geometry, name, xyz=(0.0, 0.0, 0.0), rgba=(1.0, 1.0, 1.0, 1.0), **more) -> Shape:
    return Shape(name, name, "visual", geometry, pose_matrix(Pose(xyz)), rgba, True, **more)


def rendering(*shapes: Shape, lighting: Lighting) -> RayRenderer:
    table = RayTable(Scene(tuple(s.body for s in shapes), shapes), shapes)
    table.place(np.tile([0, 0, 0, 0, 0, 0, 1.0], (len(shapes), 1)))
    return RayRenderer(table, lighting)


def world(*lights: Light, kept=()) -> World:
    return World("w", lights=lights, kept=kept)


def lit(*lights: Light, ambient=(0.0, 0.0, 0.0)) -> Lighting:
    return Lighting(lighting_of(world(*lights)).lights, ambient, (0.0, 0.0, 1.0))


FLOOR = visual(Plane((0.0, 0.0, 1.0), (100.0, 100.0)), "floor", rgba=(1.0, 0.5, 0.25, 1.0))


def test_pixels_are_where_geometry_has_them() -> None:
    lens = Lens(64, 48, 1.0)
    ball = visual(Sphere(0.5), "ball", (0.6, -0.4, 2.0))
    picture = rendering(FLOOR, ball, lighting=lit(ambient=(1, 1, 1))).take(lens, pose_matrix(DOWN))
    f = lens.focal_length
    row, column = np.mgrid[:48, :64]
    # In the picture, up is +x of the world and right is -y.
    x, y = (23.5 - row) / f, (31.5 - column) / f
    rays = np.stack([x, y, -np.ones_like(x)], axis=-1)
    o = np.array([0, 0, 5]) - np.array([0.6, -0.4, 2.0])
    a, b = (rays**2).sum(-1), rays @ o
    under = b * b - a * (o @ o - 0.25)
    depth = np.where(under >= 0, (-b - np.sqrt(np.maximum(under, 0))) / a, 5.0)
    assert np.allclose(picture.depth, depth, atol=1e-5)
    assert np.array_equal(picture.shapes == 1, under >= 0)
    assert 20 < (under >= 0).sum() < 500


def test_light_falls_as_the_cosine_and_colours_multiply() -> None:
    slanted = Light("sun", "directional", direction=(0.0, 1.0, -1.0), diffuse=(0.8, 0.8, 0.4, 1.0))
    picture = rendering(FLOOR, lighting=lit(slanted, ambient=(0.1, 0.1, 0.1))).take(Lens(8, 8, 1.0), pose_matrix(DOWN))
    light = np.array([0.8, 0.8, 0.4]) * np.sqrt(0.5) + 0.1
    assert np.abs(picture.rgb[4, 4] - 255 * light * (1.0, 0.5, 0.25)).max() <= 0.51


@pytest.mark.parametrize("casts", [True, False])
def test_shadows_lie_where_something_stands_between(casts: bool) -> None:
    sun = Light("sun", "directional", direction=(0.0, 1.0, -1.0), cast_shadows=casts)
    box = visual(Box((1.0, 1.0, 0.1)), "box", (0.0, 0.0, 1.0))
    lens = Lens(200, 200, 1.2)
    picture = rendering(FLOOR, box, lighting=lit(sun)).take(lens, pose_matrix(DOWN))
    row, column = np.mgrid[:200, :200]
    x, y = 5 * (99.5 - row) / lens.focal_length, 5 * (99.5 - column) / lens.focal_length
    floor = picture.shapes == 0
    # The plate's shadow: its outline, moved by its height along the light; 3 cm for its thickness and the pixels.
    inside = (np.abs(x) < 0.47) & (np.abs(y - 1.0) < 0.47)
    outside = (np.abs(x) > 0.53) | (np.abs(y - 1.0) > 0.58)
    dark = picture.rgb.max(axis=-1) == 0
    assert dark[floor & inside].all() == casts
    assert not dark[floor & outside].any()


def test_the_picture_does_not_depend_on_the_rays_that_share_a_packet() -> None:
    """Shadow rays of far points are cast in packets of their own; here in any order of the pixels."""
    lights = (
        Light("sun", "directional", direction=(0.2, 1.0, -1.0), diffuse=(0.6, 0.6, 0.6, 1.0), specular=(1, 1, 1, 1)),
        Light("lamp", "point", Pose((1.0, 0.0, 4.0)), diffuse=(0.5, 0.3, 0.3, 1.0)),
    )
    shiny = {"gloss": (0.5, 0.5, 0.5, 20.0)}
    near, far = (
        visual(Sphere(0.3), "near", (0.3, 0.0, 3.5), **shiny),
        visual(Box((1, 1, 1)), "far", (0, 0, 0.5), **shiny),
    )
    renderer, lens = rendering(FLOOR, near, far, lighting=lit(*lights, ambient=(0.1, 0.1, 0.1))), Lens(40, 30, 1.0)
    picture = renderer.take(lens, pose_matrix(DOWN))
    other = np.random.default_rng(5).permutation(40 * 30)
    shuffled = SimpleNamespace(
        width=40,
        height=30,
        focal_length=lens.focal_length,
        directions=np.ascontiguousarray(lens.directions[other]),
        order=lens.order[other],
    )
    assert np.array_equal(renderer.take(shuffled, pose_matrix(DOWN)).rgb, picture.rgb)
    threaded = RayRenderer(renderer.table, lit(*lights, ambient=(0.1, 0.1, 0.1)), threads=3).take(
        Lens(200, 150, 1.0), pose_matrix(DOWN)
    )
    assert np.array_equal(threaded.rgb, renderer.take(Lens(200, 150, 1.0), pose_matrix(DOWN)).rgb)
    assert len(np.unique(picture.rgb.reshape(-1, 3), axis=0)) > 100


def test_lamps_fade_and_spots_have_an_edge() -> None:
    def brightness(light: Light) -> np.ndarray:
        lens = Lens(101, 101, 1.2)
        return rendering(FLOOR, lighting=lit(light)).take(lens, pose_matrix(DOWN)).rgb[50, :, 0] / 255

    at = Pose((0.0, 0.0, 2.0))
    point = brightness(Light("p", "point", at, diffuse=(1, 1, 1, 1), attenuation=(20.0, 0.5, 0.25, 0.125)))
    y = 5 * (50 - np.arange(101)) / Lens(101, 101, 1.2).focal_length
    r = np.sqrt(4 + y**2)
    assert np.abs(point - (2 / r) / (0.5 + 0.25 * r + 0.125 * r**2)).max() < 0.003
    spot = brightness(Light("s", "spot", at, attenuation=(20.0, 1.0, 0.0, 0.0), spot=(0.4, 0.8, 1.0)))
    angle = np.arctan2(np.abs(y), 2)
    assert (spot[angle < 0.19] > 0.9).all()
    assert (spot[angle > 0.41] == 0).all()
    assert (np.diff(spot[:50]) >= 0).all()
    near = brightness(Light("n", "point", at, attenuation=(2.5, 1.0, 0.0, 0.0)))
    assert (near[r > 2.51] == 0).all()
    assert (near[r < 2.49] > 0).all()


def test_nothing_is_the_background_and_clipped() -> None:
    shot = rendering(FLOOR, lighting=NO_AIR)
    up = pose_matrix(Pose((0.0, 0.0, 5.0), (0.0, -np.pi / 2, 0.0)))
    picture = shot.take(Lens(4, 4, 1.0), up)
    assert (picture.rgb == (0, 0, 255)).all()
    assert np.isinf(picture.depth).all()
    assert (picture.shapes == -1).all()
    assert np.isinf(shot.take(Lens(4, 4, 0.1), pose_matrix(DOWN), far=4.0).depth).all()


def test_a_mesh_shows_the_colours_of_its_vertices_where_nobody_says_another() -> None:
    vertices = np.array([[0, 0, 1], [9, 0, 1], [0, 9, 1], [0, -9, 1], [-9, 0, 1]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 4]], dtype=np.int32)
    colors = np.array([[0, 0, 255, 255]] * 5, dtype=np.uint8)
    mesh = TriMesh(vertices, faces, colors=colors)
    light = lit(ambient=(1, 1, 1))
    own = Shape("m", "m", "visual", Mesh("m.stl"), np.eye(4), mesh=mesh)
    reported = Shape("m", "m", "visual", Mesh("m.stl"), np.eye(4), (1.0, 0.0, 0.0, 1.0), True, mesh)
    for shape, color in ((own, (0, 0, 255)), (reported, (255, 0, 0))):
        picture = rendering(shape, lighting=light).take(Lens(3, 3, 0.2), pose_matrix(Pose((1.0, 1.0, 5.0), DOWN.rpy)))
        assert tuple(picture.rgb[1, 1]) == color


def test_a_distorted_lens_sees_points_where_browns_formula_puts_them() -> None:
    distortion = Distortion(-0.25, 0.08, 0.002, -0.003, 0.01)
    lens = Lens(320, 240, 1.2, distortion)
    directions = np.empty((320 * 240, 3))
    directions[lens.order] = lens.directions
    x, y = -directions[:, 1] / directions[:, 0], -directions[:, 2] / directions[:, 0]
    r2 = x**2 + y**2
    radial = 1 - 0.25 * r2 + 0.08 * r2**2 + 0.01 * r2**3
    u = x * radial + 2 * 0.002 * x * y - 0.003 * (r2 + 2 * x**2)
    v = y * radial + 0.002 * (r2 + 2 * y**2) - 2 * 0.003 * x * y
    row, column = np.divmod(np.arange(320 * 240), 320)
    assert np.abs(u * lens.focal_length + 159.5 - column).max() < 1e-3
    assert np.abs(v * lens.focal_length + 119.5 - row).max() < 1e-3


def test_rays_cover_every_pixel_once() -> None:
    for width, height in ((7, 5), (16, 16), (1, 1), (33, 2)):
        assert sorted(Lens(width, height, 1.0).order.tolist()) == list(range(width * height))


def test_the_scene_of_a_world_sets_the_air() -> None:
    from urdfkit.description.sdf.shapes import Kept
    from urdfkit.description.xml.element import Element

    def element(tag: str, text: str = "", *children: Element) -> Element:
        return Element(tag, {}, list(children), text, None)  # type: ignore[arg-type]

    scene = element(
        "scene", "", element("ambient", "0.1 0.2 0.3 1"), element("background", "0 0 1"), element("shadows", "false")
    )
    sun = Light("sun", "directional", cast_shadows=True)
    lighting = lighting_of(world(sun, kept=(Kept("", scene),)))
    assert lighting.ambient == (0.1, 0.2, 0.3)
    assert lighting.background == (0.0, 0.0, 1.0)
    assert lighting.lights[0, 11] == 0.0
    assert lighting_of(world(sun)).lights[0, 11] == 1.0
