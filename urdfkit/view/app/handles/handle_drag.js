// Dragging a pose with the mouse: along an axis, parallel to a plane, about an axis, or about the axes of the screen.
/* global MeshCat */

import { nearest } from "./gizmo.js";

const THREE = MeshCat.THREE;
const PER_PIXEL = 0.01; // rad

export class HandleDrag {
  /**
   * @param kind "along", "plane", "about" or "turn"; @param axis of the motion, or normal of the plane
   * @param position the pose at the start, like `turn` and `axis` in the frame of the grid
   */
  constructor(page, event, { kind, axis, position, turn }) {
    Object.assign(this, { page, kind, axis, position: position.clone(), turn: turn.clone(), pointer: event.pointerId, start: [event.clientX, event.clientY] });
    const { scene, controls } = page.viewport.viewer;
    this.scene = scene;
    this.at = scene.localToWorld(position.clone());
    this.world = axis?.clone().transformDirection(scene.matrixWorld) ?? null;
    if (axis) this.plane = new THREE.Plane().setFromNormalAndCoplanarPoint(this.world, this.at);
    this.from = this.#grip(event);
    page.viewport.pane.setPointerCapture(event.pointerId);
    controls.enabled = false;
  }

  /** The pose for the position of the pointer: {position, turn, angle}, or null if a ray misses. */
  pose(event) {
    const { axis, kind, position, turn } = this;
    if (kind === "turn") return { position, turn: this.#turned(event).multiply(turn) };
    const now = this.#grip(event);
    if (!now || !this.from) return null;
    const [a, b] = [this.from, now].map((point) => this.scene.worldToLocal(point.clone()));
    if (kind !== "about") return { position: position.clone().add(b.sub(a)), turn };
    [a, b].forEach((point) => point.sub(position));
    const angle = Math.atan2(axis.dot(a.clone().cross(b)), a.dot(b));
    return { position, angle, turn: new THREE.Quaternion().setFromAxisAngle(axis, angle).multiply(turn) };
  }

  end() {
    this.page.viewport.viewer.controls.enabled = this.page.cameras.way !== "first";
  }

  #grip(event) {
    if (!this.axis) return null;
    const ray = this.page.pick.aim(event);
    return this.kind === "along" ? nearest(ray, this.at, this.world) : ray.intersectPlane(this.plane, new THREE.Vector3());
  }

  #turned({ clientX, clientY }) {
    const [x, y] = screen(this.page.viewport.viewer);
    const [across, down] = [clientX - this.start[0], clientY - this.start[1]];
    return new THREE.Quaternion().setFromAxisAngle(y, across * PER_PIXEL).multiply(new THREE.Quaternion().setFromAxisAngle(x, down * PER_PIXEL));
  }
}

/** Right, up and towards the viewer, in the frame of the grid. */
export function screen({ camera, scene }) {
  camera.updateMatrixWorld();
  const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  camera.matrixWorld.extractBasis(...axes);
  const inside = scene.matrixWorld.clone().invert();
  return axes.map((axis) => axis.transformDirection(inside));
}
