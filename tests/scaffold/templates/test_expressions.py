import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.errors import ResourceError
from urdfkit.scaffold.templates.expressions import holds, value_of

finite = st.floats(-1e6, 1e6)


@pytest.mark.parametrize(
    ("text", "value"), [("1 + 2*3", 7), (" -(a - 1)/2", -0.5), ("min(a, 1, 3)", 1), ("max(a, 0.5)", 2), ("1e-3", 0.001)]
)
def test_arithmetic(text, value):
    assert value_of(text, {"a": 2.0}) == pytest.approx(value)


@given(finite, finite)
def test_sums_are_python_s(a, b):
    assert value_of("a + b - a*b", {"a": a, "b": b}) == a + b - a * b


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_an_equality_up_to_rounding_is_at_least_and_not_less(a, b):
    names = {"a": a, "b": b, "c": (a / 3 + b) - a / 3 + a}
    assert holds("c >= a + b", names)
    assert holds("c <= a + b", names)


@pytest.mark.parametrize(("text", "true"), [("1 < 2", True), ("2 > 3", False), ("2 <= 2", True), ("2 >= 3", False)])
def test_comparisons(text, true):
    assert holds(text, {}) is true


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 +", "invalid expression"),
        ("b", "cannot compute `b`"),
        ("__import__('os')", "cannot compute"),
        ("a.real", "cannot compute `a.real`"),
        ("a ** 2", "cannot compute"),
        ("'x'", "cannot compute"),
        ("min()", "cannot compute"),
    ],
)
def test_nothing_else_is_understood(text, message):
    with pytest.raises(ResourceError, match=message):
        value_of(text, {"a": 1.0})


@pytest.mark.parametrize("text", ["1", "1 == 1", "1 < 2 < 3", "a in b"])
def test_what_is_no_comparison(text):
    with pytest.raises(ResourceError, match="is not a comparison of two values"):
        holds(text, {})
