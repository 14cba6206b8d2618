"""The same step with mass matrix, bias and Jacobians from Pinocchio: what the compiled kernel is tested against.

Contact geometry and the solver of rows are shared with the kernel; all else is written again, in numpy. It is some
hundred times slower.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from urdfkit.kinematics.model import Kinematics
from urdfkit.sim.engine.arrays import DT, FOUND_CONTACTS, FOUND_ROWS, GUESSES, HAS_FLOOR, ITERATED, STEPS, Arrays
from urdfkit.sim.engine.dynamics import FREE, PLANAR
from urdfkit.sim.engine.parts import find_contacts, find_impulses
from urdfkit.sim.engine.rows import MOBILITY, RECOVERY
from urdfkit.sim.engine.servo import SERVO_ATTEMPTS
from urdfkit.sim.engine.state import configuration, turning
from urdfkit.sim.engine.warmup import load_compiled

Array = NDArray[np.float64]


class Reference:
    """`advance` in Python.

    Args:
        kinematics: the robot.
        arrays: the engine's; targets and state are read from and written to them.
        base: pose of a bolted robot's root link, shape (4, 4).
    """

    def __init__(self, kinematics: Kinematics, arrays: Arrays, base: Array) -> None:
        self.a = arrays
        self.model = pin.Model(kinematics.model)
        self.model.gravity.linear = arrays["gravity"]
        if not kinematics.floating_base:
            for joint in range(1, self.model.njoints):
                if self.model.parents[joint] == 0:
                    self.model.jointPlacements[joint] = pin.SE3(base) * self.model.jointPlacements[joint]
        self.data = self.model.createData()
        self.floating = kinematics.floating_base
        self.dt = float(arrays["numbers"][DT])
        self._search = load_compiled(find_contacts, ("floats", "integers"))
        self._find = load_compiled(find_impulses, ("floats", "integers", "count"))

    def advance(self, floats: Array, integers: NDArray[np.int64], steps: int, only_terms: bool) -> int:
        """Advance by `steps`; return how many were done, fewer only if the state stopped being finite."""
        if only_terms:
            M, bias = self._terms(self.a["v"])
            self.a["M"][:], self.a["bias"][:] = np.tril(M), bias
            self._place(self.a["v"])
            return 0
        for done in range(steps):
            self._step()
            if not np.isfinite(self.a["v"]).all():
                return done
        return steps

    def _step(self) -> None:
        a, dt = self.a, self.dt
        move(a, a["s"], a["v"], 0.5 * dt)
        start = a["v"].copy()
        M, bias = self._terms(start)
        joint_rows = self._joint_rows(start)
        contact_rows = self._contact_rows(start, len(joint_rows))
        has_servo = bool((a["kp"] != 0.0).any() or (a["kd"] != 0.0).any())
        limited = any(len(start) <= row.slot < 2 * len(start) for row in joint_rows)
        a["saturated"][:] = 0
        if not contact_rows and not has_servo and not limited:
            inertia, impulse = self._smooth(M, bias, start)
            M, bias = self._terms(start + 0.5 * np.linalg.solve(inertia, impulse))
        attempt = 0
        while True:
            inertia, impulse = self._smooth(M, bias, start)
            v = self._solve(inertia, impulse, start, joint_rows + contact_rows)
            attempt += 1
            if not has_servo or not self._overloaded(v, attempt < SERVO_ATTEMPTS):
                break
        a["v"][:] = v
        self._account(v, joint_rows + contact_rows)
        move(a, a["s"], a["v"], 0.5 * dt)
        a["counts"][FOUND_ROWS] = len(joint_rows) + len(contact_rows)
        a["counts"][STEPS] += 1

    def _terms(self, v: Array) -> tuple[Array, Array]:
        """Return M and the bias that keeps linear velocities constant in space."""
        q = configuration(self.model, self.a)
        M = np.triu(pin.crba(self.model, self.data, q))
        M += np.triu(M, 1).T
        return M, pin.nonLinearEffects(self.model, self.data, q, v) - M @ turning(self.a, v)

    def _place(self, v: Array) -> None:
        """Write the poses and twists that the contact search needs."""
        a = self.a
        q = configuration(self.model, a)
        pin.forwardKinematics(self.model, self.data, q, v)
        a["P"][:] = q[:3] if self.floating else a["base"]
        for b in range(self.model.njoints - 1):
            pose = self.data.oMi[b + 1]
            a["R"][b], a["r"][b] = pose.rotation.ravel(), pose.translation - a["P"]
            spatial = pose.act(self.data.v[b + 1])
            # Of the point P, as the kernel has it.
            a["twist"][b, :3] = spatial.linear + np.cross(spatial.angular, a["P"])
            a["twist"][b, 3:] = spatial.angular

    def _joint_rows(self, v: Array) -> list[Row]:
        a, dt, n = self.a, self.dt, len(v)
        position = a["s"][a["dof_s"]]
        unit = np.eye(n)
        rows = []
        for k, (d, m) in enumerate(zip(a["mimic_dof"], a["mimic_master"], strict=True)):
            J, target = unit[d].copy(), a["mimic_offset"][k]
            if m >= 0:
                J[m] -= a["mimic_factor"][k]
                target = target + a["mimic_factor"][k] * position[m]
            rows.append(Row(J, RECOVERY * (position[d] - target) / dt, -np.inf, np.inf, 0.0, 2 * n + k))
        for d in range(n):
            effort, rub, target = a["motor_effort"][d], a["friction"][d], a["motor_velocity"][d]
            if effort > 0.0 and (rub == 0.0 or (effort > rub and target != 0.0)):
                rows.append(Row(unit[d], -target, -effort * dt, effort * dt, 0.0, d))
            elif rub > 0.0:
                hold = rub + (effort if target == 0.0 else 0.0)
                rows.append(Row(unit[d], 0.0, -hold * dt, hold * dt, 0.0, d))
        for d in np.flatnonzero(np.isfinite(a["lower"]) | np.isfinite(a["upper"])):
            below, above = position[d] - a["lower"][d], a["upper"][d] - position[d]
            gap = min(below, above)
            if gap < 2.0 * dt * abs(v[d]) + 1e-3:
                rows.append(Row(unit[d] if below <= above else -unit[d], recovery(gap, dt), 0.0, np.inf, 0.0, n + d))
        return rows

    def _contact_rows(self, v: Array, first: int) -> list[Row]:
        a, dt = self.a, self.dt
        a["counts"][FOUND_CONTACTS] = 0
        if a["numbers"][HAS_FLOOR] == 0.0 or len(a["shape_kind"]) == 0:
            return []
        kept, start = a["s"].copy(), v.copy()
        self._place(v)
        twist, origin = a["twist"].copy(), a["P"].copy()
        axes = [self.data.oMi[b + 1].rotation.copy() for b in range(len(a["kind"]))]
        move(a, a["s"], start, 0.5 * dt)
        self._place(start)
        a["r"][:] += a["P"] - origin
        a["P"][:], a["twist"][:] = origin, twist
        q = configuration(self.model, a)
        count = self._search(a.floats, a.integers)
        a["s"][:] = kept
        a["counts"][FOUND_CONTACTS] = count
        a["contact_origin"][:] = origin
        pin.computeJointJacobians(self.model, self.data, q)
        rows: list[Row] = []
        for rubs in (False, True):
            for k in range(count):
                if (a["contact_mu"][k] > 0.0) != rubs:
                    continue
                J = self._point_jacobian(int(a["contact_body"][k]), a["contact_point"][k] + origin, axes)
                along, across, normal = a["contact_frame"][k].reshape(3, 3) @ J
                a["contact_row"][k] = -1
                if normal @ normal <= MOBILITY * (J * J).sum():
                    continue
                gap = a["contact_gap"][k] - 0.5 * dt * (normal @ v)
                slot = 2 * len(v) + len(a["mimic_dof"]) + 3 * int(a["contact_feature"][k])
                a["contact_row"][k] = first + len(rows)
                rows.append(Row(normal, recovery(gap, dt), 0.0, np.inf, a["contact_mu"][k] if rubs else 0.0, slot))
                if rubs:
                    rows.append(Row(along, 0.0, -np.inf, np.inf, 0.0, slot + 1))
                    rows.append(Row(across, 0.0, -np.inf, np.inf, 0.0, slot + 2))
        return rows

    def _point_jacobian(self, body: int, point: Array, axes: list[Array]) -> Array:
        """Return what v moves a point of a body with, in the world; a free body's v is still in its `axes` of now."""
        world = pin.ReferenceFrame.WORLD
        spatial = np.array(pin.getJointJacobian(self.model, self.data, body + 1, world))
        J: Array = spatial[:3] - pin.skew(point) @ spatial[3:]
        for b, kind in enumerate(self.a["kind"]):
            if kind in (FREE, PLANAR):
                n = 3 if kind == FREE else 2
                d = self.a["first_v"][b]
                turn = self.data.oMi[b + 1].rotation.T @ axes[b]
                J[:, d : d + n] = J[:, d : d + n] @ turn[:n, :n]
        return J

    def _smooth(self, M: Array, bias: Array, v: Array) -> tuple[Array, Array]:
        """Return the inertia that implicit damping and servos make, and the impulse of a step."""
        a, dt = self.a, self.dt
        softness = a["damping"].copy()
        effort = a["applied"] - bias - a["damping"] * v + self._beside(v)
        for d in np.flatnonzero((a["kp"] != 0.0) | (a["kd"] != 0.0)):
            if a["saturated"][d] == 0:
                effort[d] += self._servo(v)[d]
                softness[d] += a["kd"][d] + dt * a["kp"][d]
            else:
                effort[d] += a["saturated"][d] * a["servo_effort"][d]
        return M + dt * np.diag(softness), dt * effort

    def _solve(self, inertia: Array, impulse: Array, v: Array, rows: list[Row]) -> Array:
        a = self.a
        free = v + np.linalg.solve(inertia, impulse)
        n = len(rows)
        if n == 0:
            return free
        J = np.array([row.J for row in rows])
        a["A"].ravel()[: n * n] = (J @ np.linalg.solve(inertia, J.T)).ravel()
        a["g"][:n] = J @ free + [row.bias for row in rows]
        a["low"][:n], a["high"][:n] = [row.low for row in rows], [row.high for row in rows]
        a["mu"][:n] = [row.mu for row in rows]
        a["before"][:n] = a["memory"][[row.slot for row in rows]]
        guesses = self._find(a.floats, a.integers, n)
        a["counts"][GUESSES] = guesses
        a["counts"][ITERATED] += guesses < 0
        return np.array(free + np.linalg.solve(inertia, J.T @ a["x"][:n]))

    def _servo(self, v: Array) -> Array:
        a = self.a
        position = a["s"][a["dof_s"]]
        return np.array(
            a["kp"] * (a["position_target"] - position - self.dt * v) + a["kd"] * (a["velocity_target"] - v)
        )

    def _overloaded(self, v: Array, release: bool) -> bool:
        a = self.a
        needed, most = self._servo(v), a["servo_effort"] * (1.0 + 1e-12)
        now = (needed > most).astype(int) - (needed < -most).astype(int)
        if not release:
            now = np.where(a["saturated"] != 0, a["saturated"], now)
        changed = bool((now != a["saturated"]).any())
        a["saturated"][:] = now
        return changed

    def _beside(self, v: Array) -> Array:
        """Return the effort beside the row of a dof with motor and dry friction."""
        a = self.a
        effort, rub, target = a["motor_effort"], a["friction"], a["motor_velocity"]
        both = (effort != 0.0) & (rub != 0.0) & (target != 0.0)
        against = -np.copysign(rub, np.where(np.abs(v) > 1e-9, v, target))
        return np.array(np.where(both, np.where(effort > rub, against, np.copysign(effort, target - v)), 0.0))

    def _account(self, v: Array, rows: list[Row]) -> None:
        a, n = self.a, len(v)
        a["memory"][:] = 0.0
        a["memory"][[row.slot for row in rows]] = a["x"][: len(rows)]
        row, most, beside = a["memory"][:n] / self.dt, a["motor_effort"], self._beside(v)
        weak = (a["friction"] > 0.0) & (most <= a["friction"]) & (a["motor_velocity"] != 0.0)
        motor = np.where(most == 0.0, 0.0, np.where(weak, beside, np.clip(row, -most, most)))
        servo = np.where(a["saturated"] != 0, a["saturated"] * np.nan_to_num(a["servo_effort"]), self._servo(v))
        a["effort"][:] = motor + servo
        a["tau"][:] = row + beside + servo + a["applied"] - a["damping"] * v


