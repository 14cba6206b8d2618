"""Servos and their integrals for the reference: see `urdfkit.sim.engine.constraints.joint_servos`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.engine.simulation_memory import Arrays

Array = NDArray[np.float64]


def servos(a: Arrays) -> NDArray[np.bool_]:
    """Return which dofs have a servo."""
    return np.array((a["kp"] != 0.0) | (a["kd"] != 0.0) | (a["ki"] != 0.0))


def servo_effort(a: Arrays, v: Array, dt: float) -> Array:
    """Return what servos exert when the step ends at v [N·m or N], 0 where there is none."""
    position = a["s"][a["dof_s"]]
    effort = a["kp"] * (a["position_target"] - position - dt * v) + a["kd"] * (a["velocity_target"] - v)
    return np.where(servos(a), effort + a["i_part"], 0.0)


def set_integral_parts(a: Arrays, v: Array, dt: float) -> None:
    """Find the efforts of integrals halfway through a step that starts at v, and what is fed forward."""
    part = a["ki"] * (a["integral"] + 0.5 * dt * _error(a, v))
    a["i_part"][:] = a["feedforward"] + np.clip(part, a["i_min"], a["i_max"])


def grow_integrals(a: Arrays, mean: Array, dt: float) -> None:
    """Integrate errors over a step with this mean velocity."""
    error = _error(a, mean)
    for d in np.flatnonzero(a["ki"]):
        a["integral"][d] += dt * error[d]
        if a["antiwindup"][d]:
            ends = sorted((a["i_min"][d] / a["ki"][d], a["i_max"][d] / a["ki"][d]))
            a["integral"][d] = min(ends[1], max(ends[0], a["integral"][d]))


def _error(a: Arrays, v: Array) -> Array:
    of_position = (a["kp"] != 0.0) | (a["kd"] == 0.0)
    return np.where(of_position, a["position_target"] - a["s"][a["dof_s"]], a["velocity_target"] - v)
