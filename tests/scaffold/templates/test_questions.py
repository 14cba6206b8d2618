import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.errors import UsageError
from urdfkit.scaffold import Question

RADIUS = Question("wheel_radius", "Radius", "number", default="0.1", unit="m", range=(0.01, 10))


@pytest.mark.parametrize(("typed", "answer"), [("0.25", "0.25"), (" .25 ", "0.25"), ("2.5e-1", "0.25"), ("1", "1")])
def test_numbers(typed, answer):
    assert RADIUS.accept(typed) == answer


@pytest.mark.parametrize(("typed", "answer"), [("25 cm", "0.25"), ("25cm", "0.25"), (".5m", "0.5"), ("1e2 mm", "0.1")])
def test_numbers_with_their_unit(typed, answer):
    assert RADIUS.accept(typed) == answer


@pytest.mark.parametrize(
    ("unit", "typed", "answer"), [("kg", "500 g", "0.5"), ("m/s", "36 km/h", "10"), ("", "2", "2")]
)
def test_other_units(unit, typed, answer):
    assert Question("x", "X", "number", unit=unit).accept(typed) == answer


@given(st.floats(0.01, 10))
def test_numbers_keep_ten_digits(value):
    assert float(RADIUS.accept(repr(value))) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        ("5in", r"--wheel-radius `5in` is not a number \(in m, cm, mm\)"),
        ("5 kg", r"is not a number \(in m, cm, mm\)"),
        ("0,25", r"is not a number .*; did you mean `0\.25`\?"),
        ("1,000", r"is not a number \(in m, cm, mm\)$"),
        ("cm", "is not a number"),
        ("5000 cm", "out of range"),
        ("", "is not a number"),
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
    with pytest.raises(UsageError, match="--ros `humble` is not available; choose from: jazzy, noetic"):
        ros.accept("humble")
    with pytest.raises(UsageError, match="did you mean `jazzy`"):
        ros.accept("jazy")


def test_choices_however_they_are_written(robot_template):
    assert robot_template.question("license").accept("mit") == "MIT"
    assert robot_template.question("sensor").accept("Lidar and camera") == "lidar camera"
    assert robot_template.question("sensor").accept("none") == ""
    with pytest.raises(UsageError, match="is repeated"):
        robot_template.question("sensor").accept("lidar, Lidar")


def test_every_question_explains_itself(robot_template):
    explained = {question.name: question.explanation for question in robot_template.questions}
    assert all(explained.values())
    assert explained["base_length"] == "a number in m, 0.005 to 50"
    assert explained["license"] == "one of Apache-2.0, BSD-3-Clause, MIT"


def test_computed_default():
    assert Question("b", "B", "number", default="= a/3").default_after({"a": "1", "name": "x"}) == "0.3333"
    assert Question("b", "B", "number", default="7").default_after({}) == "7"
    assert Question("b", "B", "package").default_after({}) is None


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
    with pytest.raises(UsageError, match="use the form name@host"):
        robot_template.question("email").accept(typed)


@pytest.mark.parametrize("typed", ["joe@example.org", "a.b+c@d-e.co.uk", "12345+joe@users.noreply.github.com"])
def test_what_is_an_address(robot_template, typed):
    assert robot_template.question("email").accept(typed) == typed


def test_flags():
    flag = Question("gripper", "Gripper", "flag", default="no")
    assert [flag.accept(text) for text in ("yes", "Y", "true", "no", "n", "False")] == ["yes"] * 3 + ["no"] * 3
    with pytest.raises(UsageError, match="--gripper `maybe` is neither yes nor no"):
        flag.accept("maybe")


@pytest.mark.parametrize(
    "typed", ["rclcpp std_msgs", "rclcpp,std_msgs", "rclcpp, std_msgs,", "rclcpp  std_msgs rclcpp"]
)
def test_packages(typed):
    assert Question("depends", "Depends", "packages").accept(typed) == "rclcpp std_msgs"


def test_a_blank_in_a_package_between_commas_is_refused():
    with pytest.raises(UsageError, match=r"`bad dep` is not a valid ROS package name.*did you mean `bad_dep`"):
        Question("depends", "Depends", "packages").accept("rclcpp,bad dep")
