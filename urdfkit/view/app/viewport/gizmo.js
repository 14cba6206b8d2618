// The handle of a link: a ball to drag it freely, arrows along the axes, rings about the axes.
/* global MeshCat */

const THREE = MeshCat.THREE;
const COLOURS = [0xe5484d, 0x30a46c, 0x3e7bfa];
const AXES = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, 1)];

function material(color, opacity = 0.95) {
  return new THREE.MeshBasicMaterial({ color, opacity, transparent: true, depthTest: false, side: THREE.DoubleSide });
}

export class Gizmo extends THREE.Group {
  constructor() {
    super();
    this.visible = false;
    this.handles = [];
    this.#add("free", new THREE.SphereGeometry(0.11, 20, 14), material(0xf5a524));
    AXES.forEach((axis, i) => {
      const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis);
      const paint = material(COLOURS[i]);
      this.#add("along", new THREE.CylinderGeometry(0.025, 0.025, 0.7, 8).translate(0, 0.5, 0), paint, axis, turn);
      this.#add("along", new THREE.ConeGeometry(0.085, 0.25, 14).translate(0, 0.95, 0), paint, axis, turn);
      this.#add("along", new THREE.CylinderGeometry(0.11, 0.11, 1, 6).translate(0, 0.6, 0), material(COLOURS[i], 0), axis, turn);
      const about = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), axis);
      this.#add("about", new THREE.TorusGeometry(0.72, 0.022, 8, 56), material(COLOURS[i], 0.8), axis, about);
      this.#add("about", new THREE.TorusGeometry(0.72, 0.08, 6, 40), material(COLOURS[i], 0), axis, about);
    });
  }

  #add(kind, geometry, paint, axis = null, turn = null) {
    const mesh = new THREE.Mesh(geometry, paint);
    mesh.renderOrder = 40;
    mesh.userData = { kind, axis };
    if (turn) mesh.quaternion.copy(turn);
    this.handles.push(mesh);
    this.add(mesh);
  }

  set rings(shown) {
    for (const mesh of this.handles) if (mesh.userData.kind === "about") mesh.visible = shown;
  }

  /** The part of the handle that a ray hits: {kind, axis} or null; first the ball, then visible parts, then their margins. */
  hit(ray) {
    if (!this.visible) return null;
    const hits = ray.intersectObjects(this.handles.filter((mesh) => mesh.visible), false);
    const rank = ({ object: { userData, material: paint } }) => (userData.kind === "free" ? 0 : paint.opacity > 0 ? 1 : 2);
    return hits.length ? hits.reduce((best, hit) => (rank(hit) < rank(best) ? hit : best)).object.userData : null;
  }
}

/** The point on the line `from + s·along` that is nearest to a ray; all vectors in the world. */
export function nearest(ray, from, along) {
  const w = from.clone().sub(ray.origin);
  const b = along.dot(ray.direction);
  const below = 1 - b * b;
  if (below < 1e-4) return null; // the ray is parallel to the line
  const s = (b * ray.direction.dot(w) - along.dot(w)) / below;
  return from.clone().addScaledVector(along, s);
}
