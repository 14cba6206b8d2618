// Three.js objects of the items of a display: lines, arrows, shapes, maps and points.
/* global MeshCat */

import { inFront } from "../appearance/in_front.js";
import { COLOURS } from "../handles/gizmo.js";
import { textSprite } from "./marker_text.js";
import { ribbons } from "./ribbons.js";

const THREE = MeshCat.THREE;
const X = new THREE.Vector3(1, 0, 0);
const MANY = 40; // arrows beyond this number are lines
const WIDTH = 0.03; // m of a line, as in RViz
const ABOVE = 0.003; // m above its plane, so that a map does not flicker with the ground
const METRES = { N: 0.02, "N·m": 0.2, "m/s": 1, "rad/s": 0.5, "m/s²": 0.1, "rad/s²": 0.1 }; // length of an arrow per unit

/** Choices of the field of a cloud that are no fields: its height in the world [m], or the colour of the display. */
export const HEIGHT = "height";
export const ONE_COLOUR = "one colour";

/** The objects of the items in one frame. @param options {color, size, changed, pose}; pose of the frame in the world */
export function build(items, options) {
  const group = new THREE.Group();
  const arrows = items.filter((item) => item.arrow);
  if (arrows.length > MANY) group.add(arrowLines(arrows, options));
  for (const item of items) {
    if (item.arrow && arrows.length > MANY) continue;
    const kind = Object.keys(MAKE).find((name) => name in item);
    const object = kind && MAKE[kind](item, options);
    if (object) group.add(object);
  }
  return group;
}

export function dispose(group) {
  group.traverse((object) => {
    object.geometry?.dispose();
    object.material?.map?.dispose();
    object.material?.dispose();
    object.dispose?.(); // copies
  });
  group.parent?.remove(group);
}

const MAKE = {
  line: ({ line, ...item }, options) => wide(line, 1, item, options),
  segments: ({ segments, ...item }, options) => wide(segments, 2, item, options),
  arrow: (item, options) => {
    const look = material(THREE.MeshLambertMaterial, item, options);
    return arrow(new THREE.Vector3(...item.arrow), X.clone().applyQuaternion(turn(item.arrow)), item.length * options.size, look, item.thick);
  },
  vector: vector,
  ellipsoid: ({ ellipsoid, axes }, options) => {
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), clear(options.color, 0.35));
    mesh.scale.set(...axes.map((axis) => Math.max(axis, 1e-3)));
    return placed(mesh, ellipsoid);
  },
  sector: ({ sector, angle, length }, options) => placed(new THREE.Mesh(new THREE.CircleGeometry(length * options.size, 24, -angle, 2 * angle), clear(options.color, 0.35)), sector),
  cone: ({ cone, angle }, options) => {
    const radius = Math.max(1e-3, cone * Math.tan(Math.min(angle, 3) / 2));
    return new THREE.Mesh(new THREE.ConeGeometry(radius, cone, 32, 1, true).rotateZ(Math.PI / 2).translate(cone / 2, 0, 0), clear(options.color, 0.35));
  },
  cells: ({ cells, size }, options) => copies(new THREE.PlaneGeometry(...size), cells, [1, 1, 1], null, material(THREE.MeshBasicMaterial, { side: THREE.DoubleSide }, options)),
  map: map,
  points: points,
  dots: ({ dots, ...item }, options) => placed(new THREE.Points(vertices(dots, item.colors), material(THREE.PointsMaterial, item, options, { size: item.size, sizeAttenuation: true })), item.pose),
  shape: shape,
  text: (item, options) => textSprite(item, colour(item, options)),
  mesh: mesh,
  controls: controls,
  triangles: ({ triangles, ...item }, options) => {
    const geometry = vertices(triangles, item.colors);
    geometry.computeVertexNormals();
    const mesh = placed(new THREE.Mesh(geometry, material(THREE.MeshLambertMaterial, item, options, { side: THREE.DoubleSide })), item.pose);
    mesh.scale.set(...item.scale);
    return mesh;
  },
};

const turn = (pose) => new THREE.Quaternion(pose[3], pose[4], pose[5], pose[6]);

function placed(object, pose) {
  if (!pose) return object;
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.copy(turn(pose));
  return object;
}

function vertices(flat, colors) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(flat, 3));
  if (colors) geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors.flatMap(([r, g, b]) => [r, g, b]), 3));
  return geometry;
}

function wide(points, step, item, options) {
  return placed(ribbons(points, step, item.colors, material(THREE.MeshBasicMaterial, item, options), item.width || WIDTH * options.size), item.pose);
}

// The colour of a marker, or that of the display.
function colour({ color }, options) {
  return color ? new THREE.Color(...color.slice(0, 3)) : new THREE.Color(options.color);
}

