"""The tolerances between the parameters of a drive controller and the wheels of the robot."""

from __future__ import annotations

import pytest

from urdfkit.description.control.settings import Settings
from urdfkit.description.xml.source import Position
from urdfkit.errors import DescriptionError
from urdfkit.lint import lint

WHEEL = """<link name="{name}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<joint name="{name}_joint" type="continuous"><parent link="base"/><child link="{name}"/>
<origin xyz="{xyz}"/><axis xyz="{axis}"/></joint>
"""
MANIFEST = "<package format='3'><name>cart</name><version>1.0.0</version></package>"


def found(
    write,
    settings: str,
    left: str = "0 0.2 0",
    right: str = "0 -0.2 0",
    axis: str = "0 1 0",
    more: int = 0,
    sides: tuple[str, ...] = ("left", "right"),
    codes: tuple[str, ...] = ("K970",),
) -> list[str]:
    """Return the messages about a cart with these wheels, and with more wheels behind them."""
    write("cart/package.xml", MANIFEST)
    places = {"left": left, "right": right}
    for number in range(1, more + 1):
        places |= {f"{side}_{number}": f"-{number} {xyz.partition(' ')[2]}" for side, xyz in list(places.items())[:2]}
    wheels = [WHEEL.format(name=name, xyz=xyz, axis=axis) for name, xyz in places.items()]
    model = write("cart/urdf/cart.urdf", '<link name="base"/>' + "".join(wheels))
    parameters = {"type": "diff_drive_controller/DiffDriveController"}
    for side in sides:
        names = [f"{name}_joint" for name in places if name.startswith(side)]
        parameters[f"{side}_wheel_names"] = f"[{', '.join(names)}]"
    lines = [f"    {key}: {value}\n" for key, value in parameters.items()]
    lines += [f"    {line}\n" for line in settings.split("; ") if line]
    write("cart/config/drive.yaml", ("drive:\n  ros__parameters:\n" + "".join(lines)).encode())
    return [finding.message for finding in lint(model, select=codes)]


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


def test_of_exchanged_lists_of_wheels_the_first_is_reported(write) -> None:
    places = {"left": "0 -0.2 0", "right": "0 0.2 0", "more": 1}
    (message,) = found(write, "", **places)
    assert message == "left wheel `left_joint` of controller `drive` is on the right side, at y = -0.2 m"
    (message,) = found(write, "", **places, sides=("right", "left"))
    assert message == "right wheel `right_joint` of controller `drive` is on the left side, at y = 0.2 m"


def test_the_ros1_name_of_a_list_of_wheels() -> None:
    place = Position("drive.yaml", 3, 5)
    old = Settings("left_wheel", Position("drive.yaml", 3, 17), "left_joint", key=place)
    right = Settings("right_wheel_names", Position("drive.yaml", 4, 24), "right_joint")
    drive = Settings("drive", place, children={each.name: each for each in (old, right)})
    message = "`drive` has no `left_wheel_names`, but `left_wheel`, its name in ROS 1"
    with pytest.raises(DescriptionError, match=message) as raised:
        drive.text("left_wheel_names")
    assert raised.value.position == place


def test_two_wheels_at_the_same_place(write) -> None:
    (message,) = found(write, "wheel_radius: 0.1", "0 0.2 0", "0 0.2 0")
    assert message == "wheels `left_joint` and `right_joint` are at the same place, 0 0.2 0 m"


@pytest.mark.parametrize(
    ("more", "separation", "is_reported"),
    [(0, 0.5, True), (1, 0.5, False), (1, 0.79, False), (1, 0.81, True), (2, 0.79, False), (2, 0.81, True)],
)
def test_robots_that_skid_may_have_twice_the_separation(more: int, separation: float, is_reported: bool, write) -> None:
    messages = found(write, f"wheel_separation: {separation}", more=more)
    assert [message.partition(",")[0] for message in messages] == [
        f"`wheel_separation` is {separation} m"
    ] * is_reported


