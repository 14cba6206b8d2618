"""Engine: one robot and the ground, advanced in time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.kinematics.model import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine.arrays import ITERATED, Arrays
from urdfkit.sim.engine.model import fill, touching
from urdfkit.sim.engine.soundness import require_inertia
from urdfkit.sim.engine.state import configuration, contacts, positions, set_configuration, turning
from urdfkit.sim.engine.surface import Contact, Ground, Surface
from urdfkit.sim.engine.warmup import Kernel, kernel

Array = NDArray[np.float64]
Provider = Literal["compiled", "pinocchio"]

FLAT = Ground()
"""The ground where nothing else is said: at z = 0."""


class Engine:
    """A robot on the ground, advanced in steps of `dt`.

    Velocities, efforts and all per-dof arrays are in the order of ``kinematics.model``'s ``v``; a floating base has its
    twist in its own axes, linear first. Write `motor_velocity`, `motor_effort`, `applied`, `position_target`, `kp`
    and `kd` in place (``engine.motor_velocity[3] = 1.0``); they hold until written again.

    Args:
        kinematics: the robot; with a floating base it is free, without it is bolted to `base`.
        shapes: its collision shapes; shapes of another role are ignored.
        dt: length of a step [s].
        gravity: [m/s²].
        ground: the plane under it; None for none.
        surfaces: link name → `Surface`; a link that is not named has mu 1.
        base: pose of the root link of a robot without floating base, x y z [m] and quaternion x y z w.
        provider: who computes mass matrix, bias and Jacobians: the compiled kernel, or Pinocchio (the reference, slow).

    Raises:
        SimulationError: the robot cannot be simulated, e.g. a link that must move has no mass.

    Attributes:
        dt: [s].
        t: simulated time [s].
        steps: steps since the last `reset`.
        motor_velocity: target of the velocity motor of each dof [rad/s or m/s]; shape (nv,).
        motor_effort: what that motor can do [N·m or N]; 0 is no motor; shape (nv,).
        applied: effort added to each dof [N·m or N]; shape (nv,).
        position_target: target of the position servo of each dof [rad or m]; shape (nv,).
        kp: its stiffness, [N·m/rad] or [N/m]; 0 is none; shape (nv,).
        kd: its damping towards `velocity_target`, [N·m·s/rad] or [N·s/m]; 0 is none; shape (nv,).
        velocity_target: [rad/s or m/s]; shape (nv,).
        servo_effort: what the servo can do [N·m or N]; infinite at the start; shape (nv,).
    """

    def __init__(
        self,
        kinematics: Kinematics,
        shapes: Sequence[Shape],
        *,
        dt: float = 0.001,
        gravity: tuple[float, float, float] = (0.0, 0.0, -9.81),
        ground: Ground | None = FLAT,
        surfaces: Mapping[str, Surface] | None = None,
        base: Sequence[float] | None = None,
        provider: Provider = "compiled",
    ) -> None:
        if not (math.isfinite(dt) and dt > 0.0):
            raise SimulationError(f"a step of {dt:g} s is no step; it must be positive")
        self.kinematics = kinematics
        self.ground = ground
        self.dt = float(dt)
        self.t = 0.0
        self.steps = 0
        self._touches = touching(kinematics, shapes, surfaces or {}, ground)
        self._base = _matrix(base)
        self._arrays = fill(kinematics, self._touches, dt=dt, gravity=gravity, ground=ground, base=self._base)
        require_inertia(kinematics)
        self._advance = kernel() if provider == "compiled" else _reference(kinematics, self._arrays, self._base)
        a = self._arrays
        self.motor_velocity, self.motor_effort, self.applied = a["motor_velocity"], a["motor_effort"], a["applied"]
        self.position_target, self.velocity_target = a["position_target"], a["velocity_target"]
        self.kp, self.kd, self.servo_effort = a["kp"], a["kd"], a["servo_effort"]
        self._v, self._effort, self._tau = _read_only(a["v"]), _read_only(a["effort"]), _read_only(a["tau"])
        self.reset()

    @property
    def q(self) -> Array:
        """Configuration in the layout of ``kinematics.model``, a copy; shape (nq,). Set it by `reset`."""
        return configuration(self.kinematics.model, self._arrays)

    @property
    def v(self) -> Array:
        """Velocity, a floating base's twist in its own axes and linear first; read-only, shape (nv,)."""
        return self._v

    @property
    def positions(self) -> Array:
        """Position of each dof [rad or m], continuous joints not wrapped; NaN for those of floating joints; (nv,)."""
        return positions(self._arrays)

    @property
    def effort(self) -> Array:
        """Effort that motors and servos exerted in the last step [N·m or N]; read-only, shape (nv,)."""
        return self._effort

    @property
    def tau(self) -> Array:
        """All effort of the last step but contacts and limits: motors, servos, damping, friction, `applied`; (nv,)."""
        return self._tau

    @property
    def iterated(self) -> int:
        """How many steps since `reset` needed the iterative contact solver."""
        return int(self._arrays["counts"][ITERATED])

    def reset(self, q: Array | None = None, v: Array | None = None) -> None:
        """Put the robot at `q`, `v` (neutral, zero) at t = 0, forgetting contacts; targets stay.

        Raises:
            SimulationError: wrong shape, or not finite.
        """
        model = self.kinematics.model
        q = self.kinematics.neutral() if q is None else _checked("q", q, model.nq)
        v = np.zeros(model.nv) if v is None else _checked("v", v, model.nv)
        a = self._arrays
        set_configuration(model, a, q)
        a["v"][:] = v
        a["memory"][:] = a["effort"][:] = a["tau"][:] = 0.0
        a["counts"][:] = 0
        self.t, self.steps = 0.0, 0
        self._evaluate()

    def set_base_velocity(self, twist: Sequence[float]) -> None:
        """Set the floating base's twist, in its own axes and linear first; what it meets in the step may change it.

        Raises:
            SimulationError: the robot has no floating base, or a value is not finite.
        """
        if not self.kinematics.floating_base:
            raise SimulationError(f"robot `{self.kinematics.robot.name}` has no floating base to move")
        if len(twist) != 6 or not all(math.isfinite(part) for part in twist):
            raise SimulationError(f"a twist is six finite numbers, not {tuple(twist)}")
        self._arrays["v"][:6] = twist

    def step(self, n: int = 1) -> None:
        """Advance by `n` steps of `dt` in one compiled call that releases the GIL.

        Raises:
            SimulationError: the state stopped being finite; names the joint and the time.
        """
        done = self._advance(self._arrays.floats, self._arrays.integers, n, False)
        self.steps += done
        self.t = self.steps * self.dt
        if done < n:
            raise SimulationError(self._divergence())

    def contacts(self) -> tuple[Contact, ...]:
        """Return where the robot touched something in the last step."""
        a = self._arrays
        name = self.ground.name if self.ground else ""
        return contacts(a, self._touches, name, self.dt)

    def energy(self) -> tuple[float, float]:
        """Return kinetic and potential energy [J], the latter zero at the world's origin."""
        self._evaluate()
        a = self._arrays
        M = np.tril(a["M"])
        M += np.tril(M, -1).T
        centres = a["P"] + a["r"] + np.einsum("bij,bj->bi", a["R"].reshape(-1, 3, 3), a["centre"])
        return float(0.5 * a["v"] @ M @ a["v"]), float(-(a["mass"][:, None] * centres).sum(0) @ a["gravity"])

    def mass_matrix(self) -> Array:
        """Return M(q) [kg, kg·m or kg·m²]; shape (nv, nv)."""
        self._evaluate()
        M = np.tril(self._arrays["M"])
        return np.array(M + np.tril(M, -1).T)

    def bias_forces(self) -> Array:
        """Return h(q, v): what gravity and motion demand of each dof at zero acceleration [N or N·m]; shape (nv,)."""
        a = self._arrays
        return np.array(self.mass_matrix() @ turning(a, a["v"]) + a["bias"])

    def body_poses(self) -> Array:
        """Return where Pinocchio's joints are: x y z [m] and rotation matrix row by row; shape (njoints - 1, 12)."""
        self._evaluate()
        a = self._arrays
        return np.hstack([a["P"] + a["r"], a["R"]])

    def _evaluate(self) -> None:
        """Compute poses, M and bias of the state as it is."""
        self._advance(self._arrays.floats, self._arrays.integers, 1, True)

    def _divergence(self) -> str:
        model = self.kinematics.model
        wrong = int(np.flatnonzero(~np.isfinite(self._arrays["v"]))[0])
        joint = next(i for i in range(1, model.njoints) if model.idx_vs[i] <= wrong < model.idx_vs[i] + model.nvs[i])
        return (
            f"the simulation diverged at t = {self.t + self.dt:.6g} s: joint `{model.names[joint]}` "
            "has no finite velocity any more; try a smaller step, or look at its inertia and gains"
        )


