"""Tensors of shapes against Pinocchio's, and the order their entries were given in."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.description.urdf.principal_moments import is_possible
from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.facts.inertia.inertia_from_shapes import tensor_of
from urdfkit.lint.project.options import Options

LINK = """<link name="a"><inertial>{origin}<mass value="{mass}"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>{shapes}</link>"""


def tensor(write, shapes: str, mass: float, origin: str = "") -> tuple[float, ...]:
    path = write("r.xacro", LINK.format(origin=origin, mass=mass, shapes=shapes))
    model = model_of(path, Options())
    values = tensor_of(model.robot.links[0], model.extents["a"], mass)
    assert values is not None
    return values


def collision(geometry: str, origin: str = "") -> str:
    return f"<collision>{origin}<geometry>{geometry}</geometry></collision>"


def entries(matrix: np.ndarray) -> list[float]:
    return [matrix[0, 0], matrix[0, 1], matrix[0, 2], matrix[1, 1], matrix[1, 2], matrix[2, 2]]


@pytest.mark.parametrize(
    ("geometry", "theirs"),
    [
        ('<box size="0.1 0.2 0.3"/>', pin.Inertia.FromBox(2.0, 0.1, 0.2, 0.3)),
        ('<cylinder radius="0.1" length="0.4"/>', pin.Inertia.FromCylinder(2.0, 0.1, 0.4)),
        ('<sphere radius="0.2"/>', pin.Inertia.FromSphere(2.0, 0.2)),
    ],
)
def test_one_shape(write, geometry, theirs):
    np.testing.assert_allclose(tensor(write, collision(geometry), 2.0), entries(theirs.inertia), atol=1e-12)


def test_shapes_that_are_turned_and_moved_add_up_about_their_common_middle(write):
    box, ball = '<box size="0.1 0.2 0.3"/>', '<sphere radius="0.1"/>'
    shapes = collision(box, '<origin xyz="0.3 0 0.1" rpy="0.4 0.5 0.6"/>') + collision(ball, '<origin xyz="0 0.2 0"/>')
    volumes = np.array([0.006, 4 / 3 * np.pi * 0.001])
    masses = 3.0 * volumes / volumes.sum()
    placed = pin.SE3(pin.rpy.rpyToMatrix(0.4, 0.5, 0.6), np.array([0.3, 0, 0.1]))
    whole = placed.act(pin.Inertia.FromBox(masses[0], 0.1, 0.2, 0.3))
    whole += pin.SE3(np.eye(3), np.array([0, 0.2, 0])).act(pin.Inertia.FromSphere(masses[1], 0.1))
    ours = tensor(write, shapes, 3.0)
    np.testing.assert_allclose(ours, entries(whole.inertia), atol=1e-12)
    frame = pin.rpy.rpyToMatrix(0.1, 0.2, 0.3)
    turned = tensor(write, shapes, 3.0, '<origin rpy="0.1 0.2 0.3"/>')
    np.testing.assert_allclose(turned, entries(frame.T @ whole.inertia @ frame), atol=1e-12)


def test_what_a_body_can_have():
    assert is_possible((1.0, 0.0, 0.0, 1.0, 0.0, 1.0))
    assert not is_possible((1.0, 0.0, 0.0, 1.0, 0.0, 3.0))
    assert not is_possible((1.0, 2.0, 0.0, 1.0, 0.0, 1.0))


def test_only_one_order_may_explain_a_tensor(write):
    from urdfkit.lint import lint

    def codes(values: str) -> set[str]:
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        text = " ".join(f'{name}="{value}"' for name, value in zip(names, values.split(), strict=True))
        link = f'<link name="a"><inertial><mass value="2"/><inertia {text}/></inertial></link>'
        return {finding.code for finding in lint(write("r.xacro", link))}

    assert codes("0.02 0.03 0.04 0 0 0") == {"I505"}
    assert codes("0.02 0.001 0.03 0.002 0.0005 0.04") == {"I505"}  # By columns.
    assert codes("0.02 0 0 0.03 0 0.04") == set()
    assert codes("0.02 0.5 0.4 0.3 0.2 0.1") == {"I502"}
