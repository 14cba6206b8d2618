// Keeps the view moving where the processor draws: while something moves, frames that take too long are drawn without
// shadows and reflections, then with fewer pixels and triangles. A moment after the motion, one full frame is drawn, and when
// nothing has changed for a second one with smooth edges.

import { coarsen } from "../appearance/coarse_geometry.js";
import { quicken } from "../appearance/surfaces.js";
import { soft } from "./graphics_device.js";

const SLOW = 60; // ms per frame, above which a coarser level is used
const REST = 250; // ms, and twice the time of a frame: without motion for so long, the full frame is drawn
const STILL = 1000; // ms
const SMOOTH = 2; // pixels per pixel of the page of a frame with smooth edges
const CHECKED = 3; // every third frame is measured
const TRUSTED = 6000; // ms for which a level that was too slow is not tried again
const LEVELS = [
  // `pixels` per pixel of the page; only full frames have shadows and reflections
  { pixels: 1, isFull: true },
  { pixels: 1 },
  { pixels: 0.7 },
  { pixels: 0.5 },
  { pixels: 0.5, isCoarse: true }, // with fewer triangles
  { pixels: 0.35, isCoarse: true },
];

export class DrawingBudget {
  static LEVELS = LEVELS;

  constructor(viewport) {
    this.viewport = viewport;
    this.level = 0;
    this.used = 0; // level of the last frame
    this.count = 0;
    this.until = 0; // time until which something counts as moving
    this.held = false; // whether the camera or a slider is being dragged
    this.cost = 0; // of the last measured frame [ms]
    this.refused = LEVELS.map(() => -Infinity); // when each level was too slow
    this.on = soft;
    this.next = false; // whether the next frame has smooth edges
    this.smooth = false; // whether the last one has
    addEventListener("pointerdown", ({ target }) => target.matches?.("input[type=range]") && this.hold(true));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => this.held && this.hold(false));
  }

  /** Something moves: the camera, or the robot. */
  motion() {
    if (!this.on) return;
    const rest = REST + 2 * this.cost;
    this.until = performance.now() + rest;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.used > 0 && !this.held && this.viewport.dirty(), rest + 10);
  }

  /** The camera or a slider is being dragged, or no longer. */
  hold(held) {
    this.held = held;
    this.motion();
  }

  /** Draw a frame with `render`. */
  draw(render) {
    const moves = this.on && (this.held || performance.now() < this.until);
    const isNew = this.#use(moves ? this.level : 0); // its programs are compiled first: not measured
    this.#refine(this.next && this.on && !moves);
    const start = performance.now();
    render();
    if (!moves || isNew || this.count++ % CHECKED) return;
    // Reading a pixel waits until the frame is drawn.
    const gl = this.viewport.viewer.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const now = performance.now();
    this.cost = Math.min(now - start, 500);
    if (this.cost > SLOW) {
      this.refused[this.level] = now;
      this.level = Math.min(this.level + (this.cost > 3 * SLOW ? 2 : 1), LEVELS.length - 1);
    } else if (this.level > 0 && now - this.refused[this.level - 1] > TRUSTED) {
      this.level -= 1;
    }
  }

  // Draw the frame with smooth edges or without them, and the next one with them if nothing changes; not where a frame takes long.
  #refine(smooth) {
    const { viewer } = this.viewport;
    if (smooth !== this.smooth) viewer.renderer.setPixelRatio(smooth ? SMOOTH : LEVELS[this.used].pixels);
    this.smooth = smooth;
    this.next = false;
    clearTimeout(this.later);
    if (smooth || !this.on || LEVELS[this.level].isCoarse) return;
    this.later = setTimeout(() => ((this.next = true), viewer.set_dirty()), STILL + 2 * this.cost);
  }

  // Return whether the level has changed.
  #use(level) {
    if (level === this.used) return false;
    const { viewport } = this;
    const { renderer, scene } = viewport.viewer;
    const { pixels, isFull = false, isCoarse = false } = LEVELS[level];
    if (isCoarse !== (LEVELS[this.used].isCoarse ?? false)) coarsen(scene, isCoarse);
    this.used = level;
    renderer.setPixelRatio(pixels);
    viewport.shadows(isFull);
    quicken(scene, !isFull);
    if (isFull) renderer.shadowMap.needsUpdate = true;
    return true;
  }
}
