"""The same step with mass matrix, bias and Jacobians from Pinocchio: what the compiled kernel is tested against.

Contact geometry and the solver of rows are shared with the kernel; all else is written again, in numpy. It is some
hundred times slower.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from tests.reference_engine.integration import go, inward, move, outward
from tests.reference_engine.joint_servos import grow_integrals, servo_effort, servos, set_integral_parts
from tests.reference_engine.midstep_contact_points import exchange
from tests.reference_engine.pinocchio_models import Tree, free_model, model_of
from tests.reference_engine.shared_kernels import find_candidates, find_contacts, find_impulses
from urdfkit.errors import SimulationError
from urdfkit.sim.engine.bodies import Body, Member
from urdfkit.sim.engine.constraints.constraint_rows import FASTEST_JOINT, RECOVERY
from urdfkit.sim.engine.constraints.contact_rows import FASTEST_RECOVERY, MOBILITY
from urdfkit.sim.engine.constraints.joint_servos import SERVO_ATTEMPTS
from urdfkit.sim.engine.constraints.limit_crossings import PASSING, WHIRLING
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR
from urdfkit.sim.engine.kernel_cache import load_compiled, world_digest
from urdfkit.sim.engine.simulation_memory import (
    DT,
    FOUND_CONTACTS,
    FOUND_ROWS,
    GUESSES,
    ITERATED,
    STEPS,
    TERMS,
    Arrays,
)
from urdfkit.sim.engine.state_conversion import turning

Array = NDArray[np.float64]


class Reference:
    """`advance` in Python.

    Args:
        members: the robots.
        bodies: the free bodies.
        arrays: the engine's; targets and state are read from and written to them.
    """

    def __init__(self, members: Sequence[Member], bodies: Sequence[Body], arrays: Arrays) -> None:
        self.a = arrays
        self.trees = [Tree(model_of(member), arrays, k) for k, member in enumerate(members)]
        self.trees += [Tree(free_model(body), arrays, k) for k, body in enumerate(bodies, len(members))]
        self.dt = float(arrays["numbers"][DT])
        digest = world_digest()
        self._candidates = load_compiled(find_candidates, ("floats", "integers"), digest=digest)
        self._search = load_compiled(find_contacts, ("floats", "integers", "count"), digest=digest)
        self._find = load_compiled(find_impulses, ("floats", "integers", "count"))

    def advance(self, floats: Array, integers: NDArray[np.int64], steps: int, action: int) -> int:
        """Advance by `steps`; return how many were done, fewer only if the state stopped being finite."""
        if action == TERMS:
            M, bias = self._terms(self.a["v"])
            for tree in self.trees:
                self.a["M"][tree.entries] = np.tril(M[tree.dofs, tree.dofs]).ravel()
            self.a["bias"][:] = bias
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
        set_integral_parts(a, start, dt)
        a["last"][:] = a["memory"]
        contact_rows = self._contact_rows(start)
        a["memory"][:] = 0.0
        a["saturated"][:] = a["pressed"][:] = 0
        a["counts"][FOUND_ROWS] = 0
        for island in self._islands():
            dofs = np.concatenate([np.arange(self.trees[t].dofs.start, self.trees[t].dofs.stop) for t in island])
            touching = [row for row in contact_rows if row.tree in island]
            self._settle(M, bias, start, dofs, touching)
        for k in range(int(a["counts"][FOUND_CONTACTS])):
            a["contact_impulse"][k] = self.impulses[k]
        self._account(a["v"].copy())
        grow_integrals(a, 0.5 * (start + a["v"]), dt)
        move(a, a["s"], a["v"], 0.5 * dt)
        a["counts"][STEPS] += 1

    def _islands(self) -> list[list[int]]:
        """Return the trees of each island."""
        a = self.a
        label = list(range(len(self.trees)))
        for k in range(int(a["counts"][FOUND_CONTACTS])):
            if a["contact_other"][k] >= 0:
                one, other = (label[a["body_tree"][a[name][k]]] for name in ("contact_body", "contact_other"))
                label = [min(one, other) if each in (one, other) else each for each in label]
        return [[t for t, each in enumerate(label) if each == name] for name in sorted(set(label))]

    def _settle(self, M: Array, bias: Array, start: Array, dofs: Array, contact_rows: list[Row]) -> None:
        """Find the velocities of an island's dofs."""
        a, n = self.a, len(start)
        if len(dofs) == 0:
            return
        own = np.ix_(dofs, dofs)
        has_servo = bool(servos(a)[dofs].any())
        joint_rows = self._joint_rows(start, dofs)
        limited = any(n <= row.slot < 2 * n for row in joint_rows)
        rows = joint_rows + contact_rows
        whirls = bool((self.dt * np.abs(start[dofs]) > WHIRLING).any())
        if not contact_rows and not has_servo and (whirls or not limited):
            if not joint_rows and not (np.abs(a["damping"]) + np.abs(a["applied"]))[dofs].any():
                a["v"][dofs] = self._fly(start, dofs)
                return
            inertia, impulse = self._smooth(M, bias, start)
            half = start.copy()
            half[dofs] += 0.5 * (self._solve(inertia[own], impulse[dofs], start[dofs], rows, dofs) - start[dofs])
            M, bias = self._terms(half)
        attempt = 0
        v = start.copy()
        while True:
            inertia, impulse = self._smooth(M, bias, start)
            v[dofs] = self._solve(inertia[own], impulse[dofs], start[dofs], rows, dofs)
            attempt += 1
            again = has_servo and self._overloaded(v, dofs, attempt < SERVO_ATTEMPTS)
            if not self._passes_limits(v, dofs) and not again:
                break
            rows = self._joint_rows(start, dofs) + contact_rows
        a["v"][dofs] = v[dofs]
        a["memory"][[row.slot for row in rows]] = a["x"][: len(rows)]
        a["counts"][FOUND_ROWS] += len(rows)
        for at, row in enumerate(rows):
            if row.contact >= 0:
                normal = a["x"][at]
                first, second = a["x"][at + 1 : at + 3] if row.mu > 0.0 else (0.0, 0.0)
                self.impulses[row.contact] = first, second, normal

    def _fly(self, v: Array, dofs: Array) -> Array:
        """Advance a tree that nothing holds as `ballistic.fly` does; return its velocities."""
        a, dt = self.a, self.dt
        kept, v_first = a["s"].copy(), v.copy()
        move(a, a["s"], v_first, -0.5 * dt)
        s_first, w_first = a["s"].copy(), outward(a, v_first)
        dq, dw = np.zeros_like(v), np.zeros_like(v)
        sum_q, sum_w = np.zeros_like(v), np.zeros_like(v)
        for ahead, weight in ((0.0, 1 / 6), (0.5 * dt, 1 / 3), (0.5 * dt, 1 / 3), (dt, 1 / 6)):
            go(a, s_first, ahead * dq)
            now = inward(a, w_first + ahead * dw)
            M, bias = self._terms(now)
            gain = np.zeros_like(v)
            gain[dofs] = np.linalg.solve(M[np.ix_(dofs, dofs)], (a["applied"] - bias)[dofs])
            rate = outward(a, now)
            for b in np.flatnonzero(a["kind"] == FREE):
                d = a["first_v"][b] + 3
                rate[d : d + 3] = pin.Jlog3(pin.exp3(ahead * dq[d : d + 3])) @ now[d : d + 3]
            dq, dw = rate, outward(a, gain)
            sum_q, sum_w = sum_q + weight * dq, sum_w + weight * dw
        go(a, s_first, dt * sum_q)
        v = inward(a, w_first + dt * sum_w)
        move(a, a["s"], v, -0.5 * dt)
        outside = np.ones(len(kept), dtype=bool)
        tree = int(np.searchsorted(a["tree_dof"], dofs[0], side="right")) - 1
        outside[a["tree_s"][tree] : a["tree_s"][tree + 1]] = False
        a["s"][outside] = kept[outside]
        return np.array(v[dofs])

    def _terms(self, v: Array) -> tuple[Array, Array]:
        """Return M and the bias that keeps linear velocities constant in space."""
        n = len(v)
        M, bias = np.zeros((n, n)), np.zeros(n)
        for tree in self.trees:
            q = tree.configuration(self.a)
            own = np.triu(pin.crba(tree.model, tree.data, q))
            M[tree.dofs, tree.dofs] = own + np.triu(own, 1).T
            bias[tree.dofs] = pin.nonLinearEffects(tree.model, tree.data, q, v[tree.dofs])
            bias[tree.dofs] -= pin.computeGeneralizedGravity(tree.weightless, tree.weightless_data, q)
        return M, bias - M @ turning(self.a, v)

    def _place(self, v: Array) -> None:
        """Write the poses and twists that the contact search needs."""
        a = self.a
        for tree in self.trees:
            model, data = tree.model, tree.data
            q = tree.configuration(a)
            pin.forwardKinematics(model, data, q, v[tree.dofs])
            P = q[:3] if a["tree_floats"][tree.number] else a["base"][tree.number]
            a["P"][tree.number] = P
            for k in range(model.njoints - 1):
                b = tree.first_body + k
                pose = data.oMi[k + 1]
                a["R"][b], a["r"][b] = pose.rotation.ravel(), pose.translation - P
                spatial = pose.act(data.v[k + 1])
                # Of the point P, as the kernel has it.
                a["twist"][b, :3] = spatial.linear + np.cross(spatial.angular, P)
                a["twist"][b, 3:] = spatial.angular

    def _passes_limits(self, v: Array, dofs: Array) -> bool:
        a = self.a
        position = a["s"][a["dof_s"]]
        end = position + self.dt * v
        inside = (a["pressed"] == 0) & (position >= a["lower"]) & (position <= a["upper"])
        below, above = inside & (end < a["lower"] - PASSING), inside & (end > a["upper"] + PASSING)
        a["pressed"][dofs] += (above.astype(int) - below.astype(int))[dofs]
        return bool((below | above)[dofs].any())

    def _joint_rows(self, v: Array, dofs: Array) -> list[Row]:
        a, dt, n = self.a, self.dt, len(v)
        position = a["s"][a["dof_s"]]
        unit = np.eye(n)
        rows = []
        for k, (d, m) in enumerate(zip(a["mimic_dof"], a["mimic_master"], strict=True)):
            J, target = unit[d].copy(), a["mimic_offset"][k]
            if m >= 0:
                J[m] -= a["mimic_factor"][k]
                target = target + a["mimic_factor"][k] * position[m]
            b = float(np.clip(RECOVERY * (position[d] - target) / dt, -FASTEST_JOINT, FASTEST_JOINT))
            rows.append(Row(J, b, -np.inf, np.inf, 0.0, 2 * n + k))
        for d in range(n):
            effort, rub, target = a["motor_effort"][d], a["friction"][d], a["motor_velocity"][d]
            if effort > 0.0 and (rub == 0.0 or (effort > rub and target != 0.0)):
                rows.append(Row(unit[d], -target, -effort * dt, effort * dt, 0.0, d))
            elif rub > 0.0:
                hold = rub + (effort if target == 0.0 else 0.0)
                rows.append(Row(unit[d], 0.0, -hold * dt, hold * dt, 0.0, d))
        for d in np.flatnonzero(np.isfinite(a["lower"]) | np.isfinite(a["upper"])):
            below, above = position[d] - a["lower"][d], a["upper"][d] - position[d]
            pressed = a["pressed"][d]
            low = pressed < 0 or (pressed == 0 and below <= above)
            gap = below if low else above
            if gap < 2.0 * dt * abs(v[d]) + 1e-3 or pressed:
                rows.append(Row(unit[d] if low else -unit[d], recovery(gap, dt), 0.0, np.inf, 0.0, n + d))
        inside = set(dofs.tolist())
        return [row for row in rows if set(np.flatnonzero(row.J).tolist()) <= inside]

    def _contact_rows(self, v: Array) -> list[Row]:
        a, dt, n = self.a, self.dt, len(v)
        a["counts"][FOUND_CONTACTS] = 0
        self._place(v)
        pairs = self._candidates(a.floats, a.integers)
        near = np.flatnonzero(a["near"])
        if len(near) == 0:
            return []
        kept, start = a["s"].copy(), v.copy()
        twist, origin = a["twist"].copy(), a["P"].copy()
        axes = [a["R"][b].reshape(3, 3).copy() for b in range(len(a["kind"]))]
        move(a, a["s"], start, 0.5 * dt)
        self._place(start)
        a["r"][:] += (a["P"] - origin)[a["body_tree"]]
        a["P"][:], a["twist"][:] = origin, twist
        for tree in self.trees:
            pin.computeJointJacobians(tree.model, tree.data, tree.configuration(a))
        count = self._search(a.floats, a.integers, pairs)
        a["s"][:] = kept
        a["counts"][FOUND_CONTACTS] = count
        first_slot, first_pair_slot = 2 * n + len(a["mimic_dof"]), len(a["memory"]) - 3 * len(a["contact_body"])
        self.impulses = np.zeros((count, 3))
        rows: list[Row] = []
        for rubs in (False, True):
            for k in range(count):
                if (a["contact_mu"][k] > 0.0) != rubs:
                    continue
                number = int(a["body_tree"][a["contact_body"][k]])
                point = a["contact_point"][k] + origin[number]
                J = self._point_jacobian(int(a["contact_body"][k]), point, axes)
                if a["contact_other"][k] >= 0:
                    J = J - self._point_jacobian(int(a["contact_other"][k]), point, axes)
                frame = a["contact_frame"][k].reshape(3, 3)
                a["contact_row"][k] = -1
                if np.square(frame[2] @ J).sum() <= MOBILITY * (J * J).sum():
                    continue
                gap = a["contact_gap"][k] - 0.5 * dt * (frame[2] @ J @ v)
                moved = exchange(a, k, axes)
                along, across, normal = frame @ (J + moved)
                late = -frame @ moved @ v
                ground = a["contact_against"][k] < 0
                slot = first_slot + 3 * int(a["contact_feature"][k]) if ground else first_pair_slot + 3 * k
                a["contact_row"][k] = len(rows)
                mu = a["contact_mu"][k] if rubs else 0.0
                bias = max(recovery(gap, dt), -FASTEST_RECOVERY) + late[2]
                rows.append(Row(normal, bias, 0.0, np.inf, mu, slot, number, k))
                if rubs:
                    rows.append(Row(along, late[0], -np.inf, np.inf, 0.0, slot + 1, number))
                    rows.append(Row(across, late[1], -np.inf, np.inf, 0.0, slot + 2, number))
        return rows

    def _point_jacobian(self, body: int, point: Array, axes: list[Array]) -> Array:
        """Return what v moves a point of a body with, in the world; a free body's v is still in its `axes` of now."""
        tree = self.trees[int(self.a["body_tree"][body])]
        world = pin.ReferenceFrame.WORLD
        spatial = np.array(pin.getJointJacobian(tree.model, tree.data, body - tree.first_body + 1, world))
        J = np.zeros((3, len(self.a["v"])))
        J[:, tree.dofs] = spatial[:3] - pin.skew(point) @ spatial[3:]
        for k in range(tree.model.njoints - 1):
            b = tree.first_body + k
            kind = self.a["kind"][b]
            if kind in (FREE, PLANAR):
                n = 3 if kind == FREE else 2
                d = self.a["first_v"][b]
                turn = tree.data.oMi[k + 1].rotation.T @ axes[b]
                J[:, d : d + n] = J[:, d : d + n] @ turn[:n, :n]
                if kind == FREE:
                    J[:, d + 3 : d + 6] = J[:, d + 3 : d + 6] @ turn
        return J

    def _smooth(self, M: Array, bias: Array, v: Array) -> tuple[Array, Array]:
        """Return the inertia that implicit damping and servos make, and the impulse of a step."""
        a, dt = self.a, self.dt
        softness = a["damping"] * np.array([late_share(z) for z in dt * a["damping"] / np.diag(M)])
        effort = a["applied"] - bias - a["damping"] * v + self._beside(v)
        for d in np.flatnonzero(servos(a)):
            if a["saturated"][d] == 0:
                effort[d] += servo_effort(a, v, self.dt)[d]
                softness[d] += a["kd"][d] + dt * a["kp"][d]
            else:
                effort[d] += a["saturated"][d] * a["servo_effort"][d]
        return M + dt * np.diag(softness), dt * effort

    def _solve(self, inertia: Array, impulse: Array, v: Array, rows: list[Row], dofs: Array) -> Array:
        a = self.a
        free = v + np.linalg.solve(inertia, impulse)
        n = len(rows)
        if n == 0:
            return free
        if n > len(a["x"]) or n * n > len(a["A"]):
            raise SimulationError(f"{n} rows at once are more than the reference engine solves")
        J = np.array([row.J[dofs] for row in rows])
        a["A"][: n * n] = (J @ np.linalg.solve(inertia, J.T)).ravel()
        a["g"][:n] = J @ free + [row.bias for row in rows]
        a["low"][:n], a["high"][:n] = [row.low for row in rows], [row.high for row in rows]
        a["mu"][:n] = [row.mu for row in rows]
        a["before"][:n] = a["last"][[row.slot for row in rows]]
        guesses = self._find(a.floats, a.integers, n)
        a["counts"][GUESSES] = guesses
        a["counts"][ITERATED] += guesses <= 0
        return np.array(free + np.linalg.solve(inertia, J.T @ a["x"][:n]))

    def _overloaded(self, v: Array, dofs: Array, release: bool) -> bool:
        a = self.a
        needed, most = servo_effort(a, v, self.dt), a["servo_effort"] * (1.0 + 1e-12)
        now = (needed > most).astype(int) - (needed < -most).astype(int)
        if not release:
            now = np.where(a["saturated"] != 0, a["saturated"], now)
        changed = bool((now != a["saturated"])[dofs].any())
        a["saturated"][dofs] = now[dofs]
        return changed

    def _beside(self, v: Array) -> Array:
        """Return the effort next to the row of a dof with motor and dry friction."""
        a = self.a
        effort, rub, target = a["motor_effort"], a["friction"], a["motor_velocity"]
        both = (effort != 0.0) & (rub != 0.0) & (target != 0.0)
        against = -np.copysign(rub, np.where(np.abs(v) > 1e-9, v, target))
        return np.array(np.where(both, np.where(effort > rub, against, np.copysign(effort, target - v)), 0.0))

    def _account(self, v: Array) -> None:
        a, n = self.a, len(v)
        row, most, beside = a["memory"][:n] / self.dt, a["motor_effort"], self._beside(v)
        weak = (a["friction"] > 0.0) & (most <= a["friction"]) & (a["motor_velocity"] != 0.0)
        motor = np.where(most == 0.0, 0.0, np.where(weak, beside, np.clip(row, -most, most)))
        servo = np.where(
            a["saturated"] != 0, a["saturated"] * np.nan_to_num(a["servo_effort"]), servo_effort(a, v, self.dt)
        )
        a["effort"][:] = motor + servo
        a["tau"][:] = row + beside + servo + a["applied"] - a["damping"] * v


def late_share(z: float) -> float:
    """Return how much of a damper acts on the velocity at the end of a step, see `joint_servos.late_share`."""
    return 1.0 / -np.expm1(-z) - 1.0 / z if z > 1e-2 else 0.5 + z / 12.0 - z**3 / 720.0


class Row(NamedTuple):
    """One row, see `sim.engine.constraints.constraint_rows`; with a number of its contact in the row of the normal."""

    J: Array
    bias: float
    low: float
    high: float
    mu: float
    slot: int
    tree: int = -1
    contact: int = -1


def recovery(gap: float, dt: float) -> float:
    """Return the bias of a gap [m/s]."""
    return gap / dt if gap > 0.0 else max(RECOVERY * gap / dt, -FASTEST_JOINT)
