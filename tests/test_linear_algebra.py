"""Products, norms and inverses next to numpy's, and that nothing simulated goes through OpenBLAS."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

import urdfkit
from urdfkit.linear_algebra import inverse_placement, matmul, symmetric_eigen, vector_norm
from urdfkit.scene.pose_matrices import pose_matrices

ROOMS = ("kinematics", "scene", "sim")
APART = ("gl", "self_collision", "reach", "torch_chain", "trimesh_shapes")
"""What computes nothing that is simulated or published: OpenGL, searches for collisions and reach, and exports."""


@pytest.mark.parametrize(
    ("a", "b"),
    [
        ((3,), (3,)),
        ((3, 3), (3,)),
        ((6,), (6, 4)),
        ((4, 4), (4, 4)),
        ((50, 3), (3, 3)),
        ((2, 5, 3), (3,)),
        ((2, 5, 3), (3, 4)),
    ],
)
def test_products(a, b):
    random = np.random.default_rng(0)
    a, b = random.normal(size=a), random.normal(size=b)
    np.testing.assert_allclose(matmul(a, b), a @ b, rtol=1e-13, atol=1e-14)


def test_norm_and_inverse():
    random = np.random.default_rng(0)
    assert vector_norm((3.0, 4.0, 12.0)) == 13.0
    for placement in pose_matrices(random.normal(size=(20, 7))):
        np.testing.assert_allclose(inverse_placement(placement) @ placement, np.eye(4), atol=1e-14)


@pytest.mark.parametrize("size", [1, 2, 3, 6, 20])
def test_eigenvalues_and_eigenvectors(size):
    matrix = np.random.default_rng(size).normal(size=(size, size))
    matrix += matrix.T
    values, axes = symmetric_eigen(matrix)
    np.testing.assert_allclose(values, np.linalg.eigvalsh(matrix), atol=1e-12)
    np.testing.assert_allclose(axes * values @ axes.T, matrix, atol=1e-12)
    np.testing.assert_allclose(axes.T @ axes, np.eye(size), atol=1e-13)


@pytest.mark.slow
def test_nothing_simulated_goes_through_openblas():
    found = []
    for room in ROOMS:
        for path in (Path(urdfkit.__file__).parent / room).rglob("*.py"):
            parts = path.relative_to(Path(urdfkit.__file__).parent).parts
            if any(part.startswith(APART) for part in parts):
                continue
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult):
                    found.append(f"{path}:{node.lineno}: @")
                if isinstance(node, ast.Call) and ast.unparse(node.func) in FORBIDDEN:
                    alone = ast.unparse(node.func) != "np.linalg.norm" or not node.keywords
                    found += [f"{path}:{node.lineno}: {ast.unparse(node.func)}"] * alone
    assert not found


FORBIDDEN = {
    *(
        "np.dot",
        "np.matmul",
        "np.linalg.norm",
        "np.linalg.inv",
        "np.linalg.solve",
        "np.linalg.eigh",
        "np.cov",
    ),
    *("np.tan", "np.arctan", "np.exp", "np.log", "np.power", "np.arcsin", "np.arccos"),
}
