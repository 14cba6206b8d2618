// Markers of links: frames, joint axes, inertia ellipsoids, centres of mass, as Three.js children of the links.
/* global MeshCat */

const THREE = MeshCat.THREE;
const RGB = [0xe5484d, 0x30a46c, 0x3e7bfa];
const AXIS = 0xf5a524;
const INERTIA = 0x9b5de5;

/** Three thin bars from the origin, red, green and blue for x, y and z. */
function bars() {
  const bar = new THREE.CylinderGeometry(0.028, 0.028, 1, 6).translate(0, 0.5, 0).toNonIndexed().getAttribute("position");
  const [places, colours] = [[], []];
  RGB.forEach((hex, axis) => {
    const colour = new THREE.Color(hex).toArray();
    for (let i = 0; i < bar.count; i++) {
      const [x, y, z] = [bar.getX(i), bar.getY(i), bar.getZ(i)];
      places.push(...[[y, z, x], [x, y, z], [z, x, y]][axis]); // rotated about the diagonal, so that y becomes each axis
      colours.push(...colour);
    }
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  return geometry;
}

/** A ball with alternating dark and light octants, the symbol of a centre of mass. */
function checkered() {
  const geometry = new THREE.SphereGeometry(1, 16, 12).toNonIndexed();
  const position = geometry.getAttribute("position");
  const colours = [];
  for (let i = 0; i < position.count; i += 3) {
    const sign = ["X", "Y", "Z"].map((axis) => Math.sign([0, 1, 2].reduce((sum, k) => sum + position[`get${axis}`](i + k), 0)));
    const shade = sign[0] * sign[1] * sign[2] > 0 ? 0.08 : 1;
    for (let k = 0; k < 9; k++) colours.push(shade);
  }
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  return geometry;
}

const SHAPES = {
  frame: bars(),
  shaft: new THREE.CylinderGeometry(0.035, 0.035, 1, 10).translate(0, 0.5, 0),
  tip: new THREE.ConeGeometry(0.1, 0.28, 16).translate(0, 1.1, 0),
  ball: new THREE.SphereGeometry(1, 64, 40),
  checkered: checkered(),
};
const over = { depthTest: false, transparent: true };
const MATERIALS = {
  frame: new THREE.MeshBasicMaterial({ vertexColors: true, ...over }),
  axis: new THREE.MeshBasicMaterial({ color: AXIS, ...over, opacity: 0.95 }),
  inertia: new THREE.MeshPhongMaterial({ color: INERTIA, transparent: true, opacity: 0.4, depthWrite: false }),
  com: new THREE.MeshBasicMaterial({ vertexColors: true, ...over }),
};

function mesh(shape, material, order = 20) {
  const made = new THREE.Mesh(SHAPES[shape], MATERIALS[material]);
  made.renderOrder = order;
  return made;
}

function arrow() {
  const group = new THREE.Group();
  group.add(mesh("shaft", "axis"), mesh("tip", "axis"));
  return group;
}

export const KINDS = ["frames", "axes", "inertia", "com"];

export class Markers {
  constructor(page) {
    this.page = page;
    this.shown = Object.fromEntries(KINDS.map((kind) => [kind, false]));
    this.size = 1; // factor of the default size
    this.made = { frames: [], axes: [], inertia: [], com: [] };
  }

  show(kind, shown) {
    this.shown[kind] = shown;
    this.update();
  }

  /** Create the markers of a robot. */
  build() {
    const { robot, scene } = this.page;
    this.clear();
    for (const [name, link] of robot.links) {
      const node = scene.byLink.get(name);
      if (!node) continue;
      this.#hang("frames", node, mesh("frame", "frame", 21));
      if (link.inertial) this.#inertial(node, link.inertial);
    }
    for (const joint of robot.joints.values()) {
      const node = scene.byLink.get(joint.child);
      if (!node || !["revolute", "continuous", "prismatic", "planar"].includes(joint.type)) continue;
      const mark = arrow();
      mark.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...joint.axis));
      this.#hang("axes", node, mark);
    }
    this.update();
  }

  #inertial(node, { mass, origin, ellipsoid }) {
    const place = (mark) => {
      mark.position.set(origin[0], origin[1], origin[2]);
      return mark;
    };
    if (mass) this.#hang("com", node, place(mesh("checkered", "com", 22)));
    if (!ellipsoid) return;
    const mark = place(mesh("ball", "inertia", 10));
    mark.quaternion.set(origin[3], origin[4], origin[5], origin[6]).multiply(new THREE.Quaternion(...ellipsoid.turn));
    mark.scale.set(...ellipsoid.axes.map((half) => Math.max(half, 1e-5)));
    mark.userData.own = true; // not scaled by the marker size
    this.#hang("inertia", node, mark);
  }

  // A hidden marker is detached, because it would count for the size of its link.
  #hang(kind, node, mark) {
    mark.userData.node = node;
    this.made[kind].push(mark);
  }

  clear() {
    for (const marks of Object.values(this.made)) {
      for (const mark of marks) mark.parent?.remove(mark);
      marks.length = 0;
    }
  }

  update() {
    const radius = this.page.viewport.radius * this.size;
    // The more centres of mass, the smaller their symbols, so that robots of many links stay visible.
    const sizes = { frames: 0.22 * radius, axes: 0.24 * radius, com: 0.035 * radius * Math.min(1, 2 / Math.sqrt(this.made.com.length || 1)) };
    for (const [kind, marks] of Object.entries(this.made)) {
      for (const mark of marks) {
        if (!this.shown[kind]) mark.parent?.remove(mark);
        else if (!mark.parent) mark.userData.node.add(mark);
        if (!mark.userData.own) mark.scale.setScalar(sizes[kind]);
      }
    }
    this.page.viewport.dirty();
  }
}
