import numpy as np
import pytest
import trimesh

from urdfkit.description.urdf.robot import Box, Cylinder, Mesh, Sphere
from urdfkit.scene import Scene, Shape, TriMesh
from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.content.meshcat_objects import Y_TO_Z, capsule, draw, link_path


class Window:
    """Keeps the commands."""

    def __init__(self) -> None:
        self.commands: list[dict] = []

    def send(self, command) -> None:
        self.commands.append(command.lower())

    def of(self, kind: str) -> dict[str, dict]:
        return {c["path"]: c for c in self.commands if c["type"] == kind}


def mesh() -> TriMesh:
    box = trimesh.creation.box()
    return TriMesh(np.asarray(box.vertices, dtype=np.float32), np.asarray(box.faces, dtype=np.int32))


def shape(geometry, *, role="visual", rgba=(0.2, 0.4, 0.6, 1.0), tri=None, placement=None) -> Shape:
    return Shape("n", "arm", role, geometry, np.eye(4) if placement is None else placement, rgba, True, tri)


def drawn(*shapes: Shape) -> tuple[Window, GeometryStore]:
    window, store = Window(), GeometryStore()
    draw(Scene(("arm",), shapes), window, store)
    return window, store


def test_shapes_hang_below_their_link_by_role_and_number() -> None:
    window, _ = drawn(shape(Box((1, 2, 3))), shape(Sphere(0.5)), shape(Box((1, 1, 1)), role="collision"))
    assert window.commands[0] == {"type": "delete", "path": "/robot"}
    paths = [f"/robot/links/arm/{end}" for end in ("visual/0", "visual/1", "collision/0")]
    assert list(window.of("set_object")) == paths
    box = window.of("set_object")[paths[0]]["object"]["geometries"][0]
    assert (box["width"], box["height"], box["depth"]) == (1, 2, 3)


def test_cylinders_stand_along_z_in_their_placement() -> None:
    placement = np.eye(4)
    placement[:3, 3] = 1, 2, 3
    window, _ = drawn(shape(Cylinder(0.1, 0.5), placement=placement))
    command = window.of("set_transform")["/robot/links/arm/visual/0"]
    matrix = np.array(command["matrix"]).reshape(4, 4).T
    assert np.allclose(matrix, placement @ Y_TO_Z)
    assert np.allclose(matrix[:3, :3] @ [0, 1, 0], [0, 0, 1])
    geometry = window.of("set_object")["/robot/links/arm/visual/0"]["object"]["geometries"][0]
    assert (geometry["height"], geometry["radiusTop"]) == (0.5, 0.1)


def test_a_mesh_used_four_times_travels_once() -> None:
    window, store = drawn(*(shape(Mesh("wheel.stl"), tri=mesh()) for _ in range(4)))
    names = {c["object"]["geometries"][0]["name"] for c in window.of("set_object").values()}
    assert len(names) == len(store) == 1
    assert store.get(names.pop()) is not None


def test_meshes_of_the_last_scene_are_forgotten() -> None:
    window, store = drawn(shape(Mesh("wheel.stl"), tri=mesh()))
    draw(Scene(("arm",), (shape(Box((1, 1, 1))),)), window, store)
    assert len(store) == 0


def test_colours() -> None:
    window, _ = drawn(
        shape(Box((1, 1, 1)), rgba=(1.0, 0.5, 0.0, 0.25)),
        shape(Box((1, 1, 1)), rgba=(1.0, 0.5, 0.0, 0.25), role="collision"),
    )
    seen, touched = (c["object"]["materials"][0] for c in window.of("set_object").values())
    assert (seen["color"], seen["opacity"], seen["transparent"]) == (0xFF8000, 0.25, True)
    assert touched["color"] != seen["color"]
    assert touched["transparent"]


def test_a_mesh_with_its_own_colours_shows_them_unless_the_description_names_one() -> None:
    plain = mesh()
    colours = np.full((len(plain.vertices), 4), 200, dtype=np.uint8)
    own = TriMesh(plain.vertices, plain.faces, None, colours)
    kinds = [Shape("n", "arm", "visual", Mesh("m"), np.eye(4), (0.0, 0.0, 0.0, 1.0), has, own) for has in (False, True)]
    window, _ = drawn(*kinds)
    materials = [command["object"]["materials"][0] for command in window.of("set_object").values()]
    flags = [(material["vertexColors"], material["color"]) for material in materials]
    assert [(bool(own), color) for own, color in flags] == [(True, 0xFFFFFF), (False, 0)]


def test_a_glossy_shape_is_smoother_than_a_matt_one() -> None:
    glossy = Shape("n", "arm", "visual", Box((1, 1, 1)), np.eye(4), gloss=(0.5, 0.5, 0.5, 128.0))
    window, _ = drawn(shape(Box((1, 1, 1))), glossy)
    matt, shiny = (command["object"]["materials"][0]["roughness"] for command in window.of("set_object").values())
    assert 2 / shiny**4 - 2 == pytest.approx(128.0)
    assert 0.3 < shiny < matt < 1


@pytest.mark.parametrize(("radius", "length"), [(0.1, 0.5), (1.0, 0.0), (0.3, 2.0)])
def test_capsule(radius: float, length: float) -> None:
    made = capsule(radius, length)
    body = trimesh.Trimesh(made.vertices, made.faces)
    assert body.is_watertight
    assert np.allclose(
        body.bounds, [[-radius, -radius, -radius - length / 2], [radius, radius, radius + length / 2]], atol=1e-6
    )
    exact = np.pi * radius**2 * (4 / 3 * radius + length)
    assert body.volume == pytest.approx(exact, rel=0.04)
    assert body.volume > 0


def test_a_slash_in_a_name_does_not_part_the_path() -> None:
    assert link_path("left/wheel%2F") == "/robot/links/left%2Fwheel%252F"
    window, _ = drawn(Shape("n", "a/b", "visual", Box((1, 1, 1)), np.eye(4)))
    assert list(window.of("set_object")) == ["/robot/links/a%2Fb/visual/0"]
