"""Legged robots, grippers and boxes of the scenes, as URDF: MuJoCo and urdfkit read the same text."""

from __future__ import annotations

from collections.abc import Sequence

from tests.bench.peers.urdf_models import collision, link, robot

PADS = ((0.09, 0.03), (0.09, -0.03), (-0.05, 0.03), (-0.05, -0.03))
"""Centres of the pads of a foot [m]."""


def hinge(
    name: str,
    parent: str,
    child: str,
    xyz: str,
    axis: str,
    *,
    kind: str = "revolute",
    limits: tuple[float, float] = (-2.8, 2.8),
    damping: float = 0.0,
) -> str:
    """Return a joint with limits and damping."""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>'
        f'<axis xyz="{axis}"/><limit lower="{limits[0]}" upper="{limits[1]}" effort="300" velocity="30"/>'
        f'<dynamics damping="{damping}"/></joint>'
    )


def rod(name: str, mass: float, length: float, radius: float, *more: str) -> str:
    """Return a link that extends downwards from its joint, with a cylinder as its shape."""
    across, along = mass * length**2 / 12.0, 0.5 * mass * radius**2
    shape = collision(f'cylinder radius="{radius}" length="{0.8 * length}"', f"0 0 {-0.5 * length}")
    return link(name, mass, f"{across} {across} {along}", shape, *more, at=f"0 0 {-0.5 * length}")


def box_link(name: str, mass: float, size: Sequence[float], centre: str = "0 0 0") -> str:
    """Return a link with a solid box as its shape."""
    x, y, z = (mass * side**2 / 12.0 for side in size)
    shape = collision('box size="{} {} {}"'.format(*size), centre)
    return link(name, mass, f"{y + z} {x + z} {x + y}", shape, at=centre)


def quadruped(damping: float = 0.0) -> str:
    """A trunk of 10 kg on four legs of three joints each; every foot is a ball."""
    parts = [box_link("trunk", 10.0, (0.4, 0.2, 0.1))]
    for end, x in (("front", 0.18), ("rear", -0.18)):
        for side, y in (("left", 0.12), ("right", -0.12)):
            leg = f"{end}_{side}"
            parts += [
                link(f"{leg}_hip", 0.5, "0.001 0.001 0.001"),
                rod(f"{leg}_thigh", 1.0, 0.2, 0.025),
                rod(f"{leg}_shank", 0.3, 0.2, 0.015, collision('sphere radius="0.02"', "0 0 -0.2")),
                hinge(f"{leg}_abduction", "trunk", f"{leg}_hip", f"{x} {y} 0", "1 0 0", damping=damping),
                hinge(f"{leg}_pitch", f"{leg}_hip", f"{leg}_thigh", "0 0 0", "0 1 0", damping=damping),
                hinge(f"{leg}_knee", f"{leg}_thigh", f"{leg}_shank", "0 0 -0.2", "0 1 0", damping=damping),
            ]
    return robot("quadruped", *parts)


LEGS = tuple(f"{end}_{side}" for end in ("front", "rear") for side in ("left", "right"))
"""Legs of `quadruped`."""


def _foot(name: str, pads: int) -> str:
    """Return a foot on four pads (16 contacts on level ground), or on two."""
    if pads == 4:
        shapes = [collision('box size="0.04 0.03 0.02"', f"{x} {y} -0.05") for x, y in PADS]
    else:
        shapes = [collision('box size="0.06 0.09 0.02"', f"{x} 0 -0.05") for x in (0.08, -0.04)]
    return link(name, 1.0, "0.001 0.003 0.003", *shapes, at="0.02 0 -0.03")


Part = tuple[str, str, str, float]
"""Name and axis of a joint, the link that it moves ("" for a small one without shape), and where that ends [m]."""


def _chain(before: str, parent: str, xyz: str, parts: Sequence[Part], damping: float) -> str:
    """Return links one after the other."""
    text = ""
    for name, axis, body, length in parts:
        child = f"{before}{name}_link"
        text += body.replace("LINK", child) if body else link(child, 0.3, "0.001 0.001 0.001")
        text += hinge(f"{before}{name}", parent, child, xyz, axis, limits=(-2.0, 2.0), damping=damping)
        parent, xyz = child, f"0 0 {-length}"
    return text


