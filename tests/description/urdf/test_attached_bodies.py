"""Links on a heavier body, found in time that is linear in the number of links."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.urdf import attached_bodies
from urdfkit.description.urdf.attached_bodies import AttachedBodies

INERTIAL = '<inertial><mass value="{0}"/><inertia ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"/></inertial>'
JOINT = '<joint name="j{0}" type="{2}"><parent link="l{1}"/><child link="l{0}"/><axis xyz="0 0 1"/></joint>'


def bodies(folder: Path, masses: list[float], joints: list[tuple[int, int, str]]) -> tuple[AttachedBodies, list]:
    path = folder / "r.urdf"
    links = "".join(f'<link name="l{n}">{INERTIAL.format(mass)}</link>' for n, mass in enumerate(masses))
    path.write_text(f'<robot name="r">{links}{"".join(JOINT.format(*joint) for joint in joints)}</robot>')
    robot = load(path)
    return AttachedBodies(robot), list(robot.links)


def test_only_links_fixed_to_a_much_heavier_one_are_small(tmp_path: Path) -> None:
    joints = [(1, 0, "fixed"), (2, 1, "continuous"), (3, 2, "fixed"), (4, 3, "fixed")]
    found, links = bodies(tmp_path, [0.01, 1.0, 0.01, 0.01, 1.0], joints)
    assert [found.is_small(link) for link in links] == [True, False, True, True, False]
    assert [found.is_fixed(link) for link in links] == [False, True, False, True, True]
    assert [found.is_negligible(link) for link in links] == [False, False, False, True, False]
    assert not any(found.is_fixed_to_world(link) for link in links)


@pytest.mark.parametrize("mass", [1.0, 0.001])
def test_two_equal_links_are_not_small(mass: float, tmp_path: Path) -> None:
    found, links = bodies(tmp_path, [mass, mass], [(1, 0, "fixed")])
    assert [found.is_small(link) for link in links] == [False, False]


def test_each_link_is_read_twice_at_most(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    count, calls = 500, []
    found, links = bodies(tmp_path, [1.0] * count, [(n, n // 2, "fixed") for n in range(1, count)])
    monkeypatch.setattr(attached_bodies, "_moment", lambda link: calls.append(link) or 1.0)
    assert not any(map(found.is_negligible, links))
    assert len(calls) <= 2 * count


def test_links_that_fixed_joints_connect_in_either_direction_are_one_body(tmp_path: Path) -> None:
    joints = [(1, 0, "fixed"), (2, 0, "fixed"), (3, 2, "continuous"), (4, 3, "fixed")]
    found, links = bodies(tmp_path, [1.0] * 5, joints)
    first, second, third, fourth, fifth = (found.body_of(link.name) for link in links)
    assert first == second == third != fourth == fifth
    assert found.body_of("unknown") == "unknown"
