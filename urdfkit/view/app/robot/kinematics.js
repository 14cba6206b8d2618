// Forward and inverse kinematics of the robot described by the message `inspect`, in double precision.

import { IDENTITY, about, add, compose, conjugate, cross, multiply, rotate, subtract, turnOf, turnVector } from "./pose.js";

const STEPS = 40; // damped least squares iterations per call
const CLOSE = 1e-5; // [m] and [rad]: error at which the target counts as reached
const NEAR = 1e-4; // [m] and [rad]: error at which no further starting point is tried
const RESTARTS = 40; // additional starting points if the first one ends in a local minimum
const PRIMES = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29];
const DAMPING = 0.02; // of the error's length; Buss, "Introduction to inverse kinematics", 2004, section 6

export class Kinematics {
  /** @param description {root, links: [{name}], joints: [{name, type, parent, child, origin, axis, turn, mimic, …}]} */
  constructor(description) {
    this.root = description.root;
    this.links = description.links.map((link) => link.name);
    this.joints = description.joints;
    this.byName = new Map(this.joints.map((joint) => [joint.name, joint]));
    this.above = new Map(this.joints.map((joint) => [joint.child, joint]));
    const below = new Map();
    for (const joint of this.joints) below.set(joint.parent, [...(below.get(joint.parent) ?? []), joint]);
    this.below = below;
    this.order = [];
    for (const queue = [this.root]; queue.length; ) {
      for (const joint of below.get(queue.shift()) ?? []) this.order.push(joint), queue.push(joint.child);
    }
  }

  /** Position of a joint with one degree of freedom, with mimic relations applied [rad or m]. */
  value(joint, values) {
    if (!joint.mimic) return values[joint.name] ?? 0;
    const { master, multiplier, offset } = joint.mimic;
    return offset + (master === null ? 0 : multiplier * (values[master] ?? 0));
  }

  /** Pose of every link in the root link, by name; `values` are joint positions by name [rad or m]. */
  forward(values) {
    const poses = new Map([[this.root, IDENTITY]]);
    for (const joint of this.order) {
      const placed = compose(poses.get(joint.parent), joint.origin);
      poses.set(joint.child, compose(placed, this.#motion(joint, values)));
    }
    return poses;
  }

  #motion(joint, values) {
    const part = (name, rest = 0) => values[`${joint.name}/${name}`] ?? rest;
    switch (joint.type) {
      case "revolute":
      case "continuous":
        return [0, 0, 0, ...about(joint.axis, this.value(joint, values))];
      case "prismatic":
        return [...joint.axis.map((x) => x * this.value(joint, values)), 0, 0, 0, 1];
      case "planar": {
        const turn = [0, 0, 0, ...joint.turn];
        const moved = [part("x"), part("y"), 0, ...about([0, 0, 1], part("theta"))];
        return compose(compose(turn, moved), [0, 0, 0, ...conjugate(joint.turn)]);
      }
      case "floating": {
        const turn = [part("rot_x"), part("rot_y"), part("rot_z"), part("rot_w", 1)];
        const length = Math.hypot(...turn) || 1;
        return [part("trans_x"), part("trans_y"), part("trans_z"), ...turn.map((x) => x / length)];
      }
      default:
        return IDENTITY;
    }
  }

  // Like `forward`, but only for the ancestors of a link.
  #poses(chain, values) {
    const poses = new Map([[this.root, IDENTITY]]);
    for (const joint of chain) poses.set(joint.child, compose(compose(poses.get(joint.parent), joint.origin), this.#motion(joint, values)));
    return poses;
  }

  /** The joints from the root down to a link. */
  chain(link) {
    const joints = [];
    for (let joint = this.above.get(link); joint; joint = this.above.get(joint.parent)) joints.unshift(joint);
    return joints;
  }

  /** The actuated joints that move a link, by name. */
  movers(link) {
    const found = new Map();
    for (const joint of this.chain(link)) {
      if (!["revolute", "continuous", "prismatic"].includes(joint.type)) continue;
      const leader = joint.mimic ? this.byName.get(joint.mimic.master) : joint;
      if (leader) found.set(leader.name, leader);
    }
    return [...found.values()];
  }

  /** Columns (linear and angular part at a point) of the Jacobian of a link for the joints of `movers`. */
  #jacobian(chain, movers, poses, point) {
    const columns = new Map(movers.map((joint) => [joint.name, [0, 0, 0, 0, 0, 0]]));
    for (const joint of chain) {
      const master = joint.mimic ? joint.mimic.master : joint.name;
      const column = columns.get(master);
      if (!column) continue;
      const factor = joint.mimic ? joint.mimic.multiplier : 1;
      const at = compose(poses.get(joint.parent), joint.origin);
      const axis = rotate(turnOf(at), joint.axis);
      const linear = joint.type === "prismatic" ? axis : cross(axis, subtract(point, at));
      const angular = joint.type === "prismatic" ? [0, 0, 0] : axis;
      [...linear, ...angular].forEach((x, i) => (column[i] += factor * x));
    }
    return movers.map((joint) => columns.get(joint.name));
  }

  /**
   * Joint positions that bring a link as near to a target as the limits allow, by damped least squares. Joints that
   * reach a limit are fixed there. If the target is not reached, the search is repeated from other starting points.
   * @param goal pose of the link in the root link; @param options {turn: also its orientation, limits: observe them,
   * restarts: number of other starting points, first: number of the first of them}
   * @returns {values, error: remaining distance [m], turned: remaining angle [rad]}
   */
  inverse(link, goal, values, { turn = false, limits = true, restarts = RESTARTS, first = 0 } = {}) {
    const movers = this.movers(link);
    const task = { link, goal, turn, limits, movers, chain: this.chain(link), reach: this.#reach(link) };
    let best = this.#descend(task, values);
    const possible = Math.hypot(goal[0], goal[1], goal[2]) <= task.reach + this.#slides(task.chain);
    for (let k = first; possible && !best.reached && movers.length && k < first + restarts; k++) {
      const found = this.#descend(task, { ...values, ...elsewhere(movers, values, k, limits) });
      if (found.reached) best = found;
    }
    return best;
  }

  #descend({ link, goal, turn, limits, movers, chain, reach }, values) {
    const found = { ...values };
    let error = Infinity;
    let turned = 0;
    for (let step = 0; step <= STEPS; step++) {
      const poses = this.#poses(chain, found);
      const at = poses.get(link);
      const away = subtract(goal, at);
      const wrong = turn ? turnVector(multiply(turnOf(goal), conjugate(turnOf(at)))) : [0, 0, 0];
      [error, turned] = [Math.hypot(...away), Math.hypot(...wrong)];
      if ((error < CLOSE && turned < CLOSE) || step === STEPS || movers.length === 0) break;
      const weight = turn ? 0.3 * reach : 0; // a radian counts as much as this many metres
      const wanted = clamped([...away, ...wrong.map((x) => x * weight)], 0.3 * reach);
      const columns = this.#jacobian(chain, movers, poses, at).map((c) => [...c.slice(0, 3), ...c.slice(3).map((x) => x * weight)]);
      if (!this.#advance(found, movers, columns, wanted, limits, reach)) break;
    }
    const reached = error < NEAR && turned < NEAR;
    return { values: Object.fromEntries(movers.map(({ name }) => [name, found[name] ?? 0])), error, turned, reached };
  }

  // Sum of the ranges of the prismatic joints of a chain [m].
  #slides(chain) {
    return chain.filter(({ type }) => type === "prismatic").reduce((sum, { lower, upper }) => sum + Math.max(Math.abs(lower ?? 1e3), Math.abs(upper ?? 1e3)), 0);
  }

  #advance(found, movers, columns, wanted, limits, reach) {
    let free = movers.map((_, i) => i);
    for (;;) {
      if (free.length === 0) return false;
      const moves = leastSquares(free.map((i) => columns[i]), wanted, DAMPING * Math.hypot(...wanted) + 1e-4 * reach);
      const held = free.filter((i, k) => {
        const { name, lower, upper } = movers[i];
        const [now, next] = [found[name] ?? 0, (found[name] ?? 0) + moves[k]];
        return limits && ((lower !== null && next < lower && now <= lower) || (upper !== null && next > upper && now >= upper));
      });
      if (held.length) {
        free = free.filter((i) => !held.includes(i));
        continue;
      }
      let moved = 0;
      free.forEach((i, k) => {
        const { name, lower, upper } = movers[i];
        let next = (found[name] ?? 0) + moves[k];
        if (limits) next = Math.min(upper ?? Infinity, Math.max(lower ?? -Infinity, next));
        moved = Math.max(moved, Math.abs(next - (found[name] ?? 0)));
        found[name] = next;
      });
      return moved > 1e-9;
    }
  }

