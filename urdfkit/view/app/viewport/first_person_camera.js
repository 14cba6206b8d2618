// First-person camera: drag to look around, W A S D and Q E to move (in the simulation these keys drive the robot).
/* global MeshCat */

const THREE = MeshCat.THREE;
const MOVES = { w: [1, 0, 0], s: [-1, 0, 0], a: [0, 1, 0], d: [0, -1, 0], e: [0, 0, 1], q: [0, 0, -1] };
const TURN = 0.004; // radians per pixel

export class FirstPerson {
  constructor(page, camera, controls) {
    Object.assign(this, { page, camera, controls, on: false, held: new Set(), last: null });
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => {
      if (!this.on) return;
      this.last = [event.clientX, event.clientY];
      pane.setPointerCapture(event.pointerId);
    });
    pane.addEventListener("pointermove", (event) => this.#look(event));
    for (const end of ["pointerup", "pointercancel"]) pane.addEventListener(end, () => (this.last = null));
    pane.addEventListener("wheel", (event) => this.on && this.#step([-Math.sign(event.deltaY), 0, 0], 0.15), { passive: true });
    addEventListener("keydown", (event) => this.#key(event, true), { capture: true });
    addEventListener("keyup", (event) => this.#key(event, false), { capture: true });
    addEventListener("blur", () => this.held.clear());
  }

  use(on) {
    this.on = on;
    this.controls.enabled = !on;
    this.held.clear();
    if (on) this.turn(0, 0);
  }

  // The target of the orbit controls is kept straight ahead.
  turn(yaw, pitch) {
    const { camera, controls } = this;
    const ahead = controls.target.clone().sub(camera.position);
    const at = new THREE.Spherical().setFromVector3(ahead);
    at.theta += yaw;
    at.phi = Math.max(0.05, Math.min(Math.PI - 0.05, at.phi + pitch));
    at.radius = Math.max(at.radius, controls.minDistance * 1.01);
    controls.target.copy(camera.position).add(new THREE.Vector3().setFromSpherical(at));
    this.page.viewport.dirty();
  }

  #look(event) {
    if (!this.on || !this.last) return;
    const [x, y] = this.last;
    this.last = [event.clientX, event.clientY];
    this.turn(-(event.clientX - x) * TURN, (event.clientY - y) * TURN);
  }

  #key(event, down) {
    if (!this.on || this.page.mode !== "view" || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target instanceof Element && event.target.closest("input, textarea, select, dialog")) return;
    const key = event.key.toLowerCase();
    if (!(key in MOVES)) return;
    event.preventDefault();
    event.stopImmediatePropagation(); // these keys have other functions elsewhere
    if (!down) return void this.held.delete(key);
    const idle = this.held.size === 0;
    this.held.add(key);
    if (idle) this.#go(performance.now());
  }

  #go(before) {
    requestAnimationFrame((now) => {
      if (!this.on || this.held.size === 0) return;
      const seconds = Math.min(0.1, (now - before) / 1000);
      const sum = [0, 0, 0];
      for (const key of this.held) MOVES[key].forEach((x, i) => (sum[i] += x));
      this.#step(sum, 1.5 * seconds);
      this.#go(now);
    });
  }

  // @param direction ahead, left, up; @param distance in robot radii
  #step([ahead, left, up], distance) {
    const { camera, controls } = this;
    const forward = controls.target.clone().sub(camera.position).normalize();
    const side = new THREE.Vector3(0, 1, 0).cross(forward).normalize();
    const move = forward.multiplyScalar(ahead).addScaledVector(side, left).add(new THREE.Vector3(0, up, 0));
    move.multiplyScalar(distance * this.page.viewport.radius);
    camera.position.add(move);
    controls.target.add(move);
    this.page.viewport.dirty();
  }
}