@pytest.mark.parametrize(("separation", "is_reported"), [(0.3, True), (0.4, False), (0.27, False), (0.5, True)])
def test_a_multiplier_for_slip_needs_the_separation_of_the_wheels(separation: float, is_reported: bool, write) -> None:
    messages = found(write, f"wheel_separation: {separation}; wheel_separation_multiplier: 1.5", more=1)
    assert [message.partition(",")[0] for message in messages] == [
        f"`wheel_separation` is {separation} m"
    ] * is_reported


CORNERS = [f"{axle}_{side}" for axle in ("front", "rear") for side in ("left", "right")]
ROLLER = """<link name="roller"/><joint name="roller_joint" type="continuous"><parent link="front_left"/>
<child link="roller"/><axis xyz="1 0 0"/></joint>"""


@pytest.mark.parametrize(
    ("settings", "joints", "more", "message"),
    [
        ("kinematics: {wheels_radius: 0.1}", CORNERS, "", None),
        (
            "kinematics: {wheels_radius: 0.2}",
            CORNERS,
            "",
            "`wheels_radius` is 0.2 m, but the radius of the wheels is 0.1 m",
        ),
        (
            "kinematics.wheels_radius: 0.2",
            CORNERS,
            "",
            "`kinematics.wheels_radius` is 0.2 m, but the radius of the wheels is 0.1 m",
        ),
        ("kinematics: {wheels_radius: 0.2}", CORNERS, ROLLER, None),
        (
            "kinematics: {wheels_radius: 0.1}",
            ["front_left", "front_right", "rear_left", "rear_left"],
            "",
            (
                "`rear_left_joint` is the joint of `rear_right_wheel_command_joint_name` "
                "and of `rear_left_wheel_command_joint_name`"
            ),
        ),
        (
            "kinematics: {wheels_radius: 0.1}",
            ["front_right", "front_right", "rear_left", "rear_right"],
            "",
            (
                "`front_right_joint` is the joint of `front_left_wheel_command_joint_name` "
                "and of `front_right_wheel_command_joint_name`"
            ),
        ),
    ],
)
def test_wheels_of_a_mecanum_controller(
    settings: str, joints: list[str], more: str, message: str | None, write
) -> None:
    write("cart/package.xml", MANIFEST)
    wheels = [WHEEL.format(name=name, xyz="0 0 0", axis="0 1 0").replace("visual", "collision") for name in CORNERS]
    model = write("cart/urdf/cart.urdf", '<link name="base"/>' + "".join(wheels) + more)
    names = zip(CORNERS, joints, strict=True)
    lines = [f"    {corner}_wheel_command_joint_name: {joint}_joint\n" for corner, joint in names]
    text = "drive:\n  ros__parameters:\n    type: mecanum_drive_controller/MecanumDriveController\n"
    write("cart/config/drive.yaml", (text + "".join(lines) + f"    {settings}\n").encode())
    messages = [finding.message for finding in lint(model, select=("K970", "K971"))]
    assert messages == ([message] if message is not None else [])


PLACES = {
    "front_left": "0.3 0.2 0",
    "front_right": "0.3 -0.2 0",
    "rear_left": "-0.3 0.2 0",
    "rear_right": "-0.3 -0.2 0",
}


@pytest.mark.parametrize(
    ("total", "joints", "message"),
    [
        (0.5, CORNERS, None),
        (0.54, CORNERS, None),
        (1.0, CORNERS, "is 1 m, but half of the wheelbase and half of the track are 0.5 m"),
        (0.5, ["front_left", "rear_right", "rear_left", "front_right"], "is at x = -0.3 m, y = -0.2 m"),
    ],
)
def test_places_of_the_wheels_of_a_mecanum_controller(
    total: float, joints: list[str], message: str | None, write
) -> None:
    write("cart/package.xml", MANIFEST)
    wheels = [
        WHEEL.format(name=name, xyz=xyz, axis="0 1 0").replace("visual", "collision") for name, xyz in PLACES.items()
    ]
    model = write("cart/urdf/cart.urdf", '<link name="base"/>' + "".join(wheels))
    names = zip(CORNERS, joints, strict=True)
    lines = [f"    {corner}_wheel_command_joint_name: {joint}_joint\n" for corner, joint in names]
    text = "drive:\n  ros__parameters:\n    type: mecanum_drive_controller/MecanumDriveController\n"
    last = f"    kinematics: {{wheels_radius: 0.1, sum_of_robot_center_projection_on_X_Y_axis: {total}}}\n"
    write("cart/config/drive.yaml", (text + "".join(lines) + last).encode())
    messages = [finding.message for finding in lint(model, select=("K970",))]
    assert len(messages) == (message is not None)
    assert all(message in one for one in messages)


