"""Masses of links without them: from shapes, against trimesh and closed forms; the least, against the exact motion."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import trimesh

from urdfkit.description import load
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Robot
from urdfkit.kinematics import Kinematics
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.repairs.robot_repairs import repaired

INERTIAL = (
    '<inertial><origin xyz="{x} 0 0"/><mass value="{m}"/>'
    '<inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/></inertial>'
)
Repaired = Callable[..., tuple[Robot, list[Repair]]]


@pytest.fixture
def arm(tmp_path: Path) -> Repaired:
    """Return the repaired robot of a base and links in a chain, each turned by a joint about y."""

    def make(*links: str, density: float = 1000.0) -> tuple[Robot, list[Repair]]:
        text = f'<robot name="r">\n<link name="base">{INERTIAL.format(x=0, m=5, i=0.1)}</link>'
        parent = "base"
        for n, inside in enumerate(links):
            text += f'\n<link name="l{n}">{inside}</link><joint name="j{n}" type="continuous"><parent link="{parent}"/>'
            text += f'<child link="l{n}"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/></joint>'
            parent = f"l{n}"
        path = tmp_path / "r.urdf"
        path.write_text(text + "</robot>")
        found = Repairs(lambda _: None, density=density)
        robot, _ = repaired(load(path), None, found, floating=False)
        return robot, found.found

    return make


def shape(kind: str, geometry: str, origin: str = "0 0 0", rpy: str = "0 0 0") -> str:
    return f'<{kind}><origin xyz="{origin}" rpy="{rpy}"/><geometry>{geometry}</geometry></{kind}>'


def values(robot: Robot, link: str) -> tuple[float, np.ndarray, np.ndarray]:
    """Return mass, centre of mass and tensor of a link, in the axes of the link."""
    inertial = robot.link_by_name[link].inertial
    assert inertial is not None
    assert inertial.inertia is not None
    axes = pin.rpy.rpyToMatrix(*inertial.origin.rpy)
    return inertial.mass or 0.0, np.array(inertial.origin.xyz), axes @ np.array(inertial.inertia.rows) @ axes.T


def test_a_link_without_inertial_gets_the_mass_of_its_collision_shapes(arm: Repaired) -> None:
    visual = shape("visual", '<box size="9 9 9"/>')
    robot, (repair,) = arm(
        visual + shape("collision", '<cylinder radius="0.1" length="0.4"/>', "0 0.2 0", "1.5707963267948966 0 0"),
        density=800.0,
    )
    mass, centre, tensor = values(robot, "l0")
    expected = pin.Inertia.FromCylinder(800.0 * np.pi * 0.01 * 0.4, 0.1, 0.4)
    xx, _, zz = np.diag(expected.inertia)
    assert mass == pytest.approx(expected.mass, rel=1e-12)
    np.testing.assert_allclose(centre, (0, 0.2, 0), atol=1e-12)
    np.testing.assert_allclose(tensor, np.diag([xx, zz, xx]), atol=1e-12)
    assert (repair.kind, repair.code, repair.link, repair.joint) == ("mass", "I511", "l0", "j0")
    assert repair.position is not None
    assert repair.position.line == 3
    assert repair.message == (
        "link `l0` has no <inertial>, but joint `j0` moves it; simulated with 10.05 kg and 0.1592, 0.05027, 0.1592 "
        "kg·m² (from its shapes at 800 kg/m³)"
    )


def test_meshes_have_the_volume_and_tensor_of_trimesh(arm: Repaired, tmp_path: Path) -> None:
    mesh = trimesh.creation.annulus(0.05, 0.1, 0.3)
    mesh.apply_translation((0.1, 0.2, 0.3))
    mesh.export(tmp_path / "tube.stl")
    for kind in ("collision", "visual"):
        robot, _ = arm(shape(kind, '<mesh filename="tube.stl" scale="1 1 2"/>'))
        theirs = mesh.copy()
        theirs.apply_scale((1, 1, 2))
        theirs.density = 1000.0
        mass, centre, tensor = values(robot, "l0")
        assert mass == pytest.approx(theirs.mass, rel=1e-2)
        np.testing.assert_allclose(centre, theirs.center_mass, rtol=0, atol=1e-3)
        np.testing.assert_allclose(tensor, theirs.moment_inertia, rtol=0, atol=1e-2 * theirs.moment_inertia.max())


def test_an_open_mesh_counts_as_its_hull(arm: Repaired, tmp_path: Path) -> None:
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    trimesh.Trimesh(box.vertices, box.faces[:-1]).export(tmp_path / "open.stl")
    robot, _ = arm(shape("collision", '<mesh filename="open.stl"/>'))
    assert values(robot, "l0")[0] == pytest.approx(6.0, rel=1e-2)


def test_a_mass_of_zero_is_estimated_and_a_written_mass_kept(arm: Repaired) -> None:
    box = shape("collision", '<box size="0.1 0.1 0.1"/>')
    robot, (first, second) = arm(
        box + INERTIAL.format(x=0, m=0, i=0), box + '<inertial><origin xyz="0.01 0 0"/><mass value="3"/></inertial>'
    )
    assert values(robot, "l0")[0] == pytest.approx(1.0)
    mass, centre, tensor = values(robot, "l1")
    assert mass == 3.0
    np.testing.assert_allclose(centre, (0.01, 0, 0))
    np.testing.assert_allclose(tensor, 3.0 * 0.01 / 6.0 * np.eye(3), atol=1e-15)
    assert (first.code, second.code) == ("I501", "E014")


def test_a_negative_mass_is_not_replaced_by_an_estimate(arm: Repaired) -> None:
    box = shape("collision", '<box size="0.1 0.2 0.3"/>')
    robot, repairs = arm(f'{box}<inertial><mass value="-1"/></inertial>')
    inertial = robot.link_by_name["l0"].inertial
    assert inertial is not None
    assert (inertial.mass, inertial.inertia) == (-1.0, None)
    assert repairs == []


def test_a_mass_without_shapes_has_the_inertia_of_a_sphere(arm: Repaired) -> None:
    robot, (repair,) = arm(INERTIAL.format(x=0, m=2, i=0))
    radius = (3 * 2 / (4 * np.pi * 1000)) ** (1 / 3)
    np.testing.assert_allclose(values(robot, "l0")[2], 0.4 * 2 * radius**2 * np.eye(3), rtol=1e-12, atol=0)
    assert repair.code == "I504"


def test_a_mass_from_the_shape_of_a_fixed_link_names_that_link(arm: Repaired) -> None:
    fixed = '</link><joint name="f" type="fixed"><parent link="l0"/><child link="tip"/></joint><link name="tip">'
    visual = shape("visual", '<mesh filename="gone.stl"/>')
    _, (mass,) = arm(visual + fixed + shape("collision", '<box size="0.1 0.1 0.1"/>'))
    assert mass.link == "l0"
    assert mass.message.startswith("link `l0` has no <inertial>, but joint `j0` moves it; simulated with 1 kg and ")
    assert mass.message.endswith("(from the shapes of `tip` at 1000 kg/m³)")


def test_links_fixed_to_a_link_with_mass_are_not_repaired(arm: Repaired) -> None:
    robot, found = arm(INERTIAL.format(x=0.1, m=1, i=0.01))
    assert found == []
    assert values(robot, "l0")[0] == 1.0


def accelerations(robot: Robot, joints: int, q: np.ndarray, v: np.ndarray, tau: np.ndarray) -> np.ndarray:
    kinematics = Kinematics(robot)
    padded = [np.concatenate([each, np.zeros(kinematics.model.nv - joints)]) for each in (v, tau)]
    state = pin.neutral(kinematics.model)
    state = pin.integrate(kinematics.model, state, np.concatenate([q, np.zeros(kinematics.model.nv - joints)]))
    return np.asarray(pin.aba(kinematics.model, kinematics.data, state, *padded))[:joints]


def test_the_least_mass_changes_the_motion_of_the_rest_by_less_than_a_thousandth(arm: Repaired) -> None:
    heavy = [INERTIAL.format(x=0.15, m=1.0, i=0.01), INERTIAL.format(x=0.1, m=0.2, i=0.001)]
    exact, none = arm(*heavy)
    assert none == []
    robot, found = arm(*heavy, "", "")
    assert [repair.link for repair in found] == ["l2", "l3"]
    assert all("has no <inertial>" in repair.message for repair in found)
    mass, _, tensor = values(robot, "l2")
    assert 1e-6 < mass < 1e-3
    assert tensor[0, 0] > 0.0
    rng = np.random.default_rng(1)
    for _ in range(200):
        q, v, tau = rng.uniform(-np.pi, np.pi, 2), rng.normal(size=2), rng.normal(size=2)
        expected = accelerations(exact, 2, q, v, tau)
        found_ = accelerations(robot, 2, q, v, tau)
        assert np.linalg.norm(found_ - expected) < 1e-3 * np.linalg.norm(expected)


def test_links_that_carry_others_stay_without_mass(arm: Repaired, tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    arm("", INERTIAL.format(x=0.1, m=1, i=0.01))
    path.write_text(path.read_text().replace('<axis xyz="0 1 0"/>', '<axis xyz="0 0 1"/>', 1))
    found = Repairs(lambda _: None)
    robot, _ = repaired(load(path), None, found, floating=False)
    assert found.found == []
    assert robot.link_by_name["l0"].inertial is None


def test_links_that_carry_the_only_masses_have_their_mean(arm: Repaired) -> None:
    """As an arm without meshes, whose fingers alone have shapes: a mass without influence makes the steps diverge."""
    robot, found = arm("", "", INERTIAL.format(x=0.1, m=0.02, i=1e-5), INERTIAL.format(x=0.1, m=0.04, i=1e-5))
    assert values(robot, "l0")[0] == values(robot, "l1")[0] == pytest.approx((5.0 + 0.02 + 0.04) / 3.0)
    assert values(robot, "l2")[0] == 0.02
    assert all("the mean mass of the other links" in repair.message for repair in found)


def test_a_link_at_the_end_of_one_heavy_link_has_the_least_mass(arm: Repaired) -> None:
    robot, found = arm(INERTIAL.format(x=0.15, m=1.0, i=0.01), "")
    assert 1e-6 < values(robot, "l1")[0] < 1e-3
    assert "at most 0.05 %" in found[0].message


def test_a_robot_without_any_mass_gets_one(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text('<robot name="r"><link name="a"/></robot>')
    found = Repairs(lambda _: None)
    robot, _ = repaired(load(path), None, found, floating=True)
    assert values(robot, "a")[0] == 1.0
    assert "no other link has a mass" in found.found[0].message
