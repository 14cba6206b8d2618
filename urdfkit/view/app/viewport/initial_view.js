// Seeing the robot: a first view from where nothing is in front of it, and through what comes between later.
/* global MeshCat */

const THREE = MeshCat.THREE;
const OFTEN = 120; // ms between two looks at what is in between
const TURNS = [0, 30, -30, 60, -60, 90, -90, 150, -150, 180]; // degrees from where one would look best
const RISES = [0, 0.6, 1.6]; // how much steeper from above
const NEAR = 0.35; // of the robot's radius: what is so near to it belongs to the picture

export class Sight {
  constructor(page) {
    Object.assign(this, { page, scene: page.scene, stage: page.stage, ray: new THREE.Raycaster(), looked: 0 });
    page.on("drawn", () => this.#soon());
  }

  /** Which way to look at a box so that it is seen. @param wanted from it to the camera, z up @returns the same, turned and steeper where that is better, and how much nearer */
  clear(box, wanted, distance) {
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const points = this.#points(box);
    const others = this.#others(null);
    this.stage.viewer.scene.updateMatrixWorld(); // nothing may have been drawn yet
    let best = { seen: -1, direction: wanted, part: 1 };
    for (const rise of others.length ? RISES : [0]) {
      for (const turn of TURNS) {
        const direction = turned(wanted, turn, rise);
        const towards = new THREE.Vector3(direction[0], direction[2], -direction[1]).normalize();
        const eye = sphere.center.clone().addScaledVector(towards, distance);
        // From the robot outwards: a camera inside a wall sees through it from within, and still should not be there.
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

  // What is no part of the robot; `robot` is the one driven, where it is not the first.
  #others(robot) {
    const own = new Set(robot ? this.scene.nodes.filter((node) => this.scene.linkOf.get(node)?.startsWith(`world/${robot}::`)) : this.scene.own);
    return [...this.scene.groups.visual.values()].filter((group) => group.visible && !own.has(group.parent));
  }

  #hits(from, to, objects) {
    const way = to.clone().sub(from);
    Object.assign(this.ray, { near: NEAR * this.stage.radius, far: way.length() });
    this.ray.set(from, way.normalize());
    return this.ray.intersectObjects(objects, true);
  }

  #soon() {
    if (this.page.mode !== "sim" || this.timer) return;
    this.timer = setTimeout(() => ((this.timer = null), this.look()), OFTEN);
  }

  /** Make what hides the robot from the camera so thin that it can be seen through. */
  look() {
    const other = this.page.followed === undefined ? null : this.page.driven;
    const node = this.scene.nodes[this.page.followed ?? this.page.model?.root ?? 0];
    if (!node || this.page.cameras.way === "first") return this.scene.fade(new Set());
    const { camera } = this.stage.viewer;
    const others = this.#others(other);
    const hidden = new Set();
    for (const height of [0.3, 1]) {
      const point = node.getWorldPosition(new THREE.Vector3());
      point.y += height * this.stage.radius;
      const eye = camera.isOrthographicCamera ? camera.getWorldDirection(new THREE.Vector3()).multiplyScalar(-100).add(point) : camera.position;
      const near = point.distanceTo(eye) - NEAR * this.stage.radius;
      this.ray.near = 0;
      this.ray.far = Math.max(0, near);
      this.ray.set(eye, point.clone().sub(eye).normalize());
      for (const { object } of this.ray.intersectObjects(others, true)) hidden.add(object);
    }
    this.scene.fade(hidden);
  }
}

// A direction, turned about the vertical by degrees, and with more of it upwards.
function turned([x, y, z], degrees, rise) {
  const angle = (degrees * Math.PI) / 180;
  const flat = Math.hypot(x, y);
  return [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle), z + rise * flat];
}

export function sight(page) {
  page.sight = new Sight(page);
  page.expose("sight", page.sight);
}
