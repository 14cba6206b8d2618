"""Validation of robots before the first step."""

from typing import Any

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.kinematics.model import Kinematics
from urdfkit.linear_algebra import vector_norm


def require_inertia(kinematics: Kinematics) -> None:
    """Refuse a robot with a joint that has nothing to move.

    Raises:
        SimulationError: a dof has no inertia in any configuration, with the joint's place in the description.
    """
    model: Any = kinematics.model
    masses = np.array([inertia.mass for inertia in model.inertias])
    if not np.isfinite(masses).all() or any(not np.isfinite(i.inertia).all() for i in model.inertias):
        raise SimulationError(f"robot `{kinematics.robot.name}` has a mass or inertia that is not finite")
    # Of each joint with all joints below it, which have higher numbers.
    turning = np.array([np.abs(each.inertia).max() > 0.0 or vector_norm(each.lever) > 0.0 for each in model.inertias])
    for joint in range(model.njoints - 1, 0, -1):
        parent = model.parents[joint]
        masses[parent] += masses[joint]
        turning[parent] |= turning[joint]
    for joint in range(1, model.njoints):
        kind = model.joints[joint]
        name = model.names[joint]
        written = kinematics.robot.joint_by_name.get(name)
        position = written.element.origin.position if written is not None else None
        link = (written.child if written is not None else kinematics.root) or ""
        if masses[joint] > 0.0 and (turning[joint] or kind.shortname().startswith("JointModelP")):
            continue
        lacks = "mass" if not masses[joint] > 0.0 else "moment of inertia"
        raise SimulationError(
            f"joint `{name}` moves link `{link}`, which has no {lacks}: give it an <inertial> "
            f"({lacks} greater than zero), or make the joint fixed",
            position=position,
        )
