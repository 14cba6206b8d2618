"""OpenGL's pictures next to those of rays: the same scene, the same colours, depths and shapes."""

from __future__ import annotations

import gc
from dataclasses import replace
from threading import Thread

import numpy as np
import pytest
import trimesh

from tests.scene.test_paint import QUARTERS, mesh_of, opaque, wrapped
from tests.scene.test_ray_renderer import lit, visual
from urdfkit.description.sdf import Cone, Ellipsoid, Light, Plane, load_world
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere
from urdfkit.scene import Scene, Shape, TriMesh
from urdfkit.scene.camera_model import Distortion, Lens
from urdfkit.scene.gl.draw_calls import Shot
from urdfkit.scene.gl.driver_probe import probe
from urdfkit.scene.gl.shaders import ALL, COLOR, DEEP
from urdfkit.scene.lights import Lighting, lighting_of
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.ray_renderer import Picture, RayRenderer
from urdfkit.scene.rays import RayTable
from urdfkit.sim.scene_view import world_scene

DEVICE = probe()
pytestmark = pytest.mark.opengl

SUN = Light("sun", "directional", direction=(0.4, 0.3, -1.0), diffuse=(0.8, 0.7, 0.6, 1.0), cast_shadows=True)
LAMP = Light("lamp", "point", Pose((0.0, -1.0, 2.5)), diffuse=(0.5, 0.5, 0.9, 1), attenuation=(20.0, 0.6, 0.2, 0.05))
SPOT = Light("spot", "spot", Pose((1.0, 1.0, 3.0)), attenuation=(20.0, 1.0, 0.0, 0.0), spot=(0.5, 0.9, 1.0))
EYE = pose_matrix(Pose((-4.0, -0.3, 2.5), (0.0, 0.5, 0.05)))
LENS = Lens(320, 240, 1.1)


def both(table: RayTable, lighting: Lighting):
    from urdfkit.scene.gl.gl_renderer import GlRenderer

    return GlRenderer(table, lighting, DEVICE.backend), RayRenderer(table, lighting)


def table_of(*shapes: Shape) -> RayTable:
    table = RayTable(Scene(tuple(s.body for s in shapes), shapes), shapes)
    table.place(np.tile([0, 0, 0, 0, 0, 0, 1.0], (len(shapes), 1)))
    return table


def ball() -> TriMesh:
    icosphere = trimesh.creation.icosphere(subdivisions=2, radius=0.5)
    vertices = icosphere.vertices.astype(np.float32)
    colors = np.column_stack([128 + 200 * vertices, np.full(len(vertices), 255)]).clip(0, 255).astype(np.uint8)
    return TriMesh(vertices, icosphere.faces.astype(np.int32), normals=2 * vertices, colors=colors)


def moved(shape: Shape, name: str, xyz: tuple[float, float, float]) -> Shape:
    return Shape(name, name, "visual", shape.geometry, pose_matrix(Pose(xyz)), shape.rgba, shape.has_color, shape.mesh)


def zoo() -> list[Shape]:
    """Return one of every kind, on a floor."""
    stone = mesh_of(TriMesh(ball().vertices, ball().faces), has_color=True, rgba=(0.5, 0.6, 0.7, 1.0))
    wood = (0.7, 0.5, 0.3, 1.0)
    return [
        visual(Plane((0.0, 0.0, 1.0), (30.0, 30.0)), "floor", rgba=(0.8, 0.8, 0.7, 1.0)),
        visual(Box((0.6, 0.5, 0.8)), "box", (0.0, 0.0, 0.4), rgba=wood),
        visual(Sphere(0.4), "sphere", (0.6, 1.2, 0.4), rgba=(0.9, 0.1, 0.1, 1.0)),
        visual(Cylinder(0.3, 0.9), "cylinder", (0.8, -1.2, 0.45), rgba=(0.1, 0.7, 0.2, 1.0)),
        visual(Cone(0.4, 0.9), "cone", (2.0, 0.5, 0.45), rgba=(0.2, 0.3, 0.9, 1.0)),
        visual(Capsule(0.2, 0.5), "capsule", (2.0, -0.6, 0.45), rgba=(0.9, 0.8, 0.1, 1.0)),
        visual(Ellipsoid((0.5, 0.3, 0.2)), "ellipsoid", (-1.0, 0.9, 0.2), rgba=(0.9, 0.4, 0.9, 1.0)),
        moved(mesh_of(ball()), "ball", (-0.8, -0.9, 0.5)),
        moved(mesh_of(wrapped(opaque(np.kron(QUARTERS, np.ones((4, 4, 1), np.uint8))))), "sign", (3.5, 2.0, 0.01)),
        moved(stone, "stone", (3, -2, 0.5)),
    ]


