"""Arms and grippers that are found in a robot, and their names."""

from __future__ import annotations

import pytest

from urdfkit.description.urdf.parser import parse
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import KinematicsError, UnknownNameError
from urdfkit.kinematics.srdf.groups import EndEffector, PlanningGroup, find_groups, group_of_chain

MIMIC = '<mimic joint="{}"/>'


def joint(name: str, parent: str, kind: str = "revolute", mimic: str = "") -> str:
    """Return a joint to the link of its name."""
    inside = MIMIC.format(mimic) if mimic else ""
    return (
        f'<link name="{name}_link"/><joint name="{name}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{name}_link"/>{inside}</joint>'
    )


def chain(*names: str, base: str = "base") -> str:
    parents = (base, *(f"{name}_link" for name in names[:-1]))
    return "".join(joint(name, parent) for name, parent in zip(names, parents, strict=True))


def robot(*parts: str) -> Robot:
    return parse(document_of(Source("r.urdf", f'<robot name="r"><link name="base"/>{"".join(parts)}</robot>')))


def numbered(prefix: str, count: int) -> tuple[str, ...]:
    return tuple(f"{prefix}{k}" for k in range(count))


@pytest.mark.parametrize(
    ("prefixes", "names"),
    [
        (["joint_"], ["arm"]),
        (["left_joint_"], ["left_arm"]),
        (["l_", "r_"], ["left_arm", "right_arm"]),
        (["left_", "right_"], ["left_arm", "right_arm"]),
        (["a_", "b_"], ["arm", "arm_2"]),
        (["a_", "b_", "c_"], ["arm", "arm_2", "arm_3"]),
        (["front_left_", "front_right_"], ["front_arm", "front_arm_2"]),
    ],
)
def test_arms_have_the_word_that_their_joints_share(prefixes: list[str], names: list[str]) -> None:
    groups, effectors = find_groups(robot(*(chain(*numbered(prefix, 5)) for prefix in prefixes)))
    assert groups == [
        PlanningGroup(name, "base", f"{prefix}4_link", numbered(prefix, 5))
        for name, prefix in zip(names, prefixes, strict=True)
    ]
    assert effectors == []


@pytest.mark.parametrize(("count", "found"), [(3, 0), (4, 1)])
def test_an_arm_has_at_least_four_joints(count: int, found: int) -> None:
    assert len(find_groups(robot(chain(*numbered("joint_", count))))[0]) == found


def test_fixed_joints_are_passed_through_and_a_planar_base_is_none_of_the_arm() -> None:
    parts = (joint("ride", "base", "planar"), joint("mount", "ride_link", "fixed"))
    names = numbered("joint_", 4)
    ((group,), _) = find_groups(robot(*parts, chain(*names, base="mount_link")))
    assert group == PlanningGroup("arm", "mount_link", "joint_3_link", names)


def test_what_moves_beyond_an_arm_is_its_gripper() -> None:
    arm, tip = numbered("left_", 4), "left_3_link"
    palm = joint("palm", tip, "fixed")
    fingers = joint("thumb", "palm_link", "prismatic") + joint("finger", "palm_link", "prismatic", mimic="thumb")
    groups, effectors = find_groups(robot(chain(*arm), palm, fingers))
    assert groups == [
        PlanningGroup("left_arm", "base", tip, arm),
        PlanningGroup("left_gripper", "", "", ("thumb",)),
    ]
    assert effectors == [EndEffector("left_gripper_end", "palm_link", "left_gripper", "left_arm")]


def test_fingers_on_two_links_are_attached_to_the_end_of_the_arm() -> None:
    arm, tip = numbered("joint_", 4), "joint_3_link"
    palms = joint("one", tip, "fixed") + joint("two", tip, "fixed")
    fingers = joint("thumb", "one_link", "prismatic") + joint("finger", "two_link", "prismatic")
    _, effectors = find_groups(robot(chain(*arm), palms, fingers))
    assert effectors == [EndEffector("gripper_end", tip, "gripper", "arm")]


def test_a_chain_is_named_by_its_ends() -> None:
    names = numbered("joint_", 3)
    made = robot(chain(*names), joint("flange", "joint_2_link", "fixed"), joint("wheel", "base", "continuous"))
    assert group_of_chain(made, "mine", "joint_0_link", "flange_link") == PlanningGroup(
        "mine", "joint_0_link", "flange_link", ("joint_1", "joint_2")
    )
    for base, tip, error, message in (
        ("joint_0_link", "flang_link", UnknownNameError, "no link `flang_link`; did you mean `flange_link`"),
        ("flange_link", "base", KinematicsError, "group `mine`: `base` is not below `flange_link`"),
        ("joint_2_link", "flange_link", KinematicsError, "no joint moves between `joint_2_link` and `flange_link`"),
    ):
        with pytest.raises(error, match=message):
            group_of_chain(made, "mine", base, tip)
