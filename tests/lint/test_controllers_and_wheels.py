"""The tolerances between the parameters of a drive controller and the wheels of the robot."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

WHEEL = """<link name="{side}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<joint name="{side}_joint" type="continuous"><parent link="base"/><child link="{side}"/>
<origin xyz="{xyz}"/><axis xyz="{axis}"/></joint>
"""
MANIFEST = "<package format='3'><name>cart</name><version>1.0.0</version></package>"


def found(write, settings: str, left: str = "0 0.2 0", right: str = "0 -0.2 0", axis: str = "0 1 0") -> list[str]:
    write("cart/package.xml", MANIFEST)
    wheels = [WHEEL.format(side=side, xyz=xyz, axis=axis) for side, xyz in (("left", left), ("right", right))]
    model = write("cart/urdf/cart.urdf", '<link name="base"/>' + "".join(wheels))
    parameters = {"type": "diff_drive_controller/DiffDriveController"}
    parameters |= {"left_wheel_names": "[left_joint]", "right_wheel_names": "[right_joint]"}
    lines = [f"    {key}: {value}\n" for key, value in parameters.items()]
    lines += [f"    {line}\n" for line in settings.split("; ") if line]
    write("cart/config/drive.yaml", ("drive:\n  ros__parameters:\n" + "".join(lines)).encode())
    return [finding.message for finding in lint(model, select=("K970",))]


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ("wheel_separation: 0.365", None),
        ("wheel_separation: 0.362", "`wheel_separation` is 0.362 m, but "),
        ("wheel_separation: 0.439", None),
        ("wheel_separation: 0.441", "`wheel_separation` is 0.441 m, but "),
        ("wheel_separation: 0.2; wheel_separation_multiplier: 2.0", None),
        ("wheel_separation: 0.2; wheel_separation_multiplier: 1.5", "`wheel_separation` is 0.2 m, but "),
        ("wheel_separation: 0", None),
        ("wheel_radius: 0.0901", None),
        ("wheel_radius: 0.0899", "`wheel_radius` is 0.0899 m, but the radius of the wheels is 0.1 m"),
        ("wheel_radius: 0.1099", None),
        ("wheel_radius: 0.1101", "`wheel_radius` is 0.1101 m, but the radius of the wheels is 0.1 m"),
        ("wheel_radius: 0", None),
    ],
)
def test_a_tenth_of_the_robot_is_tolerated(settings: str, message: str | None, write) -> None:
    messages = found(write, settings)
    assert len(messages) == (message is not None)
    assert all(one.startswith(message) for one in messages)


@pytest.mark.parametrize(
    ("left", "right", "axis", "is_swapped"),
    [
        ("0 0.2 0", "0 -0.2 0", "0 1 0", False),
        ("0 -0.2 0", "0 0.2 0", "0 1 0", True),
        ("0 -0.2 0", "0 0.2 0", "0 -1 0", False),
        ("0.5 -0.2 0", "0 0.2 0", "0 1 0", False),
        ("0.3 -0.2 0", "0 0.2 0", "0 1 0", True),
    ],
    ids=["left", "right", "axes to the right", "farther ahead than aside", "farther aside than ahead"],
)
def test_a_left_wheel_on_the_right_side(left: str, right: str, axis: str, is_swapped: bool, write) -> None:
    messages = found(write, "", left, right, axis)
    assert len(messages) == is_swapped
    assert all("is on the right side" in message for message in messages)


def test_two_wheels_at_the_same_place(write) -> None:
    (message,) = found(write, "wheel_radius: 0.1", "0 0.2 0", "0 0.2 0")
    assert message == "wheels `left_joint` and `right_joint` are at the same place, 0 0.2 0 m"
