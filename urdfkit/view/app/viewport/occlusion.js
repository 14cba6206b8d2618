// Objects that hide the robot: the initial view avoids them, and objects that hide it later become transparent.
/* global MeshCat */

const THREE = MeshCat.THREE;
const OFTEN = 120; // ms between two checks for obstacles
const TURNS = [0, 30, -30, 60, -60, 90, -90, 150, -150, 180]; // degrees from the preferred direction
const RISES = [0, 0.6, 1.6]; // added elevation
const NEAR = 0.35; // of the robot's radius: nearer objects do not count as obstacles

export class Occlusion {
  constructor(page) {
    Object.assign(this, { page, scene: page.scene, viewport: page.viewport, ray: new THREE.Raycaster() });
    page.on("drawn", () => this.#soon());
  }

  /** Find a direction from which a box is visible. @param wanted preferred direction from the box to the camera, z up @returns the direction, and the part of the distance */
  clearDirection(box, wanted, distance) {
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const points = this.#points(box);
    const others = this.#others(null);
    this.viewport.viewer.scene.updateMatrixWorld(); // the scene may not have been drawn yet
    let best = { seen: -1, direction: wanted, part: 1 };
    for (const rise of others.length ? RISES : [0]) {
      for (const turn of TURNS) {
        const direction = turned(wanted, turn, rise);
        const towards = new THREE.Vector3(direction[0], direction[2], -direction[1]).normalize();
        const eye = sphere.center.clone().addScaledVector(towards, distance);
        // Cast from the robot outwards, so that a camera inside a wall is rejected.
        const free = points.map((point) => this.#hits(point, eye, others)[0]?.distance ?? Infinity);
        const seen = free.filter((length) => length === Infinity).length / points.length;
        if (seen > best.seen) best = { seen, direction, part: seen === 1 ? 1 : Math.min(1, (0.9 * Math.min(...free)) / distance) };
        if (seen === 1) return best;
      }
    }
    return best;
  }

  #points(box) {
    const [middle, half] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).multiplyScalar(0.4)];
    return [[0, 0, 0], [0, 1, 0], [1, 0.2, 1], [-1, 0.2, 1], [1, 0.2, -1], [-1, 0.2, -1]].map((at) => middle.clone().add(new THREE.Vector3(...at).multiply(half)));
  }

  // Objects that are not part of the robot; `robot` is the driven robot if it is not the first.
  #others(robot) {
    const own = new Set(robot ? this.scene.nodes.filter((node) => this.scene.linkOf.get(node)?.startsWith(`world/${robot}::`)) : this.scene.own);
    return [...this.scene.groups.visual.values()].filter((group) => group.visible && !own.has(group.parent));
  }

  #hits(from, to, objects) {
    const way = to.clone().sub(from);
    Object.assign(this.ray, { near: NEAR * this.viewport.radius, far: way.length() });
    this.ray.set(from, way.normalize());
    return this.ray.intersectObjects(objects, true);
  }

  #soon() {
    if (this.page.mode !== "sim" || this.timer) return;
    this.timer = setTimeout(() => ((this.timer = null), this.fadeObstacles()), OFTEN);
  }

  /** Make the objects that hide the robot from the camera transparent. */
  fadeObstacles() {
    const other = this.page.followed === undefined ? null : this.page.driven;
    const node = this.scene.nodes[this.page.followed ?? this.page.model?.root ?? 0];
    if (!node || this.page.cameras.way === "first") return this.scene.fade(new Set());
    const { camera } = this.viewport.viewer;
    const others = this.#others(other);
    const hidden = new Set();
    for (const height of [0.3, 1]) {
      const point = node.getWorldPosition(new THREE.Vector3());
      point.y += height * this.viewport.radius;
      const eye = camera.isOrthographicCamera ? camera.getWorldDirection(new THREE.Vector3()).multiplyScalar(-100).add(point) : camera.position;
      const near = point.distanceTo(eye) - NEAR * this.viewport.radius;
      this.ray.near = 0;
      this.ray.far = Math.max(0, near);
      this.ray.set(eye, point.clone().sub(eye).normalize());
      for (const { object } of this.ray.intersectObjects(others, true)) hidden.add(object);
    }
    this.scene.fade(hidden);
  }
}

// Rotate a direction about the vertical [°] and raise it.
function turned([x, y, z], degrees, rise) {
  const angle = (degrees * Math.PI) / 180;
  const flat = Math.hypot(x, y);
  return [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle), z + rise * flat];
}

export function occlusion(page) {
  page.occlusion = new Occlusion(page);
  page.expose("occlusion", page.occlusion);
}
