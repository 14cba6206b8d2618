"""Axes of consecutive joints: the lines that they turn about."""

from collections import Counter
from collections.abc import Iterator
from math import dist

from urdfkit.description.urdf.geometry import product, rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Joint, Robot, Vector
from urdfkit.lint.model.model import Model

_TURNING = ("revolute", "continuous")

_PARALLEL = 0.99999
"""Smallest cosine of the angle between axes on one line."""

_DISTANCE = 1e-4
"""Largest distance between two axes on one line [m]."""


def axis_in_root(joint: Joint, model: Model) -> Vector | None:
    """Return the axis of a joint in the root link; None if it is unknown."""
    parent, axis = model.frames.get(joint.parent or ""), unit(joint.axis)
    origin = joint.element.find("origin")
    if parent is None or axis is None or (origin is not None and model.is_unresolved(origin, "rpy")):
        return None
    return rotate(parent.moved(joint.origin).rotation, axis)


def on_one_line(model: Model) -> Iterator[tuple[Joint, Joint]]:
    """Yield each joint that turns about the same line as the moving joint that carries it: upper joint, lower joint.

    A joint that carries several moving joints, such as the waist of a humanoid, has an effect of its own. Joints
    without <origin> are not placed yet, and the place of one with an undefined property is unknown.
    """
    chains = [chain for joint in model.robot.joints if (chain := _up_to_turning_joint(joint, model.robot))]
    counts = Counter(chain[-1].name for chain in chains)
    alone = [chain for chain in chains if counts[chain[-1].name] == 1]
    for chain, is_on_line in zip(alone, model.facts.of(turn_about_one_line, alone), strict=True):
        origin = chain[0].element.find("origin") if is_on_line else None
        if origin is not None and not (model.is_unresolved(origin, "xyz") or model.is_unresolved(origin, "rpy")):
            yield chain[-1], chain[0]


def _up_to_turning_joint(joint: Joint, robot: Robot) -> tuple[Joint, ...]:
    """Return a moving joint, the fixed joints above it, and the turning joint that carries them; empty without one."""
    if not joint.is_movable:
        return ()
    chain = [joint]
    while len(chain) <= len(robot.joints):
        above = robot.parents_of.get(chain[-1].parent or "", ())
        if len(above) != 1:
            return ()
        chain += above
        if above[0].is_movable:
            return tuple(chain) if above[0].type in _TURNING else ()
    return ()


def turn_about_one_line(chain: tuple[Joint, ...]) -> bool:
    """Return whether the first and the last of some joints, with fixed joints between, turn about the same line."""
    joint, *fixed, carrier = chain
    if joint.type not in _TURNING or joint.mimic is not None or carrier.mimic is not None:
        return False
    axis, line = unit(joint.axis), unit(carrier.axis)
    if axis is None or line is None or joint.element.find("origin") is None:
        return False
    place, turn = joint.origin.xyz, rotation_of(joint.origin.rpy)
    for each in fixed:
        outer, offset = rotation_of(each.origin.rpy), each.origin.xyz
        x, y, z = rotate(outer, place)
        place, turn = (offset[0] + x, offset[1] + y, offset[2] + z), product(outer, turn)
    along = _dot(place, line)
    if dist((along * line[0], along * line[1], along * line[2]), place) >= _DISTANCE:
        return False
    return abs(_dot(rotate(turn, axis), line)) > _PARALLEL


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
