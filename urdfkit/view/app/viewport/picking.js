// Picking: the link under the mouse, selection by clicks, clicks for the active tool, tooltips with link names.
/* global MeshCat */

const THREE = MeshCat.THREE;
const STILL = 5; // pixels that the mouse may move during a click
const SNAP = 9; // pixels within which a click snaps to a corner

export class Pick {
  constructor(page) {
    this.page = page;
    this.pane = page.viewport.pane;
    this.ray = new THREE.Raycaster();
    this.down = null;
    this.hovered = null;
    this.last = null;
    this.rest = 0;
    this.pane.addEventListener("pointerdown", (event) => this.#down(event));
    this.pane.addEventListener("pointerup", (event) => this.#up(event));
    this.pane.addEventListener("pointermove", (event) => this.#move(event));
    this.pane.addEventListener("pointerleave", () => this.#hover(null));
    this.pane.addEventListener("dblclick", (event) => this.#look(event));
  }

  /** Aim the ray from the camera through a point of the window. */
  aim({ clientX, clientY }) {
    const { left, top, width, height } = this.pane.getBoundingClientRect();
    const at = new THREE.Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
    this.ray.setFromCamera(at, this.page.viewport.viewer.camera);
    return this.ray.ray;
  }

  /**
   * The hit at a point of the window: {link, local, point} or null. `local` is in the link's frame, `point` in the
   * frame of the grid [m]. If nothing is hit and `ground` is set, the hit is on the ground (link null).
   */
  at(event, { ground = false, snap = false } = {}) {
    const ray = this.aim(event);
    for (const hit of this.ray.intersectObjects(this.page.scene.solid, true)) {
      const link = this.page.scene.owner(hit.object);
      if (!link || this.page.scene.faded.has(hit.object)) continue; // transparent obstacles cannot be picked
      const world = (snap && this.#corner(hit, event)) || hit.point;
      return { link, object: hit.object, ...this.#placed(link, world) };
    }
    if (!ground) return null;
    const plane = new THREE.Plane(new THREE.Vector3(0, 1, 0), 0);
    const world = ray.intersectPlane(plane, new THREE.Vector3());
    return world && { link: null, object: null, ...this.#placed(null, world) };
  }

  #placed(link, world) {
    const point = this.page.viewport.viewer.scene.worldToLocal(world.clone()).toArray();
    const local = link ? this.page.scene.byLink.get(link).worldToLocal(world.clone()).toArray() : point;
    return { local, point };
  }

  // The corner of the hit face within the snap distance.
  #corner({ object, face }, event) {
    const position = object.geometry.getAttribute("position");
    let best = null;
    let nearest = SNAP;
    for (const index of [face.a, face.b, face.c]) {
      const corner = object.localToWorld(new THREE.Vector3().fromBufferAttribute(position, index));
      const [x, y] = this.page.labels.screen(corner);
      const { left, top } = this.pane.getBoundingClientRect();
      const distance = Math.hypot(x + left - event.clientX, y + top - event.clientY);
      if (distance < nearest) [best, nearest] = [corner, distance];
    }
    return best;
  }

  #down(event) {
    this.down = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    this.#hover(null);
  }

  #up(event) {
    if (!this.down || Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) > STILL) return;
    this.down = null;
    const tool = this.page.tools.held;
    if (tool && this.page.tools.takesClicks(tool)) {
      const hit = this.at(event, { ground: true, snap: true });
      if (hit) this.page.emit("click3d", { ...hit, event });
      return;
    }
    const hit = this.at(event);
    this.page.select(hit ? { link: hit.link } : null);
  }

  #move(event) {
    if (event.pointerType !== "mouse" || event.buttons) return;
    const waiting = this.last;
    this.last = event;
    if (!waiting) this.#soon();
  }

  // At most once per frame; with many triangles, picking uses at most a quarter of the time.
  #soon() {
    requestAnimationFrame((now) => {
      if (now < this.rest) return this.#soon();
      const last = this.last;
      this.last = null;
      if (!last) return;
      const start = performance.now();
      this.#hover(this.at(last), last);
      this.rest = performance.now() + 3 * (performance.now() - start);
    });
  }

  #hover(hit, event = null) {
    const link = hit?.link ?? null;
    if (link !== this.hovered) this.page.emit("hover", link);
    this.hovered = link;
    this.page.labels.tip(link?.replace(/^world\//, ""), event);
  }

  // A double click centres the view on the hit point.
  #look(event) {
    const hit = this.at(event, { ground: true });
    if (!hit) return;
    const { camera, controls } = this.page.viewport.viewer;
    const target = this.page.viewport.viewer.scene.localToWorld(new THREE.Vector3(...hit.point));
    camera.position.add(target.clone().sub(controls.target));
    controls.target.copy(target);
    this.page.viewport.dirty();
  }
}

/** Highlight selected and hovered links. */
function glow(page) {
  const shades = { select: 0x17458f, hover: 0x30353c };
  const glowing = { select: null, hover: null };
  function paint(link, colour) {
    for (const group of page.scene.shapes(link)) group.traverse(({ material }) => material?.emissive?.setHex(colour));
  }
  function update(kind, link) {
    const old = glowing[kind];
    glowing[kind] = link;
    if (old) paint(old, old === glowing.select ? shades.select : 0);
    const { select, hover } = glowing;
    if (hover && hover !== select) paint(hover, shades.hover);
    if (select) paint(select, shades.select);
    page.viewport.dirty();
  }
  page.on("select", (selected) => update("select", selected?.link ?? page.childOf?.(selected?.joint) ?? null));
  page.on("hover", (link) => update("hover", link));
  page.on("model", () => setTimeout(() => update("select", glowing.select)));
  page.scene.arrived = () => update("select", glowing.select);
}

export function pick(page) {
  page.pick = new Pick(page);
  glow(page);
  page.expose("pick", page.pick);
}
