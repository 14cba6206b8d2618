"""A mesh in <collision> that is missing or broken: its shape is ignored by name, and the rest runs."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from urdfkit.cli import main
from urdfkit.errors import ResourceError, SimulationError
from urdfkit.sim import Simulator

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
BOX = '<collision><origin xyz="0 0 0.5"/><geometry><box size="1 1 1"/></geometry></collision>'
MESH = '<collision name="hull"><geometry><mesh filename="{}"/></geometry></collision>'


def written(folder: Path, collisions: str) -> Path:
    (folder / "r.urdf").write_text(f'<robot name="r"><link name="base">{INERTIAL}{collisions}</link></robot>')
    (folder / "broken.stl").write_bytes(b"no mesh")
    return folder / "r.urdf"


@pytest.mark.parametrize(("mesh", "reported"), [("gone.stl", "no file gone.stl"), ("broken.stl", "is truncated")])
def test_the_shape_is_left_out_by_name_and_the_rest_stands_on_the_ground(
    tmp_path: Path, mesh: str, reported: str
) -> None:
    file = written(tmp_path, BOX + MESH.format(mesh))
    notes: list[str] = []
    simulator = Simulator(file, note=notes.append)
    simulator.run(0.3)
    assert simulator.state.base_pose[2] == pytest.approx(0.0, abs=1e-6)
    (note,) = [each for each in notes if mesh in each]
    assert reported in note
    assert note.startswith(f"{file}:1:")
    assert note.endswith("shape `base/collision/hull` is ignored: it has no contacts")


def test_a_visual_mesh_is_a_repair_at_the_line_of_its_file_name(tmp_path: Path) -> None:
    mesh = MESH.replace("collision", "visual").replace("<mesh ", "<mesh\n").format("gone.stl")
    simulator = Simulator(written(tmp_path, BOX + mesh), note=lambda _: None)
    (repair,) = simulator.repairs
    assert (repair.kind, repair.code, repair.link) == ("mesh", "G601", "base")
    assert repair.message == "no file gone.stl; shape `base/visual/hull` is ignored: it is invisible"
    assert repair.position is not None
    assert repair.position.line == 2


@pytest.mark.parametrize("collisions", [MESH.format("gone.stl"), BOX + MESH.format("gone.stl")])
def test_a_strict_simulation_refuses_the_robot(tmp_path: Path, collisions: str) -> None:
    with pytest.raises(ResourceError, match=r"gone\.stl"):
        Simulator(written(tmp_path, collisions), strict=True)


def test_visual_shapes_replace_the_collision_shapes_of_a_link_if_all_are_missing(tmp_path: Path) -> None:
    trimesh.creation.cone(0.5, 1.0).export(tmp_path / "outer_body.stl")
    visuals = BOX.replace("collision", "visual") + MESH.replace("collision", "visual").format("outer_body.stl")
    simulator = Simulator(written(tmp_path, MESH.format("gone.stl") + visuals), note=lambda _: None)
    assert [shape.name for shape in simulator.scene.with_role("collision")] == [
        "base/collision/0",
        "base/collision/hull",
    ]
    simulator.run(0.3)
    assert simulator.state.base_pose[2] == pytest.approx(0.0, abs=1e-6)
    (repair,) = simulator.repairs
    assert repair.message == "no file gone.stl; the link collides with its visual shapes"
    assert (repair.kind, repair.code, repair.link) == ("mesh", "G601", "base")


@pytest.mark.parametrize(
    ("mesh", "code"),
    [
        ("gone.stl", "G601"),
        ("package://gone/base.stl", "G602"),
        ("no package of no file .xyz", "G606"),
        ("broken.stl", "G607"),
    ],
)
def test_a_replaced_mesh_has_the_code_of_the_lint_rule_for_its_cause(tmp_path: Path, mesh: str, code: str) -> None:
    file = written(tmp_path, BOX + MESH.format(mesh))
    (tmp_path / "no package of no file .xyz").write_text("")
    assert [repair.code for repair in Simulator(file, note=lambda _: None).repairs] == [code]


def test_the_command_runs_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "run", str(written(tmp_path, BOX + MESH.format("gone.stl"))), "--for", "0.01"]) == 0
    assert len([line for line in capsys.readouterr().err.splitlines() if "gone.stl" in line]) == 1


def world_with(folder: Path, collisions: str, *, static: bool) -> Path:
    (folder / "broken.stl").write_bytes(b"no mesh")
    path = folder / "w.sdf"
    path.write_text(
        f'<sdf version="1.7"><world name="w"><model name="rock"><static>{int(static)}</static><pose>2 0 1 0 0 0</pose>'
        f'<link name="l">{collisions}</link></model></world></sdf>'
    )
    return path


def collision(name: str, geometry: str) -> str:
    return f'<collision name="{name}"><geometry>{geometry}</geometry></collision>'


def sdf_mesh(name: str) -> str:
    return f"<mesh><uri>{name}</uri></mesh>"


SDF_BOX = collision("box", "<box><size>1 1 1</size></box>")


@pytest.mark.parametrize("static", [True, False])
@pytest.mark.parametrize(("mesh", "reported"), [("gone.stl", "no file gone.stl"), ("broken.stl", "is truncated")])
def test_an_unreadable_mesh_of_a_world_model_is_ignored(tmp_path: Path, mesh: str, reported: str, static: bool) -> None:
    robot = written(tmp_path, BOX)
    world = world_with(tmp_path, collision("hull", sdf_mesh(mesh)) + SDF_BOX, static=static)
    notes: list[str] = []
    simulator = Simulator(robot, world=world, note=notes.append)
    simulator.run(0.1)
    (note,) = [each for each in notes if mesh in each]
    assert note.startswith(f"{world}:1:")
    assert reported in note
    assert note.endswith("collision `hull` is ignored: it has no contacts")


def test_a_static_model_may_have_nothing_left_and_a_free_one_may_not(tmp_path: Path) -> None:
    robot = written(tmp_path, BOX)
    for mesh in ("gone.stl", "broken.stl"):
        lost = collision("hull", sdf_mesh(mesh))
        Simulator(robot, world=world_with(tmp_path, lost, static=True), note=lambda _: None).run(0.01)
        free = world_with(tmp_path, lost, static=False)
        with pytest.raises(SimulationError, match=r"model `rock` has no collision with a readable mesh"):
            Simulator(robot, world=free, note=lambda _: None)


def test_a_broken_visual_of_a_world_is_not_seen_and_the_rest_is(tmp_path: Path) -> None:
    visual = f'<visual name="coat"><geometry>{sdf_mesh("broken.stl")}</geometry></visual>'
    world = world_with(tmp_path, SDF_BOX + visual, static=True)
    notes: list[str] = []
    simulator = Simulator(written(tmp_path, BOX), world=world, note=notes.append)
    assert simulator.world.body_shapes() == ()
    (note,) = [each for each in notes if "coat" in each]
    assert note.startswith(f"{world}:1:")
    assert "visual `coat` is invisible: mesh broken.stl is truncated" in note


def test_a_misspelt_material_of_a_world_is_reported_with_the_nearest(tmp_path: Path) -> None:
    paint = "<material><script><name>Gazebo/{0}</name></script></material>"
    visual = '<visual name="{0}"><geometry><sphere><radius>1</radius></sphere></geometry>' + paint + "</visual>"
    world = world_with(tmp_path, SDF_BOX + visual.format("Oragne") + visual.format("Red"), static=True)
    notes: list[str] = []
    Simulator(written(tmp_path, BOX), world=world, note=notes.append)
    (note,) = [each for each in notes if "material" in each]
    assert note.endswith(
        "no material `Gazebo/Oragne`; the visual keeps its plain colour; did you mean `Gazebo/Orange`?"
    )


def test_a_robot_without_any_collision_shape_left_is_named(tmp_path: Path) -> None:
    notes: list[str] = []
    Simulator(written(tmp_path, MESH.format("gone.stl")), note=notes.append)
    (note,) = [each for each in notes if "gone.stl" in each]
    assert note.endswith("no collision shape of the robot is left, so nothing holds it up")
