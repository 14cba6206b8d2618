"""Suggestions: the same names as difflib finds, with a bounded number of comparisons."""

from __future__ import annotations

import difflib
import random

import pytest

from urdfkit import errors
from urdfkit.description.packages.similar_names import near_package
from urdfkit.description.plugins import unknown_plugins
from urdfkit.description.xml.cost_limit import loading_limit

PARTS = ("left", "right", "front", "rear", "wheel", "arm", "link", "joint", "camera", "base", "1", "2", "12")


def _names(chance: random.Random, count: int) -> list[str]:
    return list({"_".join(chance.choices(PARTS, k=chance.randrange(1, 4))) for _ in range(count)})


def _misspelt(chance: random.Random, name: str) -> str:
    at = chance.randrange(len(name))
    return chance.choice((name[:at] + name[at + 1 :], name[:at] + "x" + name[at:], name[::-1], name.upper(), ""))


@pytest.mark.parametrize("seed", range(20))
def test_the_most_similar_names_are_those_of_difflib(seed: int) -> None:
    chance = random.Random(seed)
    names = _names(chance, 30)
    for name in names:
        wrong, count, cutoff = _misspelt(chance, name), chance.randrange(1, 4), chance.choice((0.0, 0.6, 0.8))
        assert errors.similar(wrong, names, count=count, cutoff=cutoff) == difflib.get_close_matches(
            wrong, names, n=count, cutoff=cutoff
        )


def test_a_typo_is_found_among_thousands_of_similar_names_with_few_comparisons(monkeypatch) -> None:
    names = [f"link_abcdefgh_{number:05d}" for number in range(5_000)]
    rated, ratio = [], difflib.SequenceMatcher.ratio
    monkeypatch.setattr(difflib.SequenceMatcher, "ratio", lambda self: rated.append(1) or ratio(self))
    for number in (0, 17, 333, 4_321):
        for wrong in (f"link_abcdefg_{number:05d}", f"lnk_abcdefgh_{number:05d}", f"link_abcdefg_{number:05d}x"):
            for pool in (names, names[::-1]):
                rated.clear()
                assert errors.nearest(wrong, pool) == f"link_abcdefgh_{number:05d}"
                assert len(rated) <= errors.MAX_RATED


def test_names_in_lower_case_are_computed_once_for_a_pool(monkeypatch) -> None:
    calls, compute = [], errors._by_lower_case
    monkeypatch.setattr(errors, "_by_lower_case", lambda names: calls.append(1) or compute(names))
    pool = {"Base": 1, "Arm": 2}
    with loading_limit():
        assert [errors.nearest("base", pool) for _ in range(5)] == ["Base"] * 5
        assert len(calls) == 1
        pool["Hand"] = 3
        assert errors.nearest("hand", pool) == "Hand"
    assert len(calls) == 2


def test_loading_a_robot_limits_the_suggestions() -> None:
    names = [f"wheel_{number}" for number in range(errors.MAX_COMPARED // 2)]
    with loading_limit():
        assert [errors.nearest("wheel_x1", names) for _ in range(3)] == ["wheel_1"] * 2 + [None]
    assert errors.may_suggest()


@pytest.mark.parametrize(
    ("name", "others", "expected"),
    [
        ("vendor_description", ["seven_dof_arm_description"], ""),
        ("my_robot_bringup", ["other_robot_bringup"], ""),
        (
            "pandda_description",
            ["panda_description", "seven_dof_arm_description"],
            "; did you mean `panda_description`?",
        ),
        ("panda_desciption", ["panda_description"], "; did you mean `panda_description`?"),
    ],
)
def test_a_common_last_word_does_not_make_packages_similar(name: str, others: list[str], expected: str) -> None:
    assert near_package(name, others) == expected


@pytest.mark.parametrize(
    ("name", "expected"), [("gazebo_ros_force", ""), ("gazebo_ros_diff_driv", "gazebo_ros_diff_drive")]
)
def test_parts_of_most_names_do_not_make_libraries_similar(name: str, expected: str) -> None:
    assert unknown_plugins.nearest(name) == expected
