// Poses as seven numbers, x y z and quaternion x y z w, in double precision.

export const IDENTITY = Object.freeze([0, 0, 0, 0, 0, 0, 1]);

/** The product of two quaternions. */
export function multiply([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

/** Rotate a vector by a quaternion. */
export function rotate([x, y, z, w], [vx, vy, vz]) {
  const tx = 2 * (y * vz - z * vy);
  const ty = 2 * (z * vx - x * vz);
  const tz = 2 * (x * vy - y * vx);
  return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

export const turnOf = (pose) => [pose[3], pose[4], pose[5], pose[6]];
export const conjugate = ([x, y, z, w]) => [-x, -y, -z, w];

/** Product of two poses: b relative to a, expressed in the reference frame of a. */
export function compose(a, b) {
  const turn = turnOf(a);
  const [x, y, z] = rotate(turn, b);
  return [a[0] + x, a[1] + y, a[2] + z, ...multiply(turn, turnOf(b))];
}

export function inverse(a) {
  const turn = conjugate(turnOf(a));
  const [x, y, z] = rotate(turn, a);
  return [-x, -y, -z, ...turn];
}

/** Quaternion of a rotation by an angle [rad] about a unit vector. */
export function about([x, y, z], angle) {
  const s = Math.sin(angle / 2);
  return [x * s, y * s, z * s, Math.cos(angle / 2)];
}

/** Rotation vector of a quaternion, angle times axis [rad], of length at most π. */
export function turnVector([x, y, z, w]) {
  const sign = w < 0 ? -1 : 1;
  const s = Math.hypot(x, y, z);
  const factor = s < 1e-12 ? 2 : (2 * Math.atan2(s, sign * w)) / s;
  return [sign * x * factor, sign * y * factor, sign * z * factor];
}

/** Fixed-axis roll, pitch, yaw [rad] of a quaternion, as URDF's rpy. */
export function toRpy([x, y, z, w]) {
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  if (Math.abs(sine) > 1 - 1e-12) return [0, (Math.PI / 2) * Math.sign(sine), -2 * Math.sign(sine) * Math.atan2(x, w)];
  return [Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), Math.asin(sine), Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))];
}

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
