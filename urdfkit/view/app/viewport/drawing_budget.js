// Keeps the view moving where the processor draws: while something moves, frames that take too long are drawn with fewer
// pixels and without shadows. A moment after the motion, one full frame is drawn.
/* global MeshCat */

import { soft } from "./graphics_device.js";

const SLOW = 80; // ms per frame, above which a coarser level is used
const QUICK = 25; // ms per frame, below which a finer level is used
const REST = 250; // ms, and twice the time of a frame: without motion for so long, the full frame is drawn
const CHECKED = 3; // every third frame is measured
const LEVELS = [null, 0.7, 0.5, 0.35]; // pixels per pixel of the page; null: full frames with shadows

export class DrawingBudget {
  constructor(viewport) {
    this.viewport = viewport;
    this.level = 0;
    this.used = 0; // level of the last frame
    this.count = 0;
    this.until = 0; // time until which something counts as moving
    this.held = false; // whether the camera is being dragged
    this.cost = 0; // of the last measured frame [ms]
    this.on = soft;
  }

  /** Something moves: the camera, or the robot. */
  motion() {
    if (!this.on) return;
    const rest = REST + 2 * this.cost;
    this.until = performance.now() + rest;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.used > 0 && !this.held && this.viewport.dirty(), rest + 10);
  }

  /** The camera is being dragged, or no longer. */
  hold(held) {
    this.held = held;
    this.motion();
  }

  /** Draw a frame with `render`. */
  draw(render) {
    const moves = this.on && (this.held || performance.now() < this.until);
    this.#use(moves ? this.level : 0);
    const start = performance.now();
    render();
    if (!this.on || (moves ? this.count++ % CHECKED : this.level)) return;
    // Reading a pixel waits until the frame is drawn.
    const gl = this.viewport.viewer.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    this.cost = Math.min(performance.now() - start, 500);
    if (this.cost > SLOW) this.level = Math.min(this.level + (this.cost > 3 * SLOW ? 2 : 1), LEVELS.length - 1);
    else if (this.cost < QUICK) this.level = Math.max(this.level - 1, 0);
  }

  #use(level) {
    if (level === this.used) return;
    const { viewport } = this;
    const { renderer } = viewport.viewer;
    this.used = level;
    renderer.setPixelRatio(LEVELS[level] ?? 1);
    viewport.shadows(level === 0);
    if (level === 0) renderer.shadowMap.needsUpdate = true;
  }
}
