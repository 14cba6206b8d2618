"""Replacement of limits and coefficients that no joint can have."""

from __future__ import annotations

from dataclasses import replace

from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Joint
from urdfkit.errors import with_effect
from urdfkit.sim.construction.repairs.inertia_tensors import repair_at
from urdfkit.sim.construction.validation import invalid_values

_EFFECTS = {
    "lower": ("J405", "the two are exchanged"),
    "effort": ("J410", "simulated without this limit"),
    "velocity": ("J410", "simulated without this limit"),
    "damping": ("J419", "simulated without damping"),
    "friction": ("J419", "simulated without friction"),
}
"""Code of the finding and effect of the repair, by attribute."""


def with_possible_values(joint: Joint) -> tuple[Joint, list[Repair]]:
    """Return a joint with possible limits and coefficients, and a repair for each replaced value."""
    repairs = []
    limit, dynamics = joint.limit, joint.dynamics
    for name, message, element in invalid_values(joint):
        code, effect = _EFFECTS[name]
        repairs.append(repair_at(element, "joint", code, with_effect(message, effect), joint=joint.name))
        if limit is not None and name == "lower":
            limit = replace(limit, lower=limit.upper, upper=limit.lower)
        elif limit is not None and name in ("effort", "velocity"):
            limit = replace(limit, **{name: None})  # type: ignore[arg-type]
        elif dynamics is not None:
            dynamics = replace(dynamics, **{name: 0.0})  # type: ignore[arg-type]
    return (replace(joint, limit=limit, dynamics=dynamics), repairs) if repairs else (joint, repairs)
