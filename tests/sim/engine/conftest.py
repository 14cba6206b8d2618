"""Robots and engines for the engine's tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.scene import scene_of
from urdfkit.sim.engine import Engine

EngineOf = Callable[..., Engine]


def link(name: str, mass: float, inertia: tuple[float, float, float], collision: str = "", *, at: str = "0 0 0") -> str:
    x, y, z = inertia
    return (
        f'<link name="{name}"><inertial><origin xyz="{at}"/><mass value="{mass}"/>'
        f'<inertia ixx="{x}" iyy="{y}" izz="{z}" ixy="0" ixz="0" iyz="0"/></inertial>{collision}</link>'
    )


def collision(geometry: str, *, xyz: str = "0 0 0", rpy: str = "0 0 0") -> str:
    return f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{geometry}</geometry></collision>'


def joint(
    name: str,
    type: str,
    parent: str,
    child: str,
    *,
    xyz: str = "0 0 0",
    rpy: str = "0 0 0",
    axis: str = "0 0 1",
    more: str = "",
) -> str:
    return (
        f'<joint name="{name}" type="{type}"><origin xyz="{xyz}" rpy="{rpy}"/><parent link="{parent}"/>'
        f'<child link="{child}"/><axis xyz="{axis}"/>{more}</joint>'
    )


def robot(*parts: str) -> str:
    return f'<robot name="probe">{"".join(parts)}</robot>'


HALF_TURN = "-1.5707963267948966 0 0"


def diff_drive() -> str:
    """A chassis on two driven wheels, 0.3 m apart, radius 0.06 m, and a ball in front; its root is on their axis."""
    chassis = collision('<box size="0.3 0.2 0.05"/>', xyz="0 0 0.03") + collision(
        '<sphere radius="0.03"/>', xyz="0.12 0 -0.03"
    )
    wheel = collision('<cylinder radius="0.06" length="0.03"/>')
    parts = [link("base", 5.0, (0.05, 0.07, 0.09), chassis, at="0.04 0 0.01")]
    for side, y in (("left", 0.15), ("right", -0.15)):
        parts.append(link(side, 0.4, (0.0005, 0.0005, 0.0009), wheel))
        parts.append(joint(f"{side}_wheel", "continuous", "base", side, xyz=f"0 {y} 0", rpy=HALF_TURN))
    return robot(*parts)


def four_wheels() -> str:
    """A chassis on four driven wheels, 0.4 m by 0.5 m apart, radius 0.1 m; its root is on the ground below them."""
    wheel = collision('<cylinder radius="0.1" length="0.04"/>', rpy="1.5707963267948966 0 0")
    parts = [link("base", 6.0, (0.1, 0.2, 0.25), at="0 0 0.1")]
    for name, x, y in (("lf", 0.2, 0.25), ("lr", -0.2, 0.25), ("rf", 0.2, -0.25), ("rr", -0.2, -0.25)):
        parts.append(link(name, 0.5, (0.0015, 0.0025, 0.0015), wheel))
        parts.append(joint(f"{name}_wheel", "continuous", "base", name, xyz=f"{x} {y} 0.1", axis="0 1 0"))
    return robot(*parts)


def arm(*, damping: float = 0.0, friction: float = 0.0, axes: str = "zyzyzyz") -> str:
    """A serial arm on a fixed base, links 0.2 m long."""
    parts = ['<link name="base"/>']
    parent, dynamics = "base", f'<dynamics damping="{damping}" friction="{friction}"/>'
    for k, axis in enumerate(axes):
        vector = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}[axis]
        parts.append(link(f"l{k}", 1.0, (0.004, 0.0045, 0.001), at="0.01 0.02 0.1"))
        limit = '<limit lower="-2.5" upper="2.5" effort="100" velocity="10"/>'
        parts.append(
            joint(
                f"j{k}",
                "revolute",
                parent,
                f"l{k}",
                xyz="0 0 0.2" if k else "0 0 0",
                axis=vector,
                more=limit + dynamics,
            )
        )
        parent = f"l{k}"
    return robot(*parts)


def body(geometry: str, *, mass: float = 2.0, inertia: tuple[float, float, float] = (0.02, 0.02, 0.02)) -> str:
    """One free body."""
    return robot(link("body", mass, inertia, collision(geometry)))


MODELS = {
    "diff_drive": diff_drive(),
    "four_wheels": four_wheels(),
    "arm": arm(),
    "box": body('<box size="0.2 0.3 0.1"/>', inertia=(0.0166667, 0.00833333, 0.0216667)),
    "ball": body('<sphere radius="0.1"/>', inertia=(0.008, 0.008, 0.008)),
    "can": body('<cylinder radius="0.1" length="0.3"/>', inertia=(0.02, 0.02, 0.01)),
    "capsule": body('<capsule radius="0.1" length="0.3"/>', inertia=(0.02, 0.02, 0.01)),
    "pendulum": robot(
        '<link name="base"/>',
        link("bob", 1.0, (1e-9, 1e-9, 1e-9), at="0 0 -1"),
        joint("hinge", "continuous", "base", "bob", axis="0 1 0"),
    ),
    "flap": robot(
        '<link name="base"/>',
        link("flap", 1.0, (0.01, 0.01, 0.01), collision('<sphere radius="0.05"/>', xyz="1 0 0"), at="1 0 0"),
        joint("hinge", "continuous", "base", "flap", xyz="0 0 0.3", axis="0 1 0"),
    ),
    "double_pendulum": robot(
        '<link name="base"/>',
        link("upper", 1.0, (0.01, 0.01, 0.001), at="0 0 -0.5"),
        link("lower", 1.0, (0.01, 0.01, 0.001), at="0 0 -0.5"),
        joint("shoulder", "continuous", "base", "upper", axis="0 1 0"),
        joint("elbow", "continuous", "upper", "lower", xyz="0 0 -1", axis="0 1 0"),
    ),
    "plate": robot(link("plate", 2.0, (0.01, 0.03, 0.05))),
    "light_ball": body('<sphere radius="0.1"/>', mass=1.0, inertia=(0.004, 0.004, 0.004)),
    "flywheel": robot(
        '<link name="base"/>',
        link("wheel", 1.0, (0.01, 0.01, 0.02)),
        joint("axle", "continuous", "base", "wheel", more='<dynamics damping="0.03"/>'),
    ),
    "mimic_chain": robot(
        '<link name="base"/>',
        link("upper", 1.0, (0.02, 0.02, 0.001), at="0 0 -0.25"),
        link("lower", 1.0, (0.02, 0.02, 0.001), at="0 0 -0.25"),
        joint("leader", "continuous", "base", "upper", axis="0 1 0"),
        joint("follower", "continuous", "upper", "lower", xyz="0 0 -0.5", axis="0 1 0", more='<mimic joint="leader"/>'),
    ),
}


@pytest.fixture
def texts() -> dict[str, str]:
    """Return the URDF of each model by its name."""
    return MODELS


@pytest.fixture
def engine_of(tmp_path: Path) -> EngineOf:
    """Return a maker of engines: a model here by name or the text of a URDF, the class of the engine, its options."""

    def make(model: str, *, engine: type[Engine] = Engine, floating: bool | None = None, **options: object) -> Engine:
        text = MODELS.get(model, model)
        path = tmp_path / "probe.urdf"
        path.write_text(text)
        written = load(path)
        bolted = '<link name="base"/>' in text
        kinematics = Kinematics(written, floating_base=not bolted if floating is None else floating)
        return engine(kinematics, scene_of(written).shapes, **options)  # type: ignore[arg-type]

    return make
