"""Observations of all worlds of a batch, as arrays that each step overwrites."""

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array
from urdfkit.sim.batch.world_memory import WorldMemory
from urdfkit.sim.engine.simulation_memory import FOUND_CONTACTS, HAS_PAIRS, SLEEPING
from urdfkit.sim.simulator import Simulator


class Observations:
    """Positions, velocities, efforts and the base of the robot in every world.

    Args:
        simulator: the simulation that is copied.
        memory: memory of the worlds.

    Attributes:
        joints: joints with one degree of freedom, without mimic joints.
        positions: [rad] or [m]; shape (n, joints).
        velocities: [rad/s] or [m/s]; shape (n, joints).
        efforts: of motors and servos in the last step [N·m] or [N]; shape (n, joints).
        base_pose: x y z [m] and quaternion x y z w of the root link; shape (n, 7).
        base_twist: velocity [m/s] and angular velocity [rad/s] of the root link in its own axes; shape (n, 6).
    """

    def __init__(self, simulator: Simulator, memory: WorldMemory) -> None:
        kinematics, arrays, n = simulator.kinematics, simulator.world.builder.engine.arrays, len(memory.advance)
        types = {name: joint.type for name, joint in simulator.robot.joint_by_name.items()}
        one = ("continuous", "revolute", "prismatic")
        self.joints = tuple(name for name in kinematics.joint_names if types[name] in one)
        dofs = [kinematics.velocity_index(name) for name in self.joints]
        column = memory.floats.column
        columns = [column("s") + int(arrays["dof_s"][dof]) for dof in dofs]
        columns += [column(name) + dof for name in ("v", "effort") for dof in dofs]
        if kinematics.floating_base:
            columns += [*(column("s") + k for k in range(7)), *(column("v") + k for k in range(6))]
        self._rows, self._columns = memory.floats.rows, np.array(columns, dtype=np.intp)
        count = len(dofs)
        self._values = np.zeros((n, 3 * count + 13))
        self.positions, self.velocities, self.efforts, self.base_pose, self.base_twist = np.split(
            self._values, [count, 2 * count, 3 * count, 3 * count + 7], axis=1
        )
        self.base_pose[:] = simulator.state.base_pose

    def read(self, first: int, beyond: int) -> None:
        """Read the state of some worlds into the arrays."""
        found = self._rows[first:beyond].take(self._columns, axis=1)
        self._values[first:beyond, : found.shape[1]] = found


class LinkForces:
    """Sum of the contact forces on each link.

    Args:
        simulator: the simulation that is copied.
        memory: memory of the worlds.
    """

    def __init__(self, simulator: Simulator, memory: WorldMemory) -> None:
        engine = simulator.world.builder.engine
        links, self._memory, self._dt = simulator.kinematics.link_names, memory, simulator.dt
        self._link = np.array([*(links.index(s.link) if s.link in links and s.owner == 0 else -1
                                 for s in engine.collision_shapes), -1])  # fmt: skip
        self._alone = len(engine.arrays["tree_floats"]) == 1 and not engine.arrays["numbers"][HAS_PAIRS]
        self.forces = np.zeros((len(memory.advance), len(links), 3))

    def read(self) -> Array:
        """Return the forces of the last step in the world's axes [N]; shape (n, links, 3)."""
        counts, most = self._memory["counts"], self._memory["contact_row"].shape[1]
        self.forces[:] = 0.0
        places = np.arange(most)
        touching = places < counts[:, FOUND_CONTACTS, None]
        touching |= places >= most - counts[:, SLEEPING, None]  # those of what sleeps are kept at the end
        self._add(*np.nonzero(touching & (self._memory["contact_row"] >= 0)))
        return self.forces

    def _add(self, worlds: NDArray[np.int64], contacts: NDArray[np.int64]) -> None:
        memory = self._memory
        frames = memory["contact_frame"][worlds, contacts].reshape(-1, 3, 3)
        if self._alone:
            row, x = memory["contact_row"][worlds, contacts], memory["x"]
            rubs, last = memory["contact_mu"][worlds, contacts] > 0.0, x.shape[1] - 1
            sliding = (np.where(rubs, x[worlds, np.minimum(row + k, last)], 0.0) for k in (1, 2))
            impulses = np.stack([*sliding, x[worlds, row]], axis=1)
        else:
            impulses = memory["contact_impulse"][worlds, contacts]
        forces = np.einsum("kj,kji->ki", impulses, frames) / self._dt
        for name, sign in (("contact_shape", 1.0), ("contact_against", -1.0)):
            link = self._link[memory[name][worlds, contacts]]
            own = link >= 0
            np.add.at(self.forces, (worlds[own], link[own]), sign * forces[own])
