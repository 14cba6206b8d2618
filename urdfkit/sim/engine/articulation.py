"""One articulated robot of an engine: its targets and its state."""

import math
from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from urdfkit.errors import SimulationError
from urdfkit.kinematics.model import Kinematics
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.engine.scalar_views import numbers
from urdfkit.sim.engine.simulation_memory import DT, FOUND_CONTACTS, STEPS, Arrays
from urdfkit.sim.engine.state_conversion import CoordinateLayout, positions, set_configuration


class Articulation:
    """A robot of an engine. Per-dof arrays are in the order of ``kinematics.model``'s ``v``.

    Args:
        kinematics: the robot.
        arrays: the engine's.
        tree: its number among the engine's robots.

    Attributes:
        arrays: the engine's, of all robots and bodies.
        tree: its number among the engine's robots.
        coordinates: joint coordinates of its bodies, one number where Pinocchio has cosine and sine; read-only.
        read_coordinates: coordinates that `Engine.link_poses` computes poses of.
        computed_poses: their results; shape (n_links, 7).
        motor_velocity: target of the velocity motor of each dof [rad/s or m/s]; shape (nv,).
        motor_effort: maximum effort of that motor [N·m or N]; 0: no motor; shape (nv,).
        applied: effort added to each dof [N·m or N]; shape (nv,).
        position_target: target of the position servo of each dof [rad or m]; shape (nv,).
        kp: stiffness of the servo [N·m/rad or N/m]; 0: no stiffness; shape (nv,).
        kd: damping towards `velocity_target` [N·m·s/rad or N·s/m]; 0: no damping; shape (nv,).
        velocity_target: [rad/s or m/s]; shape (nv,).
        servo_effort: maximum effort of the servo [N·m or N]; initially infinite; shape (nv,).
        ki: gain of the integral of the servo's error, of velocity where `kp` is 0 and `kd` is not; shape (nv,).
        i_min: minimum effort of the integral [N·m or N]; shape (nv,).
        i_max: maximum effort of the integral; both are initially 0, so the integral has no effect; shape (nv,).
        antiwindup: 1 if the integral itself is limited, 0 if only its effort is; shape (nv,).
        feedforward: effort added to the servo's, within its limit [N·m or N]; shape (nv,).
        integral: of the error [rad·s, m·s, rad or m]; shape (nv,).
        approach_rate: rate at which the velocity motor approaches `position_target` [1/s]; 0: it has no goal, and keeps
            `motor_velocity`, which is otherwise computed in every step; shape (nv,).
        fastest: maximum speed of a motor with a goal [rad/s or m/s]; initially infinite; shape (nv,).
        acceleration: maximum acceleration of a motor with a goal [rad/s² or m/s²]; initially infinite; shape (nv,).
        deceleration: maximum deceleration of a motor with a goal [rad/s² or m/s²]; initially infinite; shape (nv,).
        set_twist: step and twist of the last `set_base_velocity`; None before the first.
    """

    def __init__(self, kinematics: Kinematics, arrays: Arrays, tree: int) -> None:
        self.kinematics = kinematics
        self.arrays = arrays
        self.tree = tree
        coordinates, links = (slice(*arrays[name][tree : tree + 2].tolist()) for name in ("tree_s", "tree_link"))
        self._layout = CoordinateLayout(kinematics.model, arrays, tree)
        self.coordinates = _read_only(arrays["s"][coordinates])
        self.read_coordinates, self.computed_poses = arrays["read_s"][coordinates], arrays["link_pose"][links]
        first, beyond = arrays["tree_dof"][tree : tree + 2].tolist()
        a = {name: arrays[name][first:beyond] for name in PER_DOF}
        self.motor_velocity, self.motor_effort, self.applied = a["motor_velocity"], a["motor_effort"], a["applied"]
        self.position_target, self.velocity_target = a["position_target"], a["velocity_target"]
        self.kp, self.kd, self.servo_effort = a["kp"], a["kd"], a["servo_effort"]
        self.ki, self.i_min, self.i_max, self.antiwindup = a["ki"], a["i_min"], a["i_max"], a["antiwindup"]
        self.feedforward, self.integral = a["feedforward"], a["integral"]
        self.approach_rate, self.fastest = a["approach_rate"], a["fastest"]
        self.acceleration, self.deceleration = a["acceleration"], a["deceleration"]
        self._targets_at_sleep = arrays["targets_at_sleep"][first:beyond]
        self._own_v, self._own_effort, self._own_tau = a["v"], a["effort"], a["tau"]
        self._v, self._effort, self._tau = _read_only(a["v"]), _read_only(a["effort"]), _read_only(a["tau"])
        self.set_twist: tuple[int, Array] | None = None
        self._counts, self._against = numbers(arrays["counts"]), numbers(arrays["contact_against"])

    @property
    def q(self) -> Array:
        """Configuration in the layout of ``kinematics.model``, a copy; shape (nq,). Set it by `put`."""
        return self.configuration(self.coordinates)

    def configuration(self, coordinates: Array) -> Array:
        """Return `coordinates` in the layout of ``kinematics.model``; shape (nq,)."""
        return self._layout.configuration(coordinates)

    @property
    def v(self) -> Array:
        """Velocity, a floating base's twist in its own axes and linear first; read-only, shape (nv,)."""
        return self._v

    @property
    def positions(self) -> Array:
        """Position of each dof [rad or m], continuous joints not wrapped; NaN for those of floating joints; (nv,)."""
        return positions(self.arrays, self.tree)

    @property
    def weightless(self) -> tuple[Array, Array]:
        """Mass [kg] of each body that gravity does not pull, and its centre in the body [m]; shapes (n,), (n, 3)."""
        bodies = slice(*self.arrays["tree_body"][self.tree : self.tree + 2].tolist())
        return self.arrays["weightless"][bodies], self.arrays["weightless_centre"][bodies]

    @property
    def asleep(self) -> bool:
        """Whether the robot is at rest and not simulated until a contact or a new target wakes it."""
        return bool(self.arrays["asleep"][self.tree])

    @property
    def effort(self) -> Array:
        """Effort that motors and servos exerted in the last step [N·m or N]; read-only, shape (nv,)."""
        return self._effort

    @property
    def tau(self) -> Array:
        """All effort of the last step but contacts and limits: motors, servos, damping, friction, `applied`; (nv,)."""
        return self._tau

    def set_base_velocity(self, twist: Sequence[float]) -> None:
        """Set the floating base's twist in its own axes, linear part first; contacts in the step may change it.

        If a contact reduced the velocity that was set for the last step, the base is moved back by the distance that
        the first half of this step would move it into the other body.

        Raises:
            SimulationError: the robot has no floating base, or a value is not finite.
        """
        if not self.kinematics.floating_base:
            raise SimulationError(f"robot `{self.kinematics.robot.name}` has no floating base to move")
        if len(twist) != 6 or not all(math.isfinite(part) for part in twist):
            raise SimulationError(f"a twist is six finite numbers, not {tuple(twist)}")
        v = np.array(twist, dtype=float)
        step, previous = self._counts[STEPS], self.set_twist
        if previous is not None and previous[0] == step - 1 and self._met_something():
            dt = float(self.arrays["numbers"][DT])
            # Linear velocities stay constant in space while the base turns.
            linear = matmul(pin.exp3(-dt * previous[1][3:]), previous[1][:3])
            taken = np.concatenate([linear, previous[1][3:]]) - self._own_v[:6]
            self._shift_base(-0.5 * dt * taken)
        self._own_v[:6] = v
        self.set_twist = step, v

    def _met_something(self) -> bool:
        """Return whether the robot touched anything but the ground in the last step."""
        n = self._counts[FOUND_CONTACTS]
        if max(self._against[:n].tolist(), default=-1) < 0:
            return False
        a = self.arrays
        tree_of = np.append(a["body_tree"], -1)
        mine = (tree_of[a["contact_body"][:n]] == self.tree) | (tree_of[a["contact_other"][:n]] == self.tree)
        return bool((mine & (a["contact_against"][:n] >= 0)).any())

    def _shift_base(self, by: Array) -> None:
        """Move the floating base in its own axes [m, rad]."""
        at = int(self.arrays["tree_s"][self.tree])
        s = self.arrays["s"][at : at + 7]
        rotation = pin.Quaternion(s[3:].copy())
        s[:3] += matmul(rotation.matrix(), by[:3])
        s[3:] = (rotation * pin.Quaternion(pin.exp3_quat(by[3:]))).normalized().coeffs()

    def put(self, q: Array | None = None, v: Array | None = None) -> None:
        """Set `q` and `v` of the robot (neutral and zero by default); targets are unchanged.

        Raises:
            SimulationError: wrong shape, or not finite.
        """
        model = self.kinematics.model
        q = self.kinematics.neutral() if q is None else _checked("q", q, model.nq)
        v = np.zeros(model.nv) if v is None else _checked("v", v, model.nv)
        set_configuration(model, self.arrays, q, self.tree)
        self._own_v[:] = v
        self._own_effort[:] = self._own_tau[:] = self.integral[:] = 0.0
        self.arrays["still"][self.tree] = self.arrays["attempt"][self.tree] = 0
        self._targets_at_sleep[:] = np.nan  # wakes it, even where it was


PER_DOF = (
    "motor_velocity",
    "motor_effort",
    "applied",
    "position_target",
    "velocity_target",
    "kp",
    "kd",
    "servo_effort",
    "approach_rate",
    "fastest",
    "acceleration",
    "deceleration",
    "ki",
    "i_min",
    "i_max",
    "antiwindup",
    "feedforward",
    "integral",
    "v",
    "effort",
    "tau",
)
"""Arrays of the engine with a value for each degree of freedom."""


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