def agree(one: Picture, other: Picture, *, alike: float = 0.99) -> None:
    """Hold two pictures to the tolerances that the documentation states."""
    off = np.abs(one.rgb.astype(int) - other.rgb).max(axis=2)
    same = one.shapes == other.shapes
    assert (off <= 3).mean() >= alike
    assert same.mean() >= 0.995
    seen = same & (other.shapes >= 0)
    wrong = np.abs(one.depth[seen] - other.depth[seen]) / other.depth[seen]
    assert np.median(wrong) <= 1e-5
    assert np.quantile(wrong, 0.99) <= 1e-3
    assert np.array_equal(np.isfinite(one.depth)[same], np.isfinite(other.depth)[same])


@pytest.mark.parametrize("lights", [(), (SUN,), (LAMP,), (SPOT,), (SUN, LAMP, SPOT)])
def test_a_zoo(lights) -> None:
    gl, rays = both(table_of(*zoo()), lit(*lights, ambient=(0.3, 0.3, 0.35)))
    agree(gl.take(LENS, EYE), rays.take(LENS, EYE))


@pytest.mark.parametrize(
    ("solid", "most"),
    [(Sphere(1.0), 3e-3), (Ellipsoid((1.0, 1.2, 1.4)), 3e-3), (Cylinder(1.0, 4.0), 1.5e-3), (Capsule(1.0, 2.0), 3e-3)],
)
def test_a_round_solid_that_fills_the_picture(solid, most: float) -> None:
    gl, rays = both(table_of(visual(solid, "round", (1.6, 0.07, 0.03))), lit())
    one, other = gl.take(LENS, np.eye(4)), rays.take(LENS, np.eye(4))
    seen = (one.shapes == other.shapes) & (other.shapes >= 0)
    assert seen.mean() > 0.9
    wrong = np.abs(one.depth[seen] - other.depth[seen]) / other.depth[seen]
    assert np.quantile(wrong, 0.99) <= most
    assert np.median(wrong) <= 0.6 * most


@pytest.mark.parametrize(
    "solid",
    [
        Box((0.8, 1.0, 1.2)),
        Sphere(0.6),
        Cylinder(0.5, 1.2),
        Cone(0.6, 1.2),
        Capsule(0.4, 0.6),
        Ellipsoid((0.4, 0.5, 0.7)),
    ],
)
def test_a_solid_has_the_same_surface_from_all_sides(solid) -> None:
    gl, rays = both(table_of(visual(solid, "solid")), lit(LAMP, ambient=(0.3, 0.3, 0.3)))
    for pitch, yaw in ((1.3, 0.2), (0.5, 2.0), (-0.1, -2.5), (-0.7, -1.0), (-1.4, 0.7)):
        back = 2.0 * np.array([-np.cos(pitch) * np.cos(yaw), -np.cos(pitch) * np.sin(yaw), np.sin(pitch)])
        eye = pose_matrix(Pose((*back,), (0.0, pitch, yaw)))
        one, other = gl.take(LENS, eye), rays.take(LENS, eye)
        same, seen = one.shapes == other.shapes, other.shapes >= 0
        assert seen.mean() > 0.1
        assert same.mean() >= 0.995
        wrong = np.abs(one.depth[seen & same] / other.depth[seen & same] - 1.0)
        off = np.abs(one.rgb.astype(int) - other.rgb).max(axis=2)[seen & same]
        assert np.quantile(wrong, 0.98) <= 5e-3  # facets
        assert np.quantile(off, 0.98) <= 8