FAMILY = """<robot name="{name}" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="radius" value="{radius}"/>
  <xacro:include filename="cart.xacro"/>
  <gazebo><plugin name="gazebo_ros2_control" filename="libgazebo_ros2_control.so">
    <parameters>$(find cart)/config/{loaded}.yaml</parameters></plugin></gazebo>
</robot>
"""


@pytest.mark.parametrize(("loaded", "files"), [("large", set()), ("small", {"config/small.yaml", "config/large.yaml"})])
def test_robots_of_a_family_have_their_own_parameters(loaded, files, write, monkeypatch, tmp_path) -> None:
    write("cart/package.xml", MANIFEST)
    wheels = [WHEEL.format(name=name, xyz=f"0 {y} 0", axis="0 1 0") for name, y in (("left", 0.2), ("right", -0.2))]
    write("cart/urdf/cart.xacro", '<link name="base"/>' + "".join(wheels).replace('"0.1"', '"${radius}"'))
    for name, radius, file in (("small", 0.1, "small"), ("large", 0.2, loaded)):
        write(f"cart/urdf/{name}.urdf.xacro", FAMILY.format(name=name, radius=radius, loaded=file).encode())
        names = "".join(f"    {side}_wheel_names: [{side}_joint]\n" for side in ("left", "right"))
        settings = f"    type: diff_drive_controller/DiffDriveController\n{names}    wheel_radius: {radius}\n"
        write(f"cart/config/{name}.yaml", f"drive:\n  ros__parameters:\n{settings}".encode())
    monkeypatch.chdir(tmp_path / "cart")
    assert {finding.file for finding in lint(".", select=("K970",))} == files


@pytest.mark.parametrize("name", ["wheel_separation", "wheel_radius"])
def test_two_files_that_contradict_one_property_are_one_finding_there(name: str, write) -> None:
    write("cart/package.xml", MANIFEST)
    wheels = [
        WHEEL.format(name=side, xyz=f"0 ${{{sign}track/2}} 0", axis="0 1 0").replace('"0.1"', '"${radius}"')
        for side, sign in (("left", ""), ("right", "-"))
    ]
    properties = '<xacro:property name="track" value="0.5"/>\n<xacro:property name="radius" value="0.125"/>\n'
    head = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="cart">\n'
    model = write(
        "cart/urdf/cart.urdf.xacro", (head + properties + '<link name="base"/>' + "".join(wheels) + "</robot>").encode()
    )
    values = {"wheel_separation": 0.5, "wheel_radius": 0.125} | {name: 0.2}
    lines = [f"    {key}: {value}\n" for key, value in values.items()]
    lines += [f"    {side}_wheel_names: [{side}_joint]\n" for side in ("left", "right")]
    text = "drive:\n  ros__parameters:\n    type: diff_drive_controller/DiffDriveController\n" + "".join(lines)
    write("cart/config/drive.yaml", text.encode())
    [alone] = lint(model, select=("K970",))
    assert alone.file.endswith("drive.yaml")
    write("cart/config/robot.yaml", text.encode())
    [both] = lint(model, select=("K970",))
    assert (both.file.endswith("cart.urdf.xacro"), both.line) == (True, 2 if name == "wheel_separation" else 3)
    assert len(both.related) == 2


@pytest.mark.parametrize(("radius", "count"), [("0.2", 1), ("0.1", 0)])
def test_the_collision_shapes_of_wheels_with_meshes_are_measured(write, monkeypatch, radius, count):
    mesh = '<visual><geometry><mesh filename="wheel.stl"/></geometry></visual>'
    shape = '<collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>'
    sphere = '<visual><geometry><sphere radius="0.1"/></geometry></visual>'
    monkeypatch.setattr(f"{__name__}.WHEEL", WHEEL.replace(sphere, mesh + shape))
    assert len(found(write, f"wheel_radius: {radius}")) == count
