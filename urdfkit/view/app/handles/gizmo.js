// The handle of a link: a ball to drag it freely, arrows along the axes, rings about the axes.
/* global MeshCat */

const THREE = MeshCat.THREE;
export const COLOURS = [0xe5484d, 0x30a46c, 0x3e7bfa];
const ARROWS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [1, 0], ArrowDown: [-1, 0] };
const STEEP = 0.3; // of a direction's length parallel to the ground below which it counts as vertical
const TURN = (5 * Math.PI) / 180; // rad
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

/**
 * Move a handle by the arrow keys while `active()`, wherever the focus is, except in a field.
 * @param step length of a step [m]; @param moved called with x y z of the step in the frame of the grid, and the turn about z [rad]
 */
export function gizmoKeys(page, { active, step, moved }) {
  const listen = (event) => {
    if (!(event.key in ARROWS) || event.ctrlKey || event.metaKey || event.altKey || !active()) return;
    if (event.target.closest?.("input, select, textarea, dialog")) return;
    event.preventDefault();
    event.stopImmediatePropagation(); // the arrows drive a robot and rotate the view otherwise
    const [ahead, right] = ARROWS[event.key];
    if (event.shiftKey) return moved([0, 0, ahead * step], -right * TURN);
    const [x, y] = forward(page.viewport.viewer);
    moved([(x * ahead + y * right) * step, (y * ahead - x * right) * step, 0], 0);
  };
  addEventListener("keydown", listen, { capture: true });
}

// The axis of the ground that leads away from the viewer, x y.
function forward({ camera, scene }) {
  camera.updateMatrixWorld();
  const inside = scene.matrixWorld.clone().invert();
  const [up, back] = [new THREE.Vector3(), new THREE.Vector3()];
  camera.matrixWorld.extractBasis(new THREE.Vector3(), up, back);
  const ahead = back.negate().transformDirection(inside);
  const { x, y } = Math.hypot(ahead.x, ahead.y) > STEEP ? ahead : up.transformDirection(inside);
  return Math.abs(x) >= Math.abs(y) ? [Math.sign(x), 0] : [0, Math.sign(y)];
}