function material(Kind, item, options, more = {}) {
  const opacity = item.color?.[3] ?? 1;
  const side = item.side ? { side: item.side } : {};
  const own = item.colors ? { vertexColors: true } : { color: colour(item, options) };
  return new Kind({ ...own, opacity, transparent: opacity < 1, ...side, ...more });
}

function clear(color, opacity) {
  return new THREE.MeshBasicMaterial({ color, opacity, transparent: true, depthWrite: false, side: THREE.DoubleSide });
}

// `thick`: diameters of shaft and head, and length of the head [m].
function arrow(from, direction, length, look, thick = [Math.min(0.06 * length, 0.025), Math.min(0.18 * length, 0.08), Math.min(0.3 * length, 0.15)]) {
  if (!(length > 1e-6)) return null;
  const [shaft, head, tip] = [thick[0], thick[1], Math.min(thick[2], length)];
  const group = new THREE.Group().add(
    new THREE.Mesh(new THREE.CylinderGeometry(shaft / 2, shaft / 2, length - tip, 16).translate(0, (length - tip) / 2, 0), look),
    new THREE.Mesh(new THREE.ConeGeometry(head / 2, tip, 16).translate(0, length - tip / 2, 0), look),
  );
  group.position.copy(from);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction.normalize());
  return group;
}

function arrowLines(items, options) {
  const flat = [];
  for (const { arrow: pose, length } of items) {
    const quaternion = turn(pose);
    const from = new THREE.Vector3(...pose);
    const put = (...local) => new THREE.Vector3(...local).multiplyScalar(length * options.size).applyQuaternion(quaternion).add(from).toArray();
    const tip = put(1, 0, 0);
    flat.push(...from.toArray(), ...tip, ...tip, ...put(0.75, 0.12, 0), ...tip, ...put(0.75, -0.12, 0));
  }
  return new THREE.LineSegments(vertices(flat), new THREE.LineBasicMaterial({ color: options.color }));
}

function vector(item, options) {
  const direction = new THREE.Vector3(...item.vector);
  const length = direction.length() * (item.unit ? METRES[item.unit] * options.size : 1);
  const look = material(THREE.MeshLambertMaterial, item, item.about ? { ...options, color: 0xf5a524 } : options);
  const made = arrow(new THREE.Vector3(...(item.from ?? [0, 0, 0])), direction, length, look, item.thick);
  return made && placed(new THREE.Group().add(made), item.pose);
}

/** Decode the pictures of the maps among items, which `build` needs. */
export function decode(maps) {
  return Promise.all(
    maps.map((item) => {
      item.image = Object.assign(new Image(), { src: `data:image/png;base64,${item.map}` });
      return item.image.decode();
    }),
  );
}

function map({ image, pose, size }) {
  const texture = Object.assign(new THREE.Texture(image), { magFilter: THREE.NearestFilter, needsUpdate: true });
  const plane = new THREE.PlaneGeometry(...size).translate(size[0] / 2, size[1] / 2, ABOVE);
  const color = document.documentElement.dataset.theme === "dark" ? 0x8f99a8 : 0xffffff; // free space does not dazzle
  const mesh = placed(new THREE.Mesh(plane, new THREE.MeshBasicMaterial({ color, map: texture, transparent: true, depthWrite: false, side: THREE.DoubleSide })), pose);
  mesh.renderOrder = -0.5; // above the grid of the ground, below all other transparent objects
  return mesh;
}

function floats(text) {
  return new Float32Array(bytes(text).buffer);
}

function bytes(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

function points(item, options) {
  const geometry = new THREE.BufferGeometry();
  const position = floats(item.points);
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  const colors = pointColors(item, position, options);
  if (colors) geometry.setAttribute("color", colors);
  const look = colors ? { vertexColors: true } : { color: options.color };
  const made = new THREE.Points(geometry, inFront(new THREE.PointsMaterial({ ...look, size: 3 * options.size, sizeAttenuation: false })));
  made.frustumCulled = false;
  return made;
}

// The colours of a field or of the message, else the height in the world; null: one colour.
function pointColors(item, position, { field, pose, byHeight }) {
  if (field === (byHeight ? ONE_COLOUR : "")) return null;
  const isHeight = field === HEIGHT && !item.fields.includes(HEIGHT);
  if (item.colors && !isHeight) return new THREE.BufferAttribute(bytes(item.colors), 3, true);
  if (item.values && !isHeight) return new THREE.BufferAttribute(scale(floats(item.values), item.range), 3);
  const up = new THREE.Vector3(0, 0, 1).applyQuaternion(turn(pose).invert());
  const heights = new Float32Array(position.length / 3);
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < heights.length; i += 1) {
    heights[i] = up.x * position[3 * i] + up.y * position[3 * i + 1] + up.z * position[3 * i + 2] + pose[2];
    low = Math.min(low, heights[i]);
    high = Math.max(high, heights[i]);
  }
  return new THREE.BufferAttribute(scale(heights, [low, high]), 3);
}

