"""What the joint panel knows of each joint."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.kinematics import Kinematics

TURN = math.pi


def joint_rows(kinematics: Kinematics, positions: dict[str, float]) -> list[dict[str, Any]]:
    """Return one row per movable joint, in document order.

    Args:
        kinematics: the robot.
        positions: joint → position [rad or m].

    Returns:
        name, type, lower and upper (of the slider; ±π where there is no limit to an angle), limited, position, unit,
        mimic (the joint followed, or None).
    """
    rows = []
    for name in [*kinematics.joint_names, *kinematics.mimic_names]:
        joint = kinematics.robot.joint_by_name[name]
        lower, upper = kinematics.limits(name)
        limited = math.isfinite(lower) and math.isfinite(upper)
        reach = 1.0 if joint.type == "prismatic" else TURN
        rows.append(
            {
                "name": name,
                "type": joint.type,
                "lower": lower if limited else -reach,
                "upper": upper if limited else reach,
                "limited": limited,
                "position": positions.get(name, 0.0),
                "unit": "m" if joint.type == "prismatic" else "rad",
                "mimic": joint.mimic.joint if joint.mimic is not None else None,
            }
        )
    order = {joint.name: i for i, joint in enumerate(kinematics.robot.joints)}
    return sorted(rows, key=lambda row: order[str(row["name"])])


def home(kinematics: Kinematics) -> dict[str, float]:
    """Return zero for every joint, or the limit nearest to it [rad or m]."""
    positions = {}
    for name in kinematics.joint_names:
        lower, upper = kinematics.limits(name)
        positions[name] = min(max(0.0, lower), upper)
    return positions
