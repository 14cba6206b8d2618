"""Saving worlds: what is written reads back equal, whatever the world; and editing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.description.sdf import (
    Ellipsoid,
    Kept,
    Light,
    Physics,
    Plane,
    Surface,
    World,
    WorldAxis,
    WorldInertial,
    WorldJoint,
    WorldLink,
    WorldModel,
    WorldRobot,
    WorldShape,
    add_model,
    load_model,
    load_world,
    model_names,
    model_to_sdf,
    remove_model,
    save_world,
    to_sdf,
    world_names,
)
from urdfkit.description.sdf.shapes import keep
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import DescriptionError, ResourceError

URDF = Path(__file__).parents[1] / "worlds" / "cart.urdf"


def kept(text: str) -> Kept:
    return keep(document_of(Source("kept", text)))


numbers = st.floats(-1e6, 1e6, allow_subnormal=False)
positive = st.floats(1e-6, 1e6)
names = st.text("abcäß_-. <&\"'1", min_size=1, max_size=6).map(lambda text: " ".join(f"x{text}x".split()))
vectors = st.tuples(numbers, numbers, numbers)
sizes = st.tuples(positive, positive, positive)
colors = st.tuples(*[st.integers(0, 255).map(lambda level: level / 255)] * 4)
poses = st.builds(Pose, vectors, vectors)
plugins = st.just(kept('<plugin name="p" filename="libx.so"><a b="&lt;1">2 &amp; 3</a><c/></plugin>'))
sensors = st.just(kept('<sensor name="s" type="contact"><always_on>true</always_on></sensor>'))
geometries = st.one_of(
    st.builds(Box, sizes),
    st.builds(Sphere, positive),
    st.builds(Cylinder, positive, positive),
    st.builds(Capsule, positive, positive),
    st.builds(Ellipsoid, sizes),
    st.builds(
        Plane, st.sampled_from([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8)]), st.tuples(positive, positive)
    ),
)
surfaces = st.builds(
    Surface,
    positive,
    positive,
    vectors,
    positive,
    positive,
    positive,
    positive,
    positive,
    positive,
    st.floats(0, 1, allow_subnormal=False),
    positive,
    st.integers(0, 2**16 - 1),
    st.booleans(),
)
collisions = st.builds(WorldShape, names, geometries, poses, surfaces, laser_retro=numbers)
visuals = st.builds(
    WorldShape,
    names,
    geometries,
    poses,
    rgba=st.none() | colors,
    transparency=st.floats(0, 1, allow_subnormal=False),
    material=st.sampled_from(["", "Gazebo/Grey"]),
)
lights = st.builds(
    Light,
    names,
    st.sampled_from(["point", "directional", "spot"]),
    poses,
    vectors,
    colors,
    colors,
    st.tuples(positive, positive, positive, positive),
    vectors,
    st.booleans(),
    positive,
)


def some(strategy: st.SearchStrategy, most: int = 2) -> st.SearchStrategy:
    return st.lists(strategy, max_size=most, unique_by=lambda thing: thing.name).map(tuple)


spans = st.tuples(*[st.floats(0.1, 10.0)] * 3)  # ∫x², ∫y², ∫z² dm: any three make an inertia that a body has
inertials = st.builds(
    lambda m, p, d: WorldInertial(m, p, d[1] + d[2], 0.0, 0.0, d[0] + d[2], 0.0, d[0] + d[1]), positive, poses, spans
)
links = st.builds(
    WorldLink,
    names,
    poses,
    inertials,
    some(collisions),
    some(visuals),
    st.booleans(),
    st.none() | st.booleans(),
    st.booleans(),
    st.tuples(positive, positive),
    some(lights, 1),
    st.lists(sensors, max_size=1).map(tuple),
)
limits = st.sampled_from([(float("-inf"), float("inf")), (-1.5, 2.0), (0.0, float("inf"))])
axes = st.builds(
    lambda xyz, limit, rest: WorldAxis(xyz, *limit, *rest),
    sizes,
    limits,
    st.tuples(positive, st.just(float("inf")), numbers, positive, positive, numbers),
)
types = st.sampled_from([("fixed", 0), ("revolute", 1), ("prismatic", 1), ("universal", 2), ("ball", 0)])


@st.composite
def models(draw: st.DrawFn, nested: bool = True) -> WorldModel:
    inner = draw(some(models(nested=False), 1)) if nested else ()
    taken = {model.name for model in inner}
    own = tuple(link for link in draw(some(links)) if link.name not in taken)
    ends = [link.name for link in own] + [f"{m.name}::{link.name}" for m in inner for link in m.links]
    joints = []
    if len(ends) > 1:
        kind, count = draw(types)
        joint_axes = tuple(draw(axes) for _ in range(count))
        joints.append(
            WorldJoint("joint", kind, draw(st.sampled_from([ends[0], "world"])), ends[1], draw(poses), joint_axes)
        )
    extras = draw(st.lists(plugins, max_size=2))
    static = draw(st.booleans()) or not (own or inner)
    return WorldModel(
        draw(names), draw(poses), static, own, tuple(joints), inner, draw(st.booleans()), "", tuple(extras)
    )


worlds = st.builds(
    World,
    names,
    vectors,
    some(models(), 3),
    some(lights),
    st.builds(Physics, positive, positive, positive, st.sampled_from(["ode", "dart"]), st.sampled_from(["", "fast"])),
    st.lists(
        st.builds(WorldRobot, st.just("cart"), st.just(f"file://{URDF}"), st.just(str(URDF)), poses), max_size=1
    ).map(tuple),
    magnetic_field=vectors,
    kept=st.just((kept("<scene><grid>false</grid></scene>"),)),
)


@pytest.mark.slow
@settings(max_examples=60)
@given(world=worlds)
def test_what_is_saved_reads_back_equal(world: World, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "saved.sdf"
    path.write_text(to_sdf(world))
    again = load_world(path)
    assert again == world
    assert to_sdf(again) == to_sdf(world)


@pytest.mark.sdformat
@settings(max_examples=20)
@given(world=worlds)
def test_sdformat_accepts_what_is_saved(
    world: World, sdformat: Callable[..., list[list[str]]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / "accepted.sdf"
    path.write_text(to_sdf(world))
    assert [line for line in sdformat(path) if line[0] == "error"] == []


@pytest.mark.parametrize("name", world_names())
def test_our_worlds_read_back_equal(name: str, tmp_path: Path) -> None:
    world = load_world(name)
    save_world(world, tmp_path / "w.world")
    assert load_world(tmp_path / "w.world") == world


def test_models_read_back_equal(tmp_path: Path) -> None:
    for name in set(model_names()) - {"sun"}:
        model = load_model(name)
        (tmp_path / "m.sdf").write_text(model_to_sdf(model))
        assert load_model(tmp_path / "m.sdf") == model


@pytest.mark.parametrize("value", [0.0, 1.0, 2.0])
@pytest.mark.parametrize(
    "name", ["lower", "upper", "effort", "velocity", "damping", "friction", "spring_reference", "spring_stiffness"]
)
def test_each_number_of_an_axis_reads_back_equal(name: str, value: float, tmp_path: Path) -> None:
    axis = WorldAxis((0.0, 1.0, 0.0), **{name: value})
    links = WorldLink("a", inertial=WorldInertial(1.0)), WorldLink("b", inertial=WorldInertial(1.0))
    model = WorldModel("m", links=links, joints=(WorldJoint("j", "revolute", "a", "b", axes=(axis,)),))
    (tmp_path / "m.sdf").write_text(model_to_sdf(model))
    assert load_model(tmp_path / "m.sdf").joints[0].axes == (axis,)


@pytest.mark.parametrize(
    "change",
    [
        {"gravity": False},
        {"gravity": True},
        {"kinematic": True},
        {"self_collide": True},
        {"self_collide": False},
        {"damping": (1.0, 0.0)},
        {"damping": (0.0, 1.0)},
        {"pose": Pose((1.0, 0.0, 0.0))},
    ],
)
def test_each_setting_of_a_link_reads_back_equal(change: dict[str, Any], tmp_path: Path) -> None:
    link = WorldLink("a", inertial=WorldInertial(1.0), **change)
    (tmp_path / "m.sdf").write_text(model_to_sdf(WorldModel("m", links=(link,))))
    assert load_model(tmp_path / "m.sdf").links == (link,)


@pytest.mark.parametrize(
    "change",
    [
        {"mu": 0.0},
        {"mu2": 0.0},
        {"fdir1": (0.0, 0.0, 1.0)},
        {"slip1": 1.0},
        {"slip2": 1.0},
        {"kp": 1.0},
        {"kd": 0.0},
        {"min_depth": 1.0},
        {"max_vel": 0.0},
        {"max_vel": 1.0},
        {"restitution": 1.0},
        {"bounce_threshold": 0.0},
        {"collide_bitmask": 0},
        {"collide_bitmask": 1},
        {"collide_without_contact": True},
        {},
    ],
)
def test_each_number_of_a_surface_reads_back_equal(change: dict[str, Any], tmp_path: Path) -> None:
    shape = WorldShape("s", Sphere(0.5), Pose(), Surface(**change))
    link = WorldLink("a", inertial=WorldInertial(1.0), collisions=(shape,))
    (tmp_path / "m.sdf").write_text(model_to_sdf(WorldModel("m", links=(link,))))
    assert load_model(tmp_path / "m.sdf").links == (link,)


def test_places_do_not_count() -> None:
    assert load_model("ball") == load_model("model://ball")
    assert hash(load_world("house")) == hash(load_world("house"))
    assert load_model("ball") != load_model("box")
    assert load_model("ball") != "ball"


@pytest.mark.parametrize(
    ("world", "reported"),
    [
        (
            World("w", models=(WorldModel("a::b", static=True),)),
            "the name `a::b` cannot be written in SDF: `::` separates models",
        ),
        (World("w", models=(WorldModel("", static=True),)), "it is empty"),
        (World("w", lights=(Light("__x__"),)), "it is reserved"),
        (World("w", models=(WorldModel("a  b", static=True),)), "the name 'a  b' cannot be written in SDF"),
        (World("w", models=(WorldModel("m"),)), "it has no link and is not static"),
        (World("w\x00"), "the character '\\x00' cannot be written in XML"),
    ],
)
def test_what_sdf_cannot_hold(world: World, reported: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        to_sdf(world)
    assert reported in str(caught.value)


def test_editing_makes_new_worlds() -> None:
    empty, can = load_world("empty"), load_model("coke_can")
    two = add_model(add_model(empty, can), replace(can, name="another"))
    assert [model.name for model in empty.models] == ["ground_plane"]
    assert [model.name for model in two.models] == ["ground_plane", "coke_can", "another"]
    assert two.model_by_name["coke_can"] == can
    assert remove_model(remove_model(two, "another"), "coke_can") == empty
    assert remove_model(empty, "sun").lights == ()
    assert remove_model(empty, "ground_plane").ground is None


def test_editing_what_is_not_there() -> None:
    world = load_world("empty")
    with pytest.raises(ResourceError, match="already has a model `ground_plane`; name it `ground_plane_1`"):
        add_model(world, load_model("ground_plane"))
    with pytest.raises(ResourceError, match="no model `ground_plan` in world `empty`; did you mean `ground_plane`"):
        remove_model(world, "ground_plan")
    with pytest.raises(ResourceError, match="no model `x` in world `empty`"):
        remove_model(world, "x")
    hung = World("w", models=(load_model("ball"),), joints=(WorldJoint("rope", "ball", "world", "ball::link"),))
    with pytest.raises(ResourceError, match="model `ball` is connected by joint `rope`"):
        remove_model(hung, "ball")


def test_joints_of_the_world_read_back_equal(tmp_path: Path) -> None:
    world = World("w", models=(load_model("ball"),), joints=(WorldJoint("rope", "ball", "world", "ball::link"),))
    path = tmp_path / "w.sdf"
    path.write_text(to_sdf(world))
    assert load_world(path) == world
