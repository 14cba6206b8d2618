"""Each threshold of a rule, from both sides: the value in the place of `@` decides whether and how it is reported."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint


def inertial(mass: str, moments: str = "1 1 1", xyz: str = "0 0 0") -> str:
    xx, yy, zz = moments.split()
    tensor = f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>'
    return f'<inertial><origin xyz="{xyz}"/><mass value="{mass}"/>{tensor}</inertial>'


def box(size: str, kind: str = "visual") -> str:
    return f'<{kind}><geometry><box size="{size}"/></geometry></{kind}>'


def link(*inside: str, name: str = "arm") -> str:
    return f'<link name="{name}">{"".join(inside)}</link>'


def joint(inside: str = "", *, type: str = "revolute", parent: str = "base", child: str = "arm") -> str:
    return (
        f'<joint name="to_{child}" type="{type}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'
        f'<link name="{child}"/>'
    )


def disc(inside: str, rpy: str = "0 0 0", length: str = "0.05") -> str:
    """Return a wheel with the axis y."""
    shape = f'<origin rpy="{rpy}"/><geometry><cylinder radius="0.1" length="{length}"/></geometry>'
    wheel = joint(f'<axis xyz="0 1 0"/>{inside}', type="continuous", child="wheel")
    return '<link name="base"/>' + wheel.replace(
        '<link name="wheel"/>', link(f"<visual>{shape}</visual>", name="wheel")
    )


def cart(
    left: str = "0 0.2 0",
    right: str = "0 -0.2 0",
    *,
    axis: str = "0 1 0",
    right_axis: str = "0 1 0",
    drive: str = "",
    more: str = "",
) -> str:
    """Return a robot with two driven balls, 0.4 m apart unless they are placed elsewhere."""
    ball = '<visual><geometry><sphere radius="0.1"/></geometry></visual>'
    wheels = "".join(
        joint(f'<origin xyz="{xyz}"/><axis xyz="{along}"/>', type="continuous", child=side).replace(
            f'<link name="{side}"/>', link(ball, name=side)
        )
        for side, xyz, along in (("left", left, axis), ("right", right, right_axis))
    )
    plugin = (
        '<gazebo><plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">'
        f"<left_joint>to_left</left_joint><right_joint>to_right</right_joint>{drive}</plugin></gazebo>"
    )
    return f'<link name="base"/>{wheels}{plugin}{more}'


def caster(place: str, radius: str = "0.05") -> str:
    shape = f'<visual><geometry><sphere radius="{radius}"/></geometry></visual>'
    ball = joint(f'<origin xyz="{place}"/>', type="fixed", child="caster")
    return ball.replace('<link name="caster"/>', link(shape, name="caster"))


def slip(ixx: str = "0.045", izz: str = "0.0045") -> str:
    """Return a cube of 0.3 m and 3 kg, whose moments are 0.045 kg·m²."""
    return link(inertial("3", f"{ixx} 0.045 {izz}"), box("0.3 0.3 0.3"))


def angle(rpy: str) -> str:
    return link(f'<visual><origin rpy="{rpy}"/>{box("1 1 1").removeprefix("<visual>")}')


def same_tensors(size: str) -> str:
    sizes = ("1 1 1", "1 1 1", size)
    links = [link(inertial("2"), box(size), name=f"part_{i}") for i, size in enumerate(sizes)]
    return "".join(links)


def optical(rpy: str, parent: str = "camera") -> str:
    return f'<link name="{parent}"/>' + joint(
        f'<origin rpy="{rpy}"/>', type="fixed", parent=parent, child="camera_optical_frame"
    )


def offsets(xyz: str, type: str = "fixed") -> str:
    origin = f'<origin xyz="{xyz}"/>'
    return (
        link(name="base")
        + joint(origin, type=type, child="pole")
        + joint(origin, type="fixed", parent="pole", child="lamp")
    )


CUBE = box("2 2 2")
"""Its corners are 1.732 m from its centre."""
THIN = joint('<limit effort="@" velocity="1" lower="-1" upper="1"/>')
SPHERE = '<visual><geometry><sphere radius="@"/></geometry></visual>'
MESH = '<visual><geometry><mesh filename="plate.obj" scale="@"/></geometry></visual>'
PLATE = "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n"
"""A mesh of 3 m by 4 m, thus of 5 m."""

UNKNOWN_SIZES = (
    link(MESH.replace("plate.obj", "missing.obj"), name="base")
    + joint('<origin xyz="0 0 12"/>', type="fixed")
    + joint('<origin xyz="@"/>', type="fixed", parent="arm", child="hand")
)
TWINS = '<link name="base"/>' + "".join(
    joint('<origin xyz="@"/><axis xyz="0 1 0"/>', type="continuous", child=f"{side}_wheel").replace(
        f'<link name="{side}_wheel"/>', link(box("0.1 0.1 0.1"), name=f"{side}_wheel")
    )
    for side in ("left", "right")
)
FOLLOWER = joint('<limit lower="-1" upper="1" effort="1" velocity="1"/>') + joint(
    '<limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="to_arm" multiplier="@" offset="-0.9"/>',
    parent="arm",
    child="hand",
)

CASES: list[tuple[str, str, dict[str, str]]] = [
    # inertia-not-positive-definite: up to 1e-9 of the largest moment
    ("I502", link(inertial("1", "1 1 @")), {"1e-8": "", "1e-10": "warning", "0": "warning", "-1": "error"}),
    ("I502", link(inertial("@", "1 1 -1")), {"0": "error", "-1": "", "0.5": "error"}),
    # inertia-triangle-inequality: notes for rounded numbers, 1e-9 to 1e-4 of the largest moment
    ("I503", link(inertial("1", "1 1 @")), {"2": "", "2.000000001": "", "2.000001": "note", "2.00019": "note"}),
    ("I503", link(inertial("1", "1 1 @")), {"2.00021": "warning", "2.001": "warning", "2.003": "error", "5": "error"}),
    # inertia-zero: only next to a positive mass
    ("I504", link(inertial("@", "0 0 0")), {"0": "", "-1": "", "1e-9": "error"}),
    # inertia-decimal-slip: the other moments within 1.7, the scaled one within 1.5, at most a factor of 1000
    ("I506", slip(ixx="@"), {"0.081": "", "0.072": "error", "0.028": "error", "0.025": ""}),
    ("I506", slip(izz="@"), {"0.007": "", "0.0063": "warning", "0.0032": "warning", "0.0028": ""}),
    ("I506", slip(izz="@"), {"4.5e-5": "warning", "4.5e-6": "", "45": "error", "450": "", "0.045": ""}),
    # inertia-vs-geometry-too-large: 1.2 times 1.732 m, without visuals three times
    ("I507", link(inertial("1", "1 1 @"), CUBE), {"4.31": "", "4.33": "warning"}),
    ("I507", link(inertial("1", "1 1 @"), box("2 2 2", "collision")), {"26.9": "", "27.1": "warning"}),
    ("I507", link(inertial("@", "4 4 4"), CUBE), {"0": "", "-1": "", "0.9": "warning"}),
    # inertia-vs-geometry-too-small: a twentieth of 1.732 m
    ("I508", link(inertial("1", "1e-9 1e-9 @"), CUBE), {"0.0076": "", "0.0074": "warning", "0": "warning"}),
    ("I508", link(inertial("@", "1e-9 1e-9 1e-9"), box("2 2 2", "collision")), {"0.009": "", "0.01": "warning"}),
    # inertia-copy-paste: at least three links, and sizes that differ by more than a tenth
    ("I510", same_tensors("@"), {"1 1 1": "", "1.09 1.09 1.09": "", "1.11 1.11 1.11": "note"}),
    # com-outside-geometry: a tenth of the diagonal, at least 5 mm; without visuals the whole diagonal
    ("I513", link(inertial("1", xyz="@ 0 0"), box("1 1 1")), {"0.67": "", "0.68": "warning", "-0.68": "warning"}),
    ("I513", link(inertial("1", xyz="@ 0 0"), box("0.01 0.01 0.01")), {"0.0099": "", "0.0101": "warning"}),
    ("I513", link(inertial("1", xyz="@ 0 0"), box("1 1 1", "collision")), {"2.22": "", "2.24": "warning"}),
    ("I513", link(inertial("@", xyz="9 0 0"), box("1 1 1", "collision")), {"0.009": "", "0.01": "warning"}),
    ("I513", link(inertial("@", xyz="9 0 0"), box("1 1 1")), {"0": "", "-1": "", "0.001": "warning"}),
    # mass-vs-volume: from 1 kg/m³ to 25,000 kg/m³
    ("I514", link(inertial("@"), box("1 1 1")), {"1": "", "0.99": "warning", "0.01": "", "0.02": "warning"}),
    ("I514", link(inertial("@"), box("1 1 1")), {"25000": "", "25001": "warning"}),
    # negative-effort-or-velocity
    ("J410", link(name="base") + THIN, {"0": "", "-0.5": "error", "0.5": ""}),
    # axis-not-along-wheel: 10 degrees, for a cylinder that is shorter than its diameter
    ("J414", disc("", rpy="@ 0 0"), {"1.57": "", "1.41": "", "1.39": "warning", "0": "warning"}),
    ("J414", disc("", length="@"), {"0.2": "", "0.19": "warning"}),
    # continuous-with-position-limits: only a note for a whole turn
    ("J415", disc('<limit lower="-3" upper="@"/>'), {"3.28": "note", "3.27": "warning"}),
    ("J415", disc('<limit lower="0" upper="@"/>'), {"0": "note", "0.1": "warning"}),
    # rpy-in-degrees: more than a turn, at most two turns in degrees, whole or half degrees
    ("J408", angle("0 0 @"), {"6": "", "6.5": "warning", "90.3": "", "720": "warning", "720.5": "", "-90": "warning"}),
    # nan-or-inf
    ("E012", link(inertial("@")), {"1e10": "", "10000000000": "", "1.1e10": "error", "20000000000": "error"}),
    ("E012", link(inertial("@")), {"-2e10": "error", "1E11": "error", "9999999999": ""}),
    # mesh-scale-suspect: a mesh of 5 m, alone; of a link of 1 m by its inertia; next to a box of 5 m
    ("G604", link(MESH), {"20 20 20": "", "20.1 20.1 20.1": "warning"}),
    ("G604", link(inertial("1", "0.81 0.81 0.81"), MESH), {"10 10 10": "", "10.1 10.1 10.1": "warning"}),
    ("G604", link(box("3 4 0"), name="base") + link(MESH), {"49 49 49": "", "51 51 51": "warning"}),
    ("G604", link(box("3 4 0"), name="base") + link(MESH), {"9990 1 1": "warning", "17000 1 1": ""}),
    ("G604", link(box("3 4 0"), name="base") + link(MESH), {"0.021 0.021 0.021": "", "0.019 0.019 0.019": "warning"}),
    ("G604", link(box("3 4 0"), name="base") + link(MESH), {"1.1e-4 1.1e-4 1.1e-4": "warning"}),
    ("G604", link(box("3 4 0"), name="base") + link(MESH), {"9e-5 9e-5 9e-5": ""}),
    # nonpositive-primitive
    ("G611", link(SPHERE), {"0": "warning", "1e-9": "", "-1": "error"}),
    # redundant-pi-definition: within 2 mrad of a multiple of π, π/2 or π/4, at least three digits, below 100
    ("X112", angle("0 0 @"), {"3.14": "note", "3.1397": "note", "3.1395": "", "3.1435": "note", "3.1437": ""}),
    ("X112", angle("0 0 @"), {"3.1415926": "", "3.14159": "note", "1.57": "note", "0.785": "note", "0.78": ""}),
    ("X112", angle("0 0 @"), {"-1.57": "note", "-3.1": "", "97.389": "note", "100.531": "", "0": ""}),
    # optical-frame-convention: 2 mrad
    ("S905", optical("-1.5707963 0 @"), {"-1.5707963": "", "-1.5697": "", "-1.5678": "note", "1.5707963": "note"}),
    ("S905", optical("0 0 0", "@"), {"camera": "note", "CAMERA_OPTICAL": ""}),
    # double-offset: at least two components
    ("S906", offsets("@"), {"0.1 0 0": "", "0.1 0.2 0": "warning", "0 0 0": "", "0 -0.1 0.2": "warning"}),
    # wheel-separation and wheel-diameter: a twentieth
    ("S901", cart(drive="<wheel_separation>@</wheel_separation>"), {"0.381": "", "0.379": "warning"}),
    ("S901", cart(drive="<wheel_separation>@</wheel_separation>"), {"0.419": "", "0.421": "warning"}),
    ("S902", cart(drive="<wheel_radius>@</wheel_radius>"), {"0.0951": "", "0.0949": "warning"}),
    ("S902", cart(drive="<wheel_radius>@</wheel_radius>"), {"0.1049": "", "0.1051": "warning"}),
    # left-right-swapped: the left wheel farther to the right than ahead, or both axes to the right
    ("S903", cart("0 @ 0", "0.1 0 0"), {"-0.09": "", "-0.11": "warning", "0.11": ""}),
    ("S903", cart(axis="@", right_axis="0 -1 0"), {"0 -1 0": "warning", "0 1 0": "", "0.8 -0.6 0": ""}),
    # drive-wheels-misaligned: 1 cm between the wheels; 1 cm or a twentieth in height; opposite axes
    ("S907", cart("0 @ 0", "0 0 0"), {"0.009": "warning", "0.011": ""}),
    ("S907", cart("0 0.2 @"), {"0.019": "", "0.021": "warning", "-0.021": "warning"}),
    ("S907", cart("0 0.05 @", "0 -0.05 0"), {"0.009": "", "0.011": "warning"}),
    ("S907", cart(right_axis="@"), {"0 -1 0": "warning", "0.6 -0.8 0": ""}),
    # caster-off-the-ground: 60 mrad of tilt, or a tenth of the radius of the wheels below the ground
    ("S908", cart(more=caster("-0.3 0 @")), {"-0.05": "", "-0.033": "", "-0.031": "warning"}),
    ("S908", cart(more=caster("-0.3 0 @")), {"-0.054": "", "-0.056": "warning"}),
    ("S908", cart(more=caster("-0.3 0 @")), {"0.149": "warning", "0.151": ""}),
    # joint-origin-too-far: without sizes, more than 20 times the distance of all other joints, which is not zero
    ("J421", UNKNOWN_SIZES, {"0 0 0.59": "warning", "0 0 0.61": "", "0 0 0.04": "warning", "0 0 0": ""}),
    # twins-misplaced: no coordinate has the wrong sign if all are zero
    ("S909", TWINS, {"0 0 0": "", "0 1 0": "warning"}),
    # mimic-beyond-limits: at most half of the range is within the limits; a joint that does not move has no range
    ("J423", FOLLOWER, {"1": "", "3": "warning"}),
    ("J423", FOLLOWER.replace("-0.9", "2"), {"0.1": "warning", "0": ""}),
    # collision-unlike-visual: three times as large on two sides
    ("G620", link(CUBE, box("@", "collision")), {"9 2.4 2": "", "9 5 2": "", "9 6.1 2": "warning"}),
]


@pytest.mark.parametrize(
    ("code", "body", "value", "severity"),
    [(code, body, value, severity) for code, body, cases in CASES for value, severity in cases.items()],
    ids=[f"{i}-{code}-{value}" for i, (code, _, cases) in enumerate(CASES) for value in cases],
)
def test_a_value_on_either_side_of_a_threshold(code: str, body: str, value: str, severity: str, write) -> None:
    write("plate.obj", PLATE.encode())
    found = lint(write("r.urdf", body.replace("@", value)), select=(code,))
    assert [finding.severity for finding in found] == [severity] * bool(severity)


@pytest.mark.parametrize(
    ("code", "body", "message"),
    [
        ("I510", same_tensors("2 2 2"), "3 links of different sizes share this inertia: part_0, part_1, part_2"),
        (
            "I510",
            same_tensors("2 2 2") + link(inertial("2"), name="part_3"),
            "4 links of different sizes share this inertia: part_0, part_1, part_2 …",
        ),
        ("J409", disc('<limit effort="0" velocity="1"/>'), "effort limit of joint `to_wheel` is zero"),
        ("J409", disc('<limit effort="0" velocity="0"/>'), "effort and velocity limits of joint `to_wheel` are zero"),
        ("E007", f"<link name='a'>{'x' * 40}</link>", "x" * 40),
        ("E007", f"<link name='a'>{'x' * 41}</link>", "x" * 39 + "…"),
    ],
)
def test_messages_shorten_what_they_list(code: str, body: str, message: str, write) -> None:
    (finding,) = lint(write("r.urdf", body), select=(code,))
    assert message in finding.message


@pytest.mark.parametrize("roll", ["1.5708", "-1.5708"])
def test_the_suggested_axis_of_a_wheel_points_left(roll: str, write) -> None:
    wheel = disc("", rpy=f"{roll} 0 0").replace('xyz="0 1 0"', 'xyz="1 0 0"')
    (finding,) = lint(write("r.urdf", wheel), select=("J414",))
    assert 'write <axis xyz="0 1 0"/>' in (finding.help or "")