def humanoid(joints: int, damping: float = 0.0) -> str:
    """A humanoid of 25 joints on feet with four pads each, or of 42 with hands and feet with two.

    25: legs of six, arms of five, a waist of three. 42: arms of seven with five fingers of one joint, a neck of three.
    """
    x, y, z = "1 0 0", "0 1 0", "0 0 1"
    shank, thigh = rod("LINK", 3.0, 0.4, 0.05), rod("LINK", 5.0, 0.4, 0.06)
    upper, lower = rod("LINK", 1.5, 0.25, 0.04), rod("LINK", 1.0, 0.25, 0.035)
    parts = [box_link("pelvis", 8.0, (0.15, 0.25, 0.15)), box_link("torso", 20.0, (0.2, 0.35, 0.4), "0 0 0.25")]
    for name, axis, parent, child in (
        ("waist_yaw", z, "pelvis", "waist1"),
        ("waist_roll", x, "waist1", "waist2"),
        ("waist_pitch", y, "waist2", "torso"),
    ):
        if child != "torso":
            parts.append(link(child, 0.3, "0.001 0.001 0.001"))
        parts.append(hinge(name, parent, child, "0 0 0.1" if parent == "pelvis" else "0 0 0", axis, damping=damping))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        foot = _foot("LINK", 4 if joints == 25 else 2)
        leg = [("hip_yaw", z, "", 0.0), ("hip_roll", x, "", 0.0), ("hip_pitch", y, thigh, 0.4), ("knee", y, shank, 0.4)]
        leg += [("ankle_pitch", y, "", 0.0), ("ankle_roll", x, foot, 0.0)]
        parts.append(_chain(f"{side}_", "pelvis", f"0 {sign * 0.1} -0.1", leg, damping))
        arm = [("shoulder_pitch", y, "", 0.0), ("shoulder_roll", x, "", 0.0)]
        arm += [("shoulder_yaw", z, upper, 0.25), ("elbow", y, lower, 0.25)]
        hand = box_link("LINK", 0.4, (0.06, 0.08, 0.1), "0 0 -0.05")
        if joints == 42:
            arm += [("wrist_yaw", z, "", 0.0), ("wrist_roll", x, "", 0.0), ("wrist_pitch", y, hand, 0.1)]
        else:
            arm += [("wrist", z, hand, 0.1)]
        parts.append(_chain(f"{side}_", "torso", f"0 {sign * 0.24} 0.4", arm, damping))
        for k in range(5 if joints == 42 else 0):
            finger = rod("LINK", 0.05, 0.06, 0.008)
            at = f"0 {0.015 * (k - 2)} -0.1"
            parts.append(_chain(f"{side}_", f"{side}_wrist_pitch_link", at, [(f"finger{k}", y, finger, 0.0)], damping))
    if joints == 42:
        head = box_link("LINK", 3.0, (0.18, 0.15, 0.2), "0 0 0.15")
        neck = [("neck_yaw", z, "", 0.0), ("neck_roll", x, "", 0.0), ("neck_pitch", y, head, 0.0)]
        parts.append(_chain("", "torso", "0 0 0.45", neck, damping))
    return robot("humanoid", *parts)


def gripper() -> str:
    """Two fingers that slide along y, on a vertical slide with a fixed base."""
    parts = [link("stand", 1.0, "0.01 0.01 0.01"), box_link("palm", 1.0, (0.08, 0.2, 0.04), "0 0 0.08")]
    slide = (-0.5, 0.5)
    parts.append(hinge("lift", "stand", "palm", "0 0 0", "0 0 1", kind="prismatic", limits=slide))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        parts.append(box_link(f"{side}_finger", 0.2, (0.03, 0.02, 0.1)))
        at, axis = f"0 {0.06 * sign} 0", f"0 {-sign} 0"
        parts.append(hinge(f"{side}_slide", "palm", f"{side}_finger", at, axis, kind="prismatic", limits=(-0.03, 0.05)))
    return robot("gripper", *parts)


def brick(side: float, mass: float) -> str:
    """A cube."""
    return robot("brick", box_link("base", mass, (side, side, side)))


def table(x: float, y: float) -> str:
    """A plate of 5 cm."""
    return robot("table", box_link("base", 10.0, (x, y, 0.05)))