  /** Approximate reach of a link from the root [m]: the sum of the lengths of its ancestors' origins. */
  #reach(link) {
    return Math.max(0.05, this.chain(link).reduce((sum, { origin }) => sum + Math.hypot(origin[0], origin[1], origin[2]), 0));
  }
}

/** Starting joint positions, farther from the current ones for larger `k`; deterministic. */
function elsewhere(movers, values, k, limits) {
  const part = Math.min(1, 0.3 + 0.1 * k);
  const found = {};
  movers.forEach(({ name, lower, upper }, i) => {
    const now = values[name] ?? 0;
    const chance = halton(k + 1, PRIMES[i % PRIMES.length]);
    const low = limits && lower !== null ? lower : now - Math.PI;
    const high = limits && upper !== null ? upper : now + Math.PI;
    found[name] = now + part * (low + chance * (high - low) - now);
  });
  return found;
}

/** Halton sequence in 0..1; Halton, 1960. */
function halton(index, base) {
  let [found, part] = [0, 1];
  for (let i = index; i > 0; i = Math.floor(i / base)) found += (part /= base) * (i % base);
  return found;
}

function clamped(vector, length) {
  const size = Math.hypot(...vector);
  return size > length ? vector.map((x) => (x * length) / size) : vector;
}

/** Jᵀ(JJᵀ + λ²)⁻¹e for the columns of J, 6 rows. */
function leastSquares(columns, wanted, lambda) {
  const A = [...Array(6)].map((_, r) => [...Array(6)].map((__, c) => columns.reduce((sum, column) => sum + column[r] * column[c], r === c ? lambda * lambda : 0)));
  const y = solve(A, [...wanted]);
  return columns.map((column) => column.reduce((sum, x, i) => sum + x * y[i], 0));
}

/** Solve A x = b for a symmetric positive definite A by Gaussian elimination with the pivot on the diagonal. */
function solve(A, b) {
  const n = b.length;
  for (let i = 0; i < n; i++) {
    for (let r = i + 1; r < n; r++) {
      const factor = A[r][i] / A[i][i];
      for (let c = i; c < n; c++) A[r][c] -= factor * A[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let c = i + 1; c < n; c++) b[i] -= A[i][c] * b[c];
    b[i] /= A[i][i];
  }
  return b;
}

/** Transform a point from a frame to its reference frame. */
export function place(pose, point) {
  return add(pose, rotate(turnOf(pose), point));
}
