"""Frames, axes and includes against closed forms, and against the real sdformat where it is installed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, pi, sin
from pathlib import Path

import pytest

from urdfkit.description.sdf import WorldModel, load_world, model_names, to_sdf, world_names
from urdfkit.description.sdf.model_library import FOLDER
from urdfkit.description.urdf.geometry import (
    Rotation,
    between,
    compose,
    difference,
    inverse,
    rotation_of,
    rpy_of_quaternion,
)
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import DescriptionError

WORLDS = Path(__file__).parents[1] / "worlds"
Sdformat = Callable[..., list[list[str]]]
TRICKY = sorted(path.name for path in WORLDS.iterdir() if path.suffix in (".sdf", ".world"))


def everything(model: WorldModel, prefix: str, around: Pose) -> Iterator[tuple[str, str, object]]:
    """Yield what `sdformat.cc` prints: kind, name, and pose in the world or names of links."""
    links = {name: pose for name, pose, _ in model.all_links()}
    for link in model.links:
        pose = compose(around, link.pose)
        yield "link", prefix + link.name, pose
        for shape in link.collisions:
            yield "collision", f"{prefix}{link.name}/{shape.name}", compose(pose, shape.pose)
    for joint in model.joints:
        yield "joint", prefix + joint.name, compose(around, compose(links[joint.child], joint.pose))
        yield "ends", prefix + joint.name, f"{joint.parent} {joint.child}"
        for axis in joint.axes[:1]:
            length = sum(x * x for x in axis.xyz) ** 0.5
            x, y, z = axis.xyz
            yield "axis", prefix + joint.name, Pose((x / length, y / length, z / length))
    for nested in model.models:
        yield from everything(nested, f"{prefix}{nested.name}::", compose(around, nested.pose))


@pytest.mark.sdformat
@pytest.mark.parametrize("name", TRICKY)
@pytest.mark.parametrize("saved", [False, True])
def test_everything_is_where_sdformat_has_it(sdformat: Sdformat, name: str, saved: bool, tmp_path: Path) -> None:
    world = load_world(WORLDS / name)
    file = WORLDS / name
    if saved:
        file = tmp_path / "saved.sdf"
        file.write_text(to_sdf(world))
    ours = {(kind, name): value for m in world.models for kind, name, value in everything(m, f"{m.name}::", m.pose)}
    theirs = {(kind, name): value for kind, name, value in sdformat(file)}
    assert set(ours) == set(theirs)
    for key, value in ours.items():
        if isinstance(value, Pose):
            x, y, z, *q = map(float, theirs[key].split())
            expected = Pose((x, y, z), rpy_of_quaternion(q[0], q[1], q[2], q[3]))
            assert difference(value, expected) < 1e-9, key
        else:
            assert value == theirs[key], key


@pytest.mark.sdformat
def test_sdformat_accepts_what_we_ship_and_what_we_save(sdformat: Sdformat, tmp_path: Path) -> None:
    files = sorted(FOLDER.glob("*/*.sdf")) + sorted(FOLDER.glob("models/*/model.sdf"))
    assert len(files) == len(world_names()) + len(model_names())
    for name in world_names():
        files.append(tmp_path / f"{name}.sdf")
        files[-1].write_text(to_sdf(load_world(name)))
    assert [line for line in sdformat(*files) if line[0] == "error"] == []


@pytest.mark.sdformat
def test_the_check_by_sdformat_can_fail(sdformat: Sdformat, tmp_path: Path) -> None:
    file = tmp_path / "bad.sdf"
    file.write_text('<sdf version="1.9"><model name="m"><link name="l"><colision/></link></model></sdf>')
    assert sdformat(file)[0][0] == "error"


def world_with(tmp_path: Path, text: str, version: str = "1.9") -> Path:
    path = tmp_path / "test.sdf"
    path.write_text(f'<sdf version="{version}"><world name="w">\n{text}\n</world></sdf>')
    return path


def test_a_frame_of_a_frame(tmp_path: Path) -> None:
    world = load_world(
        world_with(
            tmp_path,
            """<frame name="a"><pose degrees="1">1 0 0 0 0 90</pose></frame>
            <frame name="b" attached_to="a"><pose>1 0 0 0 0 0</pose></frame>
            <model name="m"><pose relative_to="b">1 0 0 0 0 0</pose><link name="l"/></model>""",
        )
    )
    assert world.models[0].pose.xyz == pytest.approx((1.0, 2.0, 0.0), abs=1e-12)
    assert world.models[0].pose.rpy == pytest.approx((0.0, 0.0, pi / 2), abs=1e-12)


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        (
            '<model name="m"><pose relative_to="yrad"/><link name="l"/></model><frame name="yard"/>',
            "2:17: no frame `yrad` in world `w`; did you mean `yard`?",
        ),
        (
            '<model name="m"><link name="a"><pose relative_to="f"/></link><frame name="f" attached_to="a"/></model>',
            "frame poses form a cycle: a → f → a",
        ),
        (
            '<model name="m"><link name="a"/><link name="a"/></model>',
            "model `m` already has a link `a` (line 2)",
        ),
        (
            '<model name="m"><link name="l"/></model><model name="m"><link name="l"/></model>',
            "`w` already has a model `m` (line 2); give one of them another <name>",
        ),
        ('<model name="m"><link name="a"/><frame name="a"/></model>', "model `m` already has a link `a`"),
        ('<model name="m"><link name="world"/></model>', "`world` is a reserved name"),
        (
            """<model name="m"><link name="l"/><frame name="f" attached_to="g"/><frame name="g" attached_to="f"/>
            <joint name="j" type="fixed"><parent>f</parent><child>l</child></joint></model>""",
            "frames are attached to each other in a cycle: f → g → f",
        ),
        (
            '<model name="m" canonical_link="lnik"><link name="link"/></model>',
            "no frame `lnik` in model `m`; did you mean `link`?",
        ),
    ],
)
def test_frames_that_make_no_sense(tmp_path: Path, text: str, reported: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        load_world(world_with(tmp_path, text))
    assert reported in str(caught.value)
    assert str(caught.value).startswith((f"{tmp_path}/test.sdf:2:", f"{tmp_path}/test.sdf:3:"))


def test_names_may_repeat_across_kinds_before_1_7(tmp_path: Path) -> None:
    text = """<model name="m"><link name="a"/><link name="b"/>
    <joint name="a" type="fixed"><parent>a</parent><child>b</child></joint></model>"""
    world = load_world(world_with(tmp_path, text, "1.6"))
    assert world.models[0].joints[0].name == "a"


def test_poses() -> None:
    turned, moved = Pose(rpy=(0.1, -0.4, 2.0)), Pose((1.0, 2.0, 3.0))
    both = compose(moved, turned)
    assert both == Pose(moved.xyz, turned.rpy)
    assert difference(compose(both, inverse(both)), Pose()) < 1e-15
    assert difference(compose(both, between(both, moved)), moved) < 1e-15
    up: Rotation = rotation_of((0.3, pi / 2, 0.5))
    again = rotation_of(compose(Pose(rpy=(0.3, pi / 2, 0.5)), Pose(rpy=(1e-9, 0.0, 0.0))).rpy)
    assert max(abs(a - b) for row, other in zip(up, again, strict=True) for a, b in zip(row, other, strict=True)) < 1e-8
    half = 0.35
    assert rpy_of_quaternion(0.0, 0.0, 3 * sin(half), 3 * cos(half)) == pytest.approx((0.0, 0.0, 0.7))