def test_a_texture_replaces_the_colours_of_vertices() -> None:
    sign = wrapped(opaque(np.kron(QUARTERS, np.ones((4, 4, 1), np.uint8))))
    colors = np.array([[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [90, 90, 90, 255]], dtype=np.uint8)
    gl, rays = both(table_of(mesh_of(replace(sign, colors=colors))), lit(ambient=(1, 1, 1)))
    eye = pose_matrix(Pose((0.0, 0.0, 2.5), (0.0, np.pi / 2, 0.0)))
    agree(gl.take(LENS, eye), rays.take(LENS, eye))


def test_a_house_from_many_places() -> None:
    world = load_world("house")
    scene, poses = world_scene(world)
    table = RayTable(scene, scene.with_role("visual"))
    table.place(poses)
    gl, rays = both(table, lighting_of(world))
    random = np.random.default_rng(3)
    for _ in range(6):
        eye = pose_matrix(Pose((*random.uniform(-4, 4, 2), 1.2), (0.0, *random.uniform((-0.2, -3), (0.5, 3)))))
        agree(gl.take(LENS, eye, near=0.05, far=50.0), rays.take(LENS, eye, near=0.05, far=50.0))


def test_shadows_follow_what_moves() -> None:
    table = table_of(*zoo())
    gl, rays = both(table, lit(SUN, ambient=(0.3, 0.3, 0.3)))
    poses = np.tile([0, 0, 0, 0, 0, 0, 1.0], (10, 1))
    for step in (0.0, 0.3, 0.6, 0.6):
        poses[2, :2] = step, -step
        table.place(poses)
        agree(gl.take(LENS, EYE), rays.take(LENS, EYE))
    poses[1:9, 2] = 0.2  # everything moves: too much for a map of its own
    table.place(poses)
    agree(gl.take(LENS, EYE), rays.take(LENS, EYE))


@pytest.mark.parametrize(("near", "far"), [(3.9, 100.0), (0.05, 4.2), (3.5, 5.0)])
def test_what_is_too_near_or_too_far_is_cut_alike(near: float, far: float) -> None:
    gl, rays = both(table_of(*zoo()), lit(ambient=(1, 1, 1)))
    agree(gl.take(LENS, EYE, near=near, far=far), rays.take(LENS, EYE, near=near, far=far))


def test_what_is_transparent_lets_the_same_light_through() -> None:
    glass = [
        visual(Box((0.2, 3.0, 1.5)), "pane", (-1.5, 0.0, 0.8), rgba=(0.2, 0.9, 0.9, 0.3)),
        visual(Sphere(0.5), "bubble", (-2.4, 0.6, 0.7), rgba=(0.9, 0.9, 0.1, 0.5)),
        visual(Sphere(0.5), "air", (-2.4, -0.8, 0.7), rgba=(0.9, 0.9, 0.1, 0.0)),
    ]
    gl, rays = both(table_of(*zoo(), *glass), lit(SUN, ambient=(0.4, 0.4, 0.4)))
    agree(gl.take(LENS, EYE), rays.take(LENS, EYE))


def test_edges_are_smooth_alike() -> None:
    gl, rays = both(table_of(*zoo()), lit(ambient=(1, 1, 1)))
    hard = np.abs(gl.take(LENS, EYE).rgb.astype(int) - rays.take(LENS, EYE, samples=16).rgb).mean()
    soft = np.abs(gl.take(LENS, EYE, samples=4).rgb.astype(int) - rays.take(LENS, EYE, samples=16).rgb).mean()
    assert soft < 0.7 * hard


def test_through_a_distorted_lens_rays_look() -> None:
    gl, rays = both(table_of(*zoo()), lit(SUN))
    bent = Lens(64, 48, 1.1, Distortion(-0.2))
    assert np.array_equal(gl.take(bent, EYE).rgb, rays.take(bent, EYE).rgb)


def test_lamps_that_cast_shadows_are_left_to_rays() -> None:
    lamp = Light("lamp", "point", Pose((0.0, -1.0, 2.5)), attenuation=(20.0, 1.0, 0.0, 0.0), cast_shadows=True)
    gl, rays = both(table_of(*zoo()), lit(lamp))
    assert np.array_equal(gl.take(LENS, EYE).rgb, rays.take(LENS, EYE).rgb)


def test_only_colours_where_nobody_wants_more() -> None:
    gl, _ = both(table_of(*zoo()), lit(SUN))
    whole, colors = gl.take(LENS, EYE), gl.take(LENS, EYE, deep=False)
    assert np.array_equal(whole.rgb, colors.rgb)
    assert colors.depth.size == 0


def test_colours_and_depths_are_drawn_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    gl, _ = both(table_of(*zoo()), lit(SUN))
    drawn: list[tuple[str, ...]] = []
    draw = gl._drawing.draw

    def remember(shot: Shot, wanted: tuple[str, ...] = COLOR, *, clear: bool = False) -> None:
        drawn.append(wanted)
        draw(shot, wanted, clear=clear)

    monkeypatch.setattr(gl._drawing, "draw", remember)
    gl.take(LENS, EYE)
    assert drawn.count(ALL) == 1
    assert set(drawn) <= ({ALL, COLOR} if not gl._drawing.has_clear else {ALL, COLOR, DEEP})


def test_an_empty_scene_is_background() -> None:
    gl, rays = both(table_of(), lit(SUN))
    one, other = gl.take(LENS, EYE), rays.take(LENS, EYE)
    assert np.array_equal(one.rgb, other.rgb)
    assert np.array_equal(one.depth, other.depth)
    assert (one.shapes == -1).all()


def test_several_threads_may_take_pictures() -> None:
    gl, _ = both(table_of(*zoo()), lit(SUN))
    first = gl.take(LENS, EYE).rgb
    found: list[np.ndarray] = []
    threads = [Thread(target=lambda: found.append(gl.take(LENS, EYE).rgb)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(each, first) for each in found)
    assert len(found) == 3


def test_a_driver_that_fails_later_is_replaced_by_rays(monkeypatch) -> None:
    import moderngl

    from urdfkit.scene.gl.gl_renderer import GlRenderer

    notes: list[str] = []
    table, lighting = table_of(*zoo()), lit(SUN)
    gl = GlRenderer(table, lighting, DEVICE.backend, notes.append)

    def lost(*_: object) -> Picture:
        raise moderngl.Error("the device is lost")

    monkeypatch.setattr(GlRenderer, "_take", lost)
    for _ in range(2):
        assert np.array_equal(gl.take(LENS, EYE).rgb, RayRenderer(table, lighting).take(LENS, EYE).rgb)
    assert notes == ["OpenGL has failed (the device is lost); images are now rendered by ray casting"]


@pytest.mark.parametrize("lights", [(SUN,), (LAMP,), (SPOT,)], ids=["sun", "lamp", "spot"])
def test_what_is_glossy_shines_alike(lights) -> None:
    glossy = [replace(shape, gloss=(0.9, 0.8, 0.7, 5.0 * k)) for k, shape in enumerate(zoo())]
    lights = [replace(light, specular=(0.8, 0.8, 0.8, 1.0)) for light in lights]
    gl, rays = both(table_of(*glossy), lit(*lights, ambient=(0.3, 0.3, 0.35)))
    one, other = gl.take(LENS, EYE), rays.take(LENS, EYE)
    agree(one, other)
    matt = both(table_of(*zoo()), lit(*lights, ambient=(0.3, 0.3, 0.35)))[1].take(LENS, EYE)
    assert (np.abs(other.rgb.astype(int) - matt.rgb).max(axis=2) > 20).mean() > 0.004


def test_triangles_of_one_mesh_shine_as_their_materials_say() -> None:
    plate = ball()
    gloss = np.zeros((len(plate.faces), 4), dtype=np.float32)
    gloss[::2] = (0.9, 0.9, 0.9, 20.0)
    one = moved(mesh_of(replace(plate, face_gloss=gloss)), "ball", (-1.0, 0.0, 0.5))
    gl, rays = both(table_of(one), lit(replace(SUN, specular=(1.0, 1.0, 1.0, 1.0))))
    agree(gl.take(LENS, EYE), rays.take(LENS, EYE))


def test_a_driver_that_draws_on_the_processor_leaves_edges_to_rays(monkeypatch) -> None:
    table, lighting = table_of(*zoo()), lit(SUN, ambient=(0.4, 0.4, 0.4))
    gl, rays = both(table, lighting)
    truth = rays.take(LENS, EYE, samples=4).rgb.astype(int)
    found = {}
    for on_processor in (True, False):
        monkeypatch.setattr(gl, "_on_processor", on_processor)
        found[on_processor] = gl.take(LENS, EYE, samples=4, deep=False).rgb
    off = {key: np.abs(rgb - truth).max(axis=2) for key, rgb in found.items()}
    assert (off[True] <= 3).mean() >= 0.99
    assert off[True].mean() < off[False].mean()
    hard = gl.take(LENS, EYE, deep=False).rgb
    assert 0.005 < (found[True] != hard).any(axis=2).mean() < 0.2


def test_the_context_of_a_renderer_that_is_no_longer_used_is_released(monkeypatch: pytest.MonkeyPatch) -> None:
    import moderngl

    from urdfkit.scene.gl import gl_renderer

    created = []
    create = gl_renderer.create
    monkeypatch.setattr(gl_renderer, "create", lambda backend: created.append(create(backend)) or created[-1])
    renderer = gl_renderer.GlRenderer(table_of(*zoo()), lit(SUN), DEVICE.backend)
    renderer.take(LENS, EYE)
    assert not isinstance(created[0].mglo, moderngl.InvalidObject)
    del renderer
    gc.collect()
    assert isinstance(created[0].mglo, moderngl.InvalidObject)
