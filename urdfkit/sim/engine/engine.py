"""Engine: one robot and the ground, advanced in time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from urdfkit.kinematics.model import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine.surface import Contact, Ground, Surface

Array = NDArray[np.float64]
Provider = Literal["compiled", "pinocchio"]


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
        ground: Ground | None = Ground(),
        surfaces: Mapping[str, Surface] | None = None,
        base: Sequence[float] | None = None,
        provider: Provider = "compiled",
    ) -> None: ...

    @property
    def q(self) -> Array:
        """Configuration in the layout of ``kinematics.model``, read-only; shape (nq,). See `reset`."""

    @property
    def v(self) -> Array:
        """Velocity, a floating base's twist in its own axes and linear first; read-only, shape (nv,)."""

    @property
    def positions(self) -> Array:
        """Joint position of each dof [rad or m], continuous joints not wrapped; NaN for a floating joint; (nv,)."""

    @property
    def effort(self) -> Array:
        """Effort that motors and servos exerted in the last step [N·m or N]; read-only, shape (nv,)."""

    @property
    def tau(self) -> Array:
        """All effort of the last step but contacts and limits: motors, servos, damping, friction, `applied`; (nv,)."""

    def reset(self, q: Array | None = None, v: Array | None = None) -> None:
        """Put the robot at `q`, `v` (neutral, zero) at t = 0, forgetting contacts; targets stay.

        Raises:
            SimulationError: wrong shape, or not finite.
        """

    def step(self, n: int = 1) -> None:
        """Advance by `n` steps of `dt` in one compiled call that releases the GIL.

        Raises:
            SimulationError: the state stopped being finite; names the joint and the time.
        """

    def contacts(self) -> tuple[Contact, ...]:
        """Return where the robot touched something in the last step."""

    def energy(self) -> tuple[float, float]:
        """Return kinetic and potential energy [J], the latter zero at the world's origin."""

    def body_poses(self) -> Array:
        """Return the pose of every moving body: x y z [m], quaternion x y z w; pinocchio joint i is row i; (njoints, 7)."""
