"""Moments of solids and their union against closed forms, Pinocchio and trimesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import trimesh

from urdfkit.description.urdf import volume_moments
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere
from urdfkit.description.urdf.volume_moments import Moments, of_primitive, placed, union
from urdfkit.meshes.mesh_moments import moments
from urdfkit.scene import MeshLoader


def entries(matrix: np.ndarray) -> list[float]:
    return [matrix[0, 0], matrix[0, 1], matrix[0, 2], matrix[1, 1], matrix[1, 2], matrix[2, 2]]


def of(shape, xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0)):
    return shape, Pose(xyz, rpy), of_primitive(shape)


@pytest.mark.parametrize(
    ("shape", "theirs"),
    [
        (Box((0.1, 0.2, 0.3)), pin.Inertia.FromBox(2.0, 0.1, 0.2, 0.3)),
        (Cylinder(0.1, 0.4), pin.Inertia.FromCylinder(2.0, 0.1, 0.4)),
        (Sphere(0.2), pin.Inertia.FromSphere(2.0, 0.2)),
        (Capsule(0.1, 0.4), pin.Inertia.FromCapsule(2.0, 0.1, 0.4)),
    ],
)
def test_single_solids_are_pinocchios(shape, theirs):
    np.testing.assert_allclose(of_primitive(shape).tensor(2.0), entries(theirs.inertia), rtol=1e-9, atol=1e-12)


def test_solids_that_do_not_touch_add_up_exactly():
    whole, shared, mixed = union(
        [of(Box((0.1, 0.2, 0.3)), (0.3, 0.0, 0.1), (0.4, 0.5, 0.6)), of(Sphere(0.05), (0, 0.4, 0))]
    )
    volumes = np.array([0.006, 4 / 3 * np.pi * 0.05**3])
    first, second = 3.0 * volumes / volumes.sum()
    theirs = pin.SE3(pin.rpy.rpyToMatrix(0.4, 0.5, 0.6), np.array([0.3, 0, 0.1])).act(
        pin.Inertia.FromBox(first, 0.1, 0.2, 0.3)
    )
    theirs += pin.SE3(np.eye(3), np.array([0, 0.4, 0])).act(pin.Inertia.FromSphere(second, 0.05))
    assert (shared, mixed) == (0.0, False)
    np.testing.assert_allclose(whole.middle, theirs.lever, atol=1e-12)
    np.testing.assert_allclose(whole.tensor(3.0), entries(theirs.inertia), atol=1e-12)


def test_what_two_share_counts_once():
    # Two halves of one bar that overlap in its middle third.
    whole, shared, _ = union([of(Box((0.4, 0.1, 0.1)), (-0.1, 0, 0)), of(Box((0.4, 0.1, 0.1)), (0.1, 0, 0))])
    bar = of_primitive(Box((0.6, 0.1, 0.1)))
    assert shared == pytest.approx(0.002, rel=2e-3)
    assert whole.volume == pytest.approx(bar.volume, rel=1e-3)
    np.testing.assert_allclose(whole.tensor(2.0), bar.tensor(2.0), rtol=2e-3, atol=1e-5)


def test_what_is_inside_another_counts_for_nothing():
    outer = Cylinder(0.2, 0.3)
    whole, shared, _ = union([of(outer), of(Sphere(0.05), (0.05, 0, 0)), of(Capsule(0.03, 0.1), (0, -0.05, 0.02))])
    assert shared == pytest.approx(
        of_primitive(Sphere(0.05)).volume + of_primitive(Capsule(0.03, 0.1)).volume, rel=0.02
    )
    np.testing.assert_allclose(whole.tensor(1.0), of_primitive(outer).tensor(1.0), rtol=1e-3, atol=1e-5)


def test_the_same_shape_twice_counts_once():
    shape = of(Box((1.0, 1.0, 1.0)))
    assert union([shape, shape]) == union([shape])


def test_moving_there_and_back_changes_nothing():
    moments = placed(of_primitive(Box((0.1, 0.2, 0.3))), Pose((1.0, 2.0, 3.0), (0.0, 0.0, 1.0)))
    back = placed(placed(moments, Pose((-1.0, -2.0, -3.0))), Pose((0.0, 0.0, 0.0), (0.0, 0.0, -1.0)))
    np.testing.assert_allclose(back.second, of_primitive(Box((0.1, 0.2, 0.3))).second, atol=1e-12)
    assert isinstance(back, Moments)


def of_mesh(folder: Path, mesh: trimesh.Trimesh, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)):
    path = folder / "m.stl"
    path.write_bytes(mesh.export(file_type="stl"))
    return moments(MeshLoader().load(path, scale), path.name)


def test_a_closed_mesh_is_summed_up_and_may_be_mirrored(tmp_path):
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    box.apply_transform(trimesh.transformations.rotation_matrix(0.7, (1, 2, 3), (0.1, 0, 0)))
    box.apply_translation((0.3, 0.1, 0))
    for scale in ((1.0, 1.0, 1.0), (-2.0, 1.0, 1.0)):
        found, note = of_mesh(tmp_path, box, scale)
        theirs = box.copy()
        theirs.apply_transform(np.diag((*scale, 1.0)))
        theirs.density = 5.0 / theirs.volume
        assert note == ""
        np.testing.assert_allclose(found.middle, theirs.center_mass, atol=1e-6)
        np.testing.assert_allclose(found.tensor(5.0), entries(theirs.moment_inertia), rtol=1e-5, atol=1e-7)


def test_an_open_mesh_is_taken_as_its_hull_and_a_flat_one_has_no_volume(tmp_path):
    pytest.importorskip("scipy")
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    found, note = of_mesh(tmp_path, trimesh.Trimesh(box.vertices, box.faces[:-1]))
    assert "m.stl is not closed" in note
    assert found.volume == pytest.approx(0.006, rel=1e-6)
    flat, note = of_mesh(
        tmp_path, trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2]])
    )
    assert flat.volume == 0.0
    assert "flat" in note


@pytest.mark.slow
def test_many_shapes_in_a_row_that_overlap_are_their_box(monkeypatch):
    """Each of 80 boxes overlaps six others; the number of sample points is bounded."""
    checks = 0
    holds = volume_moments._holds

    def counted(*arguments):
        nonlocal checks
        checks += 1
        return holds(*arguments)

    monkeypatch.setattr(volume_moments, "_holds", counted)
    box = Box((1.0, 1.0, 1.0))
    whole, _, _ = union([(box, Pose((0.3 * k, 0.0, 0.0)), of_primitive(box)) for k in range(80)])
    assert whole.volume == pytest.approx(1.0 + 0.3 * 79, rel=5e-3)
    assert whole.middle == pytest.approx((0.3 * 79 / 2, 0.0, 0.0), abs=0.05)
    assert checks <= volume_moments.MAX_CHECKS