// From blue to red, as RViz colours intensities.
function scale(values, [low, high]) {
  const colours = new Float32Array(3 * values.length);
  const color = new THREE.Color();
  for (let i = 0; i < values.length; i += 1) {
    const part = high > low ? (values[i] - low) / (high - low) : 0;
    color.setHSL(0.67 * (1 - Math.min(1, Math.max(0, part))), 1, 0.5).toArray(colours, 3 * i);
  }
  return colours;
}

// A mesh file, with the colours of the file or that of its marker; it appears when it is loaded.
function mesh({ mesh: name, own, ...item }, options) {
  const group = placed(new THREE.Group(), item.pose);
  group.scale.set(...item.scale);
  const add = ({ geometry }) => {
    const look = own ? { colors: geometry.getAttribute("color"), color: [1, 1, 1, item.color[3] || 1] } : item;
    group.add(new THREE.Mesh(geometry, material(THREE.MeshLambertMaterial, look, options, { side: THREE.DoubleSide })));
  };
  const failed = (error) => console.warn(`mesh ${name.slice(0, 8)}: ${error.message}`);
  options.mesh(name).then((parts) => (parts.forEach(add), options.changed())).catch(failed);
  return group;
}

const GEOMETRIES = {
  cube: () => new THREE.BoxGeometry(1, 1, 1),
  sphere: () => new THREE.SphereGeometry(0.5, 20, 14),
  cylinder: () => new THREE.CylinderGeometry(0.5, 0.5, 1, 24).rotateX(Math.PI / 2),
};

function shape(item, options) {
  const geometry = GEOMETRIES[item.shape]();
  const { colors, ...single } = item;
  if (item.at) return placed(copies(geometry, item.at, item.scale, colors, material(THREE.MeshLambertMaterial, single, options)), item.pose);
  const mesh = placed(new THREE.Mesh(geometry, material(THREE.MeshLambertMaterial, single, options)), item.pose);
  mesh.scale.set(...item.scale.map((part) => part || 1e-3));
  return mesh;
}

function copies(geometry, flat, size, colors, look) {
  const count = flat.length / 3;
  if (colors) look.color.set(0xffffff);
  const mesh = new THREE.InstancedMesh(geometry, look, count);
  const matrix = new THREE.Matrix4();
  for (let i = 0; i < count; i += 1) {
    mesh.setMatrixAt(i, matrix.makeScale(...size.map((part) => part || 1e-3)).setPosition(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]));
    if (colors) mesh.setColorAt(i, new THREE.Color(...colors[i].slice(0, 3)));
  }
  mesh.frustumCulled = false;
  return mesh;
}

// An interactive marker: a group for each control, with the control as `userData.control`.
function controls(item, options) {
  const group = placed(new THREE.Group(), item.pose);
  for (const control of item.controls) {
    const part = control.items.length ? build(control.items, options) : new THREE.Group().add(handle(control, item.size));
    part.userData.control = control;
    group.add(part);
  }
  const fixed = group.children.filter(({ userData }) => userData.control.orientation === 1);
  group.userData = { marker: item, settle: () => fixed.forEach((part) => part.quaternion.copy(group.quaternion).invert()) };
  group.userData.settle();
  return group;
}

// The handle of a control without markers: two arrows along its x axis, a ring about it, or a ball.
function handle({ mode, turn: q }, size) {
  const group = new THREE.Group();
  group.quaternion.set(...q);
  const axis = X.clone().applyQuaternion(group.quaternion).toArray().map(Math.abs);
  const color = mode >= 7 ? 0xf5a524 : COLOURS[axis.indexOf(Math.max(...axis))];
  const look = new THREE.MeshBasicMaterial({ color, opacity: 0.8, transparent: true, side: THREE.DoubleSide });
  const add = (geometry) => group.add(new THREE.Mesh(geometry.scale(size, size, size), look));
  if (mode === 3) for (const side of [1, -1]) add(new THREE.ConeGeometry(0.09, 0.25, 16).rotateZ((-side * Math.PI) / 2).translate(side * 0.55, 0, 0));
  else if (mode >= 4 && mode <= 6) add(new THREE.TorusGeometry(mode === 5 ? 0.5 : 0.36, 0.025, 8, 48).rotateY(Math.PI / 2));
  else if (mode >= 7) add(new THREE.SphereGeometry(0.14, 20, 14));
  return group;
}
