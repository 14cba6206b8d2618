"""Random robots in URDF 1.2: quaternions, some near gimbal lock or not normalised, capsules, limits of acceleration."""

from __future__ import annotations

import numpy as np

KINDS = ("fixed", "revolute", "continuous", "prismatic", "floating")


def random_urdf(seed: int) -> str:
    """Return a tree of 3 to 12 links, each with a possible inertia and a capsule."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 13))
    parts = ['<robot name="random" version="1.2">', '<link name="link_0"/>']
    for number in range(1, count):
        parts += [_link(rng, number), _joint(rng, number)]
    return "\n".join([*parts, "</robot>"])


def _link(rng: np.random.Generator, number: int) -> str:
    moments = rng.uniform(1e-3, 1.0, 3)
    xx, yy, zz = moments[1] + moments[2], moments[0] + moments[2], moments[0] + moments[1]
    radius, length = rng.uniform(0.01, 0.3, 2)
    shape = f'{_origin(rng)}<geometry><capsule radius="{radius}" length="{length}"/></geometry>'
    return (
        f'<link name="link_{number}"><inertial>{_origin(rng)}<mass value="{rng.uniform(0.1, 10.0)}"/>'
        f'<inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"<visual>{shape}</visual><collision>{shape}</collision></link>"
    )


def _joint(rng: np.random.Generator, number: int) -> str:
    kind = KINDS[rng.integers(len(KINDS))]
    ends = 'lower="-2" upper="2"' if kind in ("revolute", "prismatic") else ""
    rates = 'acceleration="20" deceleration="30" jerk="400"' if rng.random() < 0.5 else ""
    loads = 'effort="7" velocity="3"' if kind != "floating" and rng.random() < 0.5 else ""
    limit = f"<limit {ends} {loads} {rates}/>" if kind != "fixed" else ""
    axis = " ".join(map(str, rng.normal(size=3)))
    return (
        f'<joint name="joint_{number}" type="{kind}"><parent link="link_{rng.integers(number)}"/>'
        f'<child link="link_{number}"/>{_origin(rng)}<axis xyz="{axis}"/>{limit}</joint>'
    )


def _origin(rng: np.random.Generator) -> str:
    xyz = " ".join(map(str, rng.uniform(-1.0, 1.0, 3)))
    way = rng.random()
    if way < 0.2:
        return f'<origin xyz="{xyz}" rpy="{" ".join(map(str, rng.uniform(-3.0, 3.0, 3)))}"/>'
    q = rng.normal(size=4)
    if way < 0.6:  # a pitch of a right angle, up to a tiny error
        half, tiny = rng.uniform(-3.0, 3.0), 10.0 ** rng.uniform(-16.0, -1.0)
        q = np.array([np.sin(half), np.cos(half), -np.sin(half), np.cos(half)]) + tiny * q
    if way < 0.8:
        q *= 10.0 ** rng.uniform(-3.0, 3.0) / np.linalg.norm(q)
    return f'<origin xyz="{xyz}" quat_xyzw="{" ".join(map(str, q))}"/>'
