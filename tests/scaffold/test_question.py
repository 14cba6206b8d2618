import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.errors import UsageError
from urdfkit.scaffold import Question

RADIUS = Question("wheel_radius", "Radius", "number", default="0.1", unit="m", range=(0.01, 10))


@pytest.mark.parametrize(("typed", "answer"), [("0.25", "0.25"), (" .25 ", "0.25"), ("2.5e-1", "0.25"), ("1", "1")])
def test_numbers(typed, answer):
    assert RADIUS.accept(typed) == answer


@given(st.floats(0.01, 10))
def test_numbers_keep_ten_digits(value):
    assert float(RADIUS.accept(repr(value))) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        ("5cm", r"--wheel-radius `5cm` is no number \(in m\)"),
        ("", "is no number"),
        ("0", "--wheel-radius 0 m is out of range: 0.01 to 10 m"),
        ("-1", "out of range"),
        ("11", "out of range"),
        ("nan", "out of range"),
        ("inf", "out of range"),
    ],
)
def test_what_is_no_number(typed, message):
    with pytest.raises(UsageError, match=message):
        RADIUS.accept(typed)


def test_choices():
    ros = Question("ros", "ROS", "choice", choices=("jazzy", "noetic"))
    assert ros.accept(" noetic ") == "noetic"
    with pytest.raises(UsageError, match="--ros `humble` is not available; there is: jazzy, noetic"):
        ros.accept("humble")
    with pytest.raises(UsageError, match="did you mean `jazzy`"):
        ros.accept("jazy")


def test_computed_default():
    assert Question("b", "B", "number", default="= a/3").default_given({"a": "1", "name": "x"}) == "0.3333"
    assert Question("b", "B", "number", default="7").default_given({}) == "7"
    assert Question("b", "B", "package").default_given({}) is None


@pytest.mark.parametrize("typed", ["<b>", "a & b", 'say "x"', "", "two\nlines"])
def test_text_that_would_break_a_file(robot_template, typed):
    with pytest.raises(UsageError, match="cannot be written into the files"):
        robot_template.question("maintainer").accept(typed)


@pytest.mark.parametrize("typed", ["Zoë Müller-O'Neil, Jr. (Lab 3)", "李雷"])
def test_text(robot_template, typed):
    assert robot_template.question("maintainer").accept(typed) == typed


@pytest.mark.parametrize(
    "typed",
    [
        *("nobody", "a@b@c", "a b@c", "<a@b>", "joe@laptop", "me@localhost"),
        *("joe@x.y", "joe@host..de", "joe@büro.de", "joe@a.d3"),
    ],
)
def test_what_is_no_address(robot_template, typed):
    with pytest.raises(UsageError, match="not of the form name@host"):
        robot_template.question("email").accept(typed)


@pytest.mark.parametrize("typed", ["joe@example.org", "a.b+c@d-e.co.uk", "12345+joe@users.noreply.github.com"])
def test_what_is_an_address(robot_template, typed):
    assert robot_template.question("email").accept(typed) == typed


def test_flags():
    flag = Question("gripper", "Gripper", "flag", default="no")
    assert [flag.accept(text) for text in ("yes", "Y", "true", "no", "n", "False")] == ["yes"] * 3 + ["no"] * 3
    with pytest.raises(UsageError, match="--gripper `maybe` is neither yes nor no"):
        flag.accept("maybe")
