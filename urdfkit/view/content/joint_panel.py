"""Rows of the joint panel."""

import math
from typing import Any

from urdfkit.kinematics import Kinematics

TURN = math.pi


def joint_rows(kinematics: Kinematics, positions: dict[str, float]) -> list[dict[str, Any]]:
    """Return one row per joint variable, in document order.

    A planar or floating joint has a row for each of its variables, named as in `Kinematics.variable_names`.

    Args:
        kinematics: the robot.
        positions: joint or variable → position [rad or m].

    Returns:
        name, type, lower and upper (of the slider; ±π for an angle without limits), limited, position, unit (empty for
        the components of a quaternion), mimic (the followed joint or None) and its multiplier and offset.
    """
    rows = []
    for name in [*kinematics.variable_names, *kinematics.mimic_names]:
        joint = kinematics.robot.joint_by_name.get(name)
        part = "" if joint is not None else name.rpartition("/")[2]
        joint = joint or kinematics.robot.joint_by_name[name.rpartition("/")[0]]
        lower, upper = kinematics.limits(name) if not part else (-math.inf, math.inf)
        limited = math.isfinite(lower) and math.isfinite(upper)
        unit = _unit(str(joint.type), part)
        reach = TURN if unit == "rad" else 1.0
        coupling = kinematics.couplings.get(name)
        rows.append(
            {
                "name": name,
                "type": joint.type,
                "lower": lower if limited else -reach,
                "upper": upper if limited else reach,
                "limited": limited,
                "position": positions.get(name, 0.0),
                "unit": unit,
                "mimic": joint.mimic.joint if joint.mimic is not None else None,
                "multiplier": coupling.multiplier if coupling is not None else 1.0,
                "offset": coupling.offset if coupling is not None else 0.0,
            }
        )
    order = {joint.name: i for i, joint in enumerate(kinematics.robot.joints)}
    return sorted(rows, key=lambda row: order.get(str(row["name"]), order.get(str(row["name"]).rpartition("/")[0], 0)))


def _unit(type: str, part: str) -> str:
    if part:
        return "rad" if part == "theta" else "" if part.startswith("rot_") else "m"
    return "m" if type == "prismatic" else "rad"


def home(kinematics: Kinematics) -> dict[str, float]:
    """Return zero for every joint, or the limit nearest to it [rad or m]; floating joints are not rotated."""
    positions = {}
    for name in kinematics.variable_names:
        if name in kinematics.joint_names:
            lower, upper = kinematics.limits(name)
            positions[name] = min(max(0.0, lower), upper)
        else:
            positions[name] = 1.0 if name.endswith("/rot_w") else 0.0
    return positions
