"""Formulas of inertia: the wrong one of three is found, and nothing else."""

from __future__ import annotations

import pytest

from urdfkit.lint.facts.inertia.inertia_formulas import slip

BOX = {"ixx": "${m*(y*y+z*z)/12}", "iyy": "${m*(x*x+z*z)/12}", "izz": "${m*(x*x+y*y)/12}"}
CAN = {"ixx": "${m*(3*r*r+h*h)/12}", "iyy": "${m*(3*r*r+h*h)/12}", "izz": "${m*r*r/2}"}
BALL = dict.fromkeys(("ixx", "iyy", "izz"), "${2*m*r*r/5}")


@pytest.mark.parametrize("right", [BOX, CAN, BALL])
def test_right_formulas_pass_whatever_they_look_like(right):
    assert slip(right) is None
    rewritten = {name: text.replace("m*", "(1.0)*mass*").replace("r*r", "r**2") for name, text in right.items()}
    assert slip(rewritten) is None
    turned = dict(zip(right, [right["izz"], right["ixx"], right["iyy"]], strict=True))
    assert slip(turned) is None


@pytest.mark.parametrize(
    ("formulas", "component", "shape", "right"),
    [
        ({**BOX, "izz": "${m*(x*x+z*z)/12}"}, "izz", "box", "m*(x*x+y*y)/12"),
        ({**BOX, "ixx": "${m*(y*y+z*z)/3}"}, "ixx", "box", "m*(y*y+z*z)/12"),
        ({**CAN, "izz": "${m*(3*r*r+h*h)/12}"}, "izz", "cylinder", "m*r*r/2"),
        ({**BALL, "iyy": "${2*m*r/5}"}, "iyy", "sphere", "2*m*r*r/5"),
    ],
)
def test_the_wrong_moment_is_named_with_what_it_should_be(formulas, component, shape, right):
    found = slip(formulas)
    assert found is not None
    assert (found.component, found.shape) == (component, shape)
    assert slip({**formulas, component: f"${{{found.right}}}"}) is None
    assert slip({**formulas, component: f"${{{right}}}"}) is None


@pytest.mark.parametrize(
    "formulas",
    [
        dict.fromkeys(BOX, "${2*m*r*r/3}"),
        {**BOX, "izz": "${f(m)}"},
        {**BOX, "izz": "0.1"},
        {**BOX, "izz": "${m*(x*x"},
        {**BOX, "izz": "${m*'x'}"},
        {"ixx": "${a}", "iyy": "${a}", "izz": "${a}"},
        {"ixx": "${m/0}", "iyy": "${m**r}", "izz": "${-r}"},
        {},
    ],
)
def test_what_is_not_understood_passes(formulas):
    assert slip(formulas) is None
