"""The reference's robots and free bodies, as models of Pinocchio."""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from urdfkit.sim.engine.bodies import Body, Member
from urdfkit.sim.engine.layout.tree_arrays import pose_matrix
from urdfkit.sim.engine.simulation_memory import Arrays
from urdfkit.sim.engine.state_conversion import CoordinateLayout


class Tree:
    """A robot or free body: Pinocchio's model of it, and where it is in the arrays."""

    def __init__(self, model: Any, arrays: Arrays, number: int) -> None:
        self.model = model
        self.data = model.createData()
        self.model.gravity.linear = arrays["gravity"]
        # A model of what gravity does not pull: its weight is taken off again.
        self.weightless = pin.Model(self.model)
        first = int(arrays["tree_body"][number])
        for k in range(1, model.njoints):
            mass, centre = arrays["weightless"][first + k - 1], arrays["weightless_centre"][first + k - 1]
            self.weightless.inertias[k] = pin.Inertia(mass, centre, np.zeros((3, 3)))
        self.weightless_data = self.weightless.createData()
        self.number = number
        self.first_body = int(arrays["tree_body"][number])
        first, beyond = arrays["tree_dof"][number : number + 2].tolist()
        self.dofs = slice(first, beyond)
        entry = sum(int(n) ** 2 for n in np.diff(arrays["tree_dof"])[:number])
        self.entries = slice(entry, entry + (beyond - first) ** 2)
        self.coordinates = slice(*arrays["tree_s"][number : number + 2].tolist())
        self.layout = CoordinateLayout(model, arrays, number)

    def configuration(self, arrays: Arrays) -> NDArray[np.float64]:
        """Return its configuration in Pinocchio's layout."""
        return self.layout.configuration(arrays["s"][self.coordinates])


def model_of(member: Member) -> Any:
    """Return Pinocchio's model of a robot, its base bolted where it is."""
    model = pin.Model(member.kinematics.model)
    if not member.kinematics.floating_base:
        for joint in range(1, model.njoints):
            if model.parents[joint] == 0:
                model.jointPlacements[joint] = pin.SE3(pose_matrix(member.base)) * model.jointPlacements[joint]
    return model


def free_model(body: Body) -> Any:
    """Return Pinocchio's model of a free body."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), body.name)
    inertia = pin.Inertia(body.mass, np.array(body.centre, dtype=float), np.array(body.inertia, dtype=float))
    model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    return model