def _reference(kinematics: Kinematics, arrays: Arrays, base: Array) -> Kernel:
    from urdfkit.sim.engine.reference import Reference

    return Reference(kinematics, arrays, base).advance


def _matrix(pose: Sequence[float] | None) -> Array:
    """Return x y z and a quaternion x y z w as a homogeneous matrix."""
    import pinocchio as pin

    if pose is None:
        return np.eye(4)
    values = np.asarray(pose, dtype=float)
    if values.shape != (7,) or not np.isfinite(values).all() or not np.linalg.norm(values[3:]) > 1e-9:
        raise SimulationError("the pose of the base is x y z and a quaternion x y z w that is not zero")
    values[3:] /= np.linalg.norm(values[3:])
    return np.array(pin.XYZQUATToSE3(values).homogeneous)


def _checked(name: str, values: Array, size: int) -> Array:
    found = np.asarray(values, dtype=float)
    if found.shape != (size,):
        raise SimulationError(f"{name} has shape {found.shape}; this robot needs ({size},)")
    if not np.isfinite(found).all():
        raise SimulationError(f"{name} has an entry that is not finite: {found[~np.isfinite(found)][0]}")
    return found


def _read_only(array: Array) -> Array:
    view = array[:]
    view.flags.writeable = False
    return view