class Row(NamedTuple):
    """One row: see `urdfkit.sim.engine.rows`."""

    J: Array
    bias: float
    low: float
    high: float
    mu: float
    slot: int


def recovery(gap: float, dt: float) -> float:
    """Return the bias of a gap [m/s]."""
    return gap / dt if gap > 0.0 else RECOVERY * gap / dt


def move(a: Arrays, s: Array, v: Array, dt: float) -> None:
    """Let the coordinates go on for `dt`, linear velocities constant in space; changes `s` and `v`."""
    for b, kind in enumerate(a["kind"]):
        at, d = a["first_s"][b], a["first_v"][b]
        if kind == FREE:
            before = pin.Quaternion(s[at + 3 : at + 7].copy())
            after = before * pin.Quaternion(pin.exp3(v[d + 3 : d + 6] * dt))
            after.normalize()
            linear = before.matrix() @ v[d : d + 3]
            s[at : at + 3] += dt * linear
            s[at + 3 : at + 7] = after.coeffs()
            v[d : d + 3] = after.matrix().T @ linear
        elif kind == PLANAR:
            linear = _turn(s[at + 2]) @ v[d : d + 2]
            s[at : at + 2] += dt * linear
            s[at + 2] += dt * v[d + 2]
            v[d : d + 2] = _turn(s[at + 2]).T @ linear
        else:
            s[at] += dt * v[d]


def _turn(angle: float) -> Array:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
