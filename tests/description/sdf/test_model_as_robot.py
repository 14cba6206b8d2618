"""Models of a world as robots: names, frames, axes and what belongs together."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.sdf import load_world, to_sdf
from urdfkit.description.sdf.link_groups import groups_of
from urdfkit.description.sdf.model_as_robot import tree_of
from urdfkit.description.urdf.geometry import compose, difference
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import DescriptionError, SimulationError

WORLD = """<sdf version="1.9"><world name="w"><model name="m"><pose>5 0 0 0 0 0</pose>{inside}</model></world></sdf>"""
JOINT = """<joint name="{name}" type="{kind}"><pose>{pose}</pose><parent>{parent}</parent><child>{child}</child>
<axis><xyz>0 0.6 0.8</xyz></axis></joint>"""


def joint(name: str, parent: str, child: str, *, kind: str = "revolute", pose: str = "0 0 0 0 0 0") -> str:
    return JOINT.format(name=name, parent=parent, child=child, kind=kind, pose=pose)


def model(folder: Path, inside: str):
    path = folder / "w.sdf"
    path.write_text(WORLD.format(inside=inside))
    return load_world(path).models[0]


def placed(tree, link: str) -> Pose:
    """Return where a link is in the model, by the joints alone."""
    above = tree.robot.parents_of.get(link)
    return compose(placed(tree, above[0].parent), above[0].origin) if above else tree.root


@pytest.mark.parametrize("pose", ["0 0 0 0 0 0", "0.1 -0.2 0.3 0.4 0.5 0.6"])
@pytest.mark.parametrize("ends", [("a", "b"), ("b", "a")])
def test_links_keep_their_frames(tmp_path: Path, pose: str, ends: tuple[str, str]) -> None:
    links = '<link name="a"><pose>1 2 3 0.1 0.2 0.3</pose></link><link name="b"><pose>-1 0 2 0.5 0 1</pose></link>'
    written = model(tmp_path, links + joint("j", *ends, pose=pose) + joint("k", "c", ends[1]) + '<link name="c"/>')
    (group,) = groups_of(written)
    tree = tree_of(written, group)
    for name, expected in tree.poses.items():
        assert difference(placed(tree, name), expected) < 1e-12
    hinge = tree.robot.joint_by_name["j"]
    turned = hinge.parent != ends[0]
    assert hinge.axis == ((0.0, -0.6, -0.8) if turned else (0.0, 0.6, 0.8))


def test_what_holds_together_is_one_and_the_rest_is_not(tmp_path: Path) -> None:
    links = "".join(f'<link name="{name}"/>' for name in "abcde")
    written = model(tmp_path, links + joint("j", "a", "c") + joint("g", "world", "e", kind="fixed"))
    groups = groups_of(written)
    assert [group.name for group in groups] == ["m::a", "m::b", "m::d", "m::e"]
    assert [group.moves for group in groups] == [True, False, False, False]
    assert [group.fixed_base for group in groups] == [False, False, False, True]


def test_plugins_of_a_nested_model_find_their_joints(tmp_path: Path) -> None:
    plugin = '<plugin name="p" filename="gz-sim-diff-drive-system"><left_joint>j</left_joint></plugin>'
    inner = f'<model name="car"><link name="a"/><link name="b"/>{joint("j", "a", "b")}{plugin}</model>'
    written = model(tmp_path, inner)
    tree = tree_of(written, groups_of(written)[0])
    assert tree.name == "m"
    assert tree.prefix == "car::"
    assert set(tree.robot.joint_by_name) == {"j"}
    assert [plugin.name for block in tree.robot.gazebo for plugin in block.plugins] == ["p"]


def mimic(name: str, leader: str, more: str = "") -> str:
    written = f'<mimic joint="{leader}">{more}</mimic></axis>'
    return joint(name, "a", f"{name}_link").replace("</axis>", written) + f'<link name="{name}_link"/>'


FOLLOWS = "<multiplier>-2</multiplier><offset>0.1</offset><reference>0.05</reference>"


def test_a_joint_that_follows_another(tmp_path: Path) -> None:
    leader = '<link name="a"/><link name="b"/>' + joint("j", "a", "b")
    path = tmp_path / "again.sdf"
    for written in (
        model(tmp_path, leader + mimic("k", "j", FOLLOWS)),
        model(tmp_path, f'<model name="in">{leader}{mimic("k", "j", FOLLOWS)}</model>'),
    ):
        found = tree_of(written, groups_of(written)[0]).robot.joint_by_name["k"].mimic
        assert (found.joint, found.multiplier, found.offset) == ("j", -2.0, pytest.approx(0.2))
        world = load_world(tmp_path / "w.sdf")
        path.write_text(to_sdf(world))
        assert load_world(path) == world


@pytest.mark.parametrize(
    ("inside", "says"),
    [
        (
            mimic("k", "jj"),
            "follows `jj`, which is not a moving joint of the same tree; did you mean `j`?",
        ),
        (mimic("k", "fix") + joint("fix", "world", "a", kind="fixed"), "`k` of model `m` follows `fix`, which is no"),
        (mimic("k", "l") + mimic("l", "k"), "joint `k` of model `m` follows itself through `k`, `l`"),
    ],
)
def test_a_joint_that_follows_what_cannot_be(tmp_path: Path, inside: str, says: str) -> None:
    written = model(tmp_path, '<link name="a"/><link name="b"/>' + joint("j", "a", "b") + inside)
    with pytest.raises(SimulationError) as error:
        tree_of(written, groups_of(written)[0])
    assert says in str(error.value)


@pytest.mark.parametrize(
    ("element", "says"),
    [("<mimic/>", "names no joint to follow"), ('<mimic joint="j" axis="axis2"/>', "only <axis> can be")],
)
def test_a_mimic_that_cannot_be_read(tmp_path: Path, element: str, says: str) -> None:
    with pytest.raises(DescriptionError, match=says):
        model(
            tmp_path, '<link name="a"/><link name="b"/>' + joint("j", "a", "b").replace("</axis>", element + "</axis>")
        )
