"""The models of the benchmark's scenes, as URDF: every engine reads the same text.

Only what all three engines understand alike: primitives, explicit inertias along the link's axes, no transmissions.
"""

from __future__ import annotations

UPRIGHT = "0 0 0"
SIDEWAYS = "-1.5707963267948966 0 0"
"""Turns the z axis of a cylinder, and of the joint that carries it, to the robot's left."""


def link(name: str, mass: float, inertia: str, *collisions: str, at: str = "0 0 0") -> str:
    """Return a link; `inertia` is its diagonal about the centre of mass `at`."""
    ixx, iyy, izz = inertia.split()
    return (
        f'<link name="{name}"><inertial><origin xyz="{at}"/><mass value="{mass}"/><inertia ixx="{ixx}" ixy="0" '
        f'ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>{"".join(collisions)}</link>'
    )


def collision(geometry: str, xyz: str = "0 0 0") -> str:
    """Return a collision shape."""
    return f'<collision><origin xyz="{xyz}"/><geometry><{geometry}/></geometry></collision>'


def joint(
    name: str,
    parent: str,
    child: str,
    xyz: str,
    *,
    rpy: str = UPRIGHT,
    axis: str = "0 0 1",
    limits: tuple[float, float, float] | None = None,
) -> str:
    """Return a continuous joint, or with `limits` (both ends [rad] and effort [N·m]) a revolute one."""
    end = ""
    if limits is not None:
        lower, upper, effort = limits
        end = f'<limit lower="{lower}" upper="{upper}" effort="{effort}" velocity="20"/>'
    return (
        f'<joint name="{name}" type="{"revolute" if limits else "continuous"}"><parent link="{parent}"/>'
        f'<child link="{child}"/><origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{end}</joint>'
    )


def wheel(name: str, xyz: str, *, radius: float, width: float, mass: float, parent: str = "base") -> str:
    """Return a solid wheel and the joint ``<name>_joint`` that turns it; a positive speed drives forwards."""
    across, along = mass * (3.0 * radius**2 + width**2) / 12.0, 0.5 * mass * radius**2
    shape = collision(f'cylinder radius="{radius}" length="{width}"')
    return link(name, mass, f"{across} {across} {along}", shape) + joint(
        f"{name}_joint", parent, name, xyz, rpy=SIDEWAYS
    )


def robot(name: str, *parts: str) -> str:
    """Return a URDF."""
    return f'<?xml version="1.0"?>\n<robot name="{name}">{"".join(parts)}</robot>\n'


def diff_drive() -> str:
    """A chassis on two wheels 0.3 m apart, radius 0.06 m, and a ball in front; its root is on their axis."""
    chassis = collision('box size="0.3 0.2 0.05"', "0 0 0.03")
    ball = collision('sphere radius="0.03"', "0.12 0 -0.03")
    return robot(
        "diff_drive",
        link("base", 5.0, "0.05 0.07 0.09", chassis, ball, at="0.04 0 0.01"),
        *(
            wheel(f"{side}_wheel", f"0 {y} 0", radius=0.06, width=0.03, mass=0.4)
            for side, y in (("left", 0.15), ("right", -0.15))
        ),
    )


def skid_steer() -> str:
    """A chassis on four driven wheels at (±0.2, ±0.2) m, radius 0.08 m."""
    return robot(
        "skid_steer",
        link("base", 10.0, "0.08 0.22 0.28", collision('box size="0.5 0.3 0.1"', "0 0 0.05"), at="0 0 0.02"),
        *(
            wheel(f"{end}_{side}_wheel", f"{x} {y} 0", radius=0.08, width=0.04, mass=0.5)
            for end, x in (("front", 0.2), ("rear", -0.2))
            for side, y in (("left", 0.2), ("right", -0.2))
        ),
    )


def car() -> str:
    """A car of 20 kg: front wheels that steer, rear wheels that drive; wheelbase 0.6 m, track 0.5 m, radius 0.1 m."""
    parts = [link("base", 20.0, "0.5 0.9 1.2", collision('box size="0.8 0.35 0.15"', "0 0 0.1"), at="0 0 0.05")]
    for side, y in (("left", 0.25), ("right", -0.25)):
        parts.append(wheel(f"rear_{side}_wheel", f"-0.3 {y} 0", radius=0.1, width=0.04, mass=1.0))
        parts.append(link(f"{side}_knuckle", 0.3, "0.001 0.001 0.001"))
        parts.append(joint(f"{side}_steering", "base", f"{side}_knuckle", f"0.3 {y} 0", limits=(-0.6, 0.6, 50.0)))
        name = f"front_{side}_wheel"
        parts.append(wheel(name, "0 0 0", radius=0.1, width=0.04, mass=1.0, parent=f"{side}_knuckle"))
    return robot("car", *parts)


def _arm_links(parent: str, at: str, mass: float) -> str:
    """Return seven links of 0.2 m on hinges about z and y in turn, carried by `parent`."""
    parts = []
    for k in range(7):
        along, across = 0.001 * mass, 0.004 * mass
        shape = collision('cylinder radius="0.04" length="0.14"', "0 0 0.1")
        parts.append(link(f"link{k}", mass, f"{across} {1.1 * across} {along}", shape, at="0.01 0.02 0.1"))
        axis, place = "0 1 0" if k % 2 else "0 0 1", "0 0 0.2" if k else at
        parts.append(joint(f"joint{k}", parent, f"link{k}", place, axis=axis, limits=(-2.9, 2.9, 200.0)))
        parent = f"link{k}"
    return "".join(parts)


def arm() -> str:
    """Seven links of 1 kg and 0.2 m on a base that is bolted down."""
    return robot("arm", link("base", 1.0, "0.01 0.01 0.01"), _arm_links("base", "0 0 0", 1.0))


def mobile_manipulator() -> str:
    """A diff drive of 30 kg on wheels 0.5 m apart and two balls, with the arm (0.5 kg a link) on top."""
    chassis = collision('box size="0.6 0.4 0.16"', "0 0 0.08")
    balls = [collision('sphere radius="0.05"', f"{x} 0 -0.05") for x in (0.25, -0.25)]
    return robot(
        "mobile_manipulator",
        link("base", 30.0, "0.5 1.0 1.3", chassis, *balls, at="0 0 0.05"),
        *(
            wheel(f"{side}_wheel", f"0 {y} 0", radius=0.1, width=0.04, mass=1.0)
            for side, y in (("left", 0.25), ("right", -0.25))
        ),
        _arm_links("base", "0 0 0.18", 0.5),
    )


def box() -> str:
    """A box of 1 kg and 0.2 m."""
    inertia = "0.006666666666666667 " * 3
    return robot("box", link("base", 1.0, inertia, collision('box size="0.2 0.2 0.2"')))
