// Moving an object with the mouse or the arrow keys: a handle with arrows and rings, and a box at the target pose.
/* global MeshCat */

import { Gizmo, gizmoKeys } from "./gizmo.js";
import { HandleDrag } from "./handle_drag.js";

const THREE = MeshCat.THREE;
const SIZE = 0.13; // of the viewport's height
const GRID = 0.05; // m
const REST = 250; // ms after the last key until the object is moved
const UP = new THREE.Vector3(0, 0, 1);

export class Mover {
  /** @param moved called with x y z and a quaternion x y z w when the handle is released */
  constructor(page, moved) {
    this.page = page;
    this.moved = moved;
    this.viewer = page.viewport.viewer;
    this.gizmo = new Gizmo();
    this.ghost = new THREE.Group();
    this.ghost.visible = false;
    this.viewer.scene.add(this.gizmo, this.ghost);
    this.drag = null;
    this.timer = null;
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    pane.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"]) pane.addEventListener(end, (event) => this.#up(event), { capture: true });
    gizmoKeys(page, { active: () => this.held && !this.drag, step: GRID, moved: (by, turn) => this.#step(by, turn) });
    page.on("draw", () => this.#size());
  }

  get held() {
    return this.gizmo.visible;
  }

  /** Whether a move has begun that is not yet requested. */
  get moving() {
    return this.drag !== null || this.timer !== null;
  }

  /** Attach the handle to an object. @param links its links; @param pose x y z roll pitch yaw */
  take(links, pose) {
    const turn = new THREE.Quaternion().setFromEuler(new THREE.Euler(pose[3], pose[4], pose[5], "ZYX"));
    this.ghost.position.set(...pose.slice(0, 3));
    this.ghost.quaternion.copy(turn);
    this.ghost.clear();
    const box = new THREE.Box3();
    for (const link of links) for (const group of this.page.scene.shapes(link)) if (group.visible) box.expandByObject(group);
    if (!box.isEmpty()) this.ghost.add(this.#frame(box));
    this.gizmo.visible = true;
    this.gizmo.rings = true;
    this.#follow();
  }

  // The edges of a box in the viewport's world, as a child of the preview.
  #frame(box) {
    const [size, middle] = [box.getSize(new THREE.Vector3()), box.getCenter(new THREE.Vector3())];
    const edges = new THREE.LineSegments(new THREE.EdgesGeometry(new THREE.BoxGeometry(size.x, size.y, size.z)), new THREE.LineBasicMaterial({ color: 0xf5a524 }));
    const placed = new THREE.Matrix4().setPosition(middle);
    this.ghost.updateMatrix();
    const inside = new THREE.Matrix4().multiplyMatrices(this.viewer.scene.matrixWorld, this.ghost.matrix).invert().multiply(placed);
    inside.decompose(edges.position, edges.quaternion, edges.scale);
    return edges;
  }

  drop() {
    this.timer = clearTimeout(this.timer) ?? null;
    this.gizmo.visible = this.ghost.visible = false;
    this.drag = null;
    this.page.viewport.dirty();
  }

  #follow() {
    this.gizmo.position.copy(this.ghost.position);
    this.#size();
    this.page.viewport.dirty();
  }

  #size() {
    if (!this.gizmo.visible) return;
    const { camera, scene } = this.viewer;
    const at = scene.localToWorld(this.gizmo.position.clone());
    const height = camera.isOrthographicCamera ? (2 * (camera.userData.halfHeight ?? 1)) / camera.zoom : 2 * camera.position.distanceTo(at) * Math.tan((camera.fov * Math.PI) / 360);
    this.gizmo.scale.setScalar(SIZE * height);
  }

  #down(event) {
    if (!this.gizmo.visible || event.button !== 0 || this.drag) return;
    this.page.pick.aim(event);
    const handle = this.gizmo.hit(this.page.pick.ray);
    if (!handle) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    // The ball moves parallel to the ground; rings rotate in their plane.
    const { position, quaternion: turn } = this.ghost;
    this.drag = new HandleDrag(this.page, event, { kind: handle.kind === "free" ? "plane" : handle.kind, axis: handle.axis ?? UP, position, turn });
    this.ghost.visible = true;
  }

  #move(event) {
    const { drag } = this;
    if (!drag || event.pointerId !== drag.pointer) return;
    event.stopImmediatePropagation();
    const pose = drag.pose(event);
    if (!pose) return;
    if (drag.kind === "about") {
      const step = event.shiftKey ? pose.angle : (Math.round((pose.angle * 180) / Math.PI / 5) * 5 * Math.PI) / 180;
      this.ghost.quaternion.setFromAxisAngle(drag.axis, step).multiply(drag.turn);
    } else {
      this.ghost.position.copy(pose.position);
      if (!event.shiftKey) this.#snap(drag.kind === "along" ? drag.axis : null);
    }
    this.#follow();
  }

  // Keys pressed quickly move the object once, after the last one.
  #step(by, turn) {
    this.ghost.visible = true;
    this.ghost.position.add(new THREE.Vector3(...by));
    this.ghost.quaternion.premultiply(new THREE.Quaternion().setFromAxisAngle(UP, turn));
    this.#follow();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = null;
      this.ghost.visible = false;
      this.#done();
    }, REST);
  }

  #done() {
    this.moved([...this.ghost.position.toArray(), ...this.ghost.quaternion.toArray()]);
  }

  // To the grid, along the moved axis or in the plane; with Shift the object moves freely.
  #snap(axis) {
    for (const part of "xyz") {
      const moves = axis ? Math.abs(axis[part]) > 0.5 : part !== "z";
      if (moves) this.ghost.position[part] = Math.round(this.ghost.position[part] / GRID) * GRID;
    }
  }

  #up(event) {
    const { drag } = this;
    if (!drag || event.pointerId !== drag.pointer) return;
    event.stopImmediatePropagation();
    drag.end();
    this.drag = null;
    this.ghost.visible = false;
    const moved = this.ghost.position.distanceTo(drag.position) > 1e-6 || this.ghost.quaternion.angleTo(drag.turn) > 1e-6;
    if (moved) this.#done();
    this.page.viewport.dirty();
  }
}
