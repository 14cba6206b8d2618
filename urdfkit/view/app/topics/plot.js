// A plot on a canvas: curves over time, a window that follows the time or is fixed, values under the mouse.

import { Grip } from "./plot_zoom.js";

export const COLOURS = ["#3b7df5", "#e0399b", "#0aa37f", "#e08a00", "#7a5cff", "#00a3c4", "#d1453b", "#6b8e23"];
const KEPT = 30000; // maximum number of samples of a curve
const LEFT = 46;
const BELOW = 20;

/** Samples of one number with increasing t in memory of a fixed size; beyond `KEPT` the oldest tenth is dropped. */
export class Curve {
  constructor(name, colour) {
    this.name = name;
    this.colour = colour;
    this.t = new Float64Array(KEPT).fill(NaN); // filled: the memory is in use from the start and does not grow for minutes
    this.values = new Float64Array(KEPT).fill(NaN);
    this.clear();
  }

  push(t, values) {
    if (this.length && t.length && t[0] < this.last - 1e-9) this.clear(); // the simulation was reset
    for (let i = Math.max(0, t.length - KEPT); i < t.length; i += 1) {
      if (this.length === KEPT) this.#drop(KEPT / 10);
      this.t[this.length] = t[i];
      this.values[this.length] = values[i] ?? NaN;
      if (Math.abs(values[i]) > this.greatest) this.greatest = Math.abs(values[i]);
      this.length += 1;
    }
  }

  clear() {
    this.length = 0;
    this.greatest = 0; // magnitude of all samples
  }

  /** Time of the last sample; undefined without samples. */
  get last() {
    return this.length ? this.t[this.length - 1] : undefined;
  }

  /** Index of the first sample at or after a time. */
  from(time) {
    let [low, high] = [0, this.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  #drop(count) {
    for (const samples of [this.t, this.values]) samples.copyWithin(0, count);
    this.length -= count;
  }
}

export class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    [this.left, this.below] = [LEFT, BELOW];
    this.range = [-1, 1]; // range of the values in the last drawing
    this.curves = [];
    this.span = 10; // seconds shown
    this.end = null; // right edge of a fixed window; null while it follows the time
    this.vertical = null; // [low, high] after the user has zoomed
    this.pointer = null;
    new Grip(this);
    new ResizeObserver(() => this.dirty()).observe(canvas);
  }

  get latest() {
    return Math.max(0, ...this.curves.map(({ last }) => last ?? 0));
  }

  get paused() {
    return this.end !== null;
  }

  pause(paused) {
    this.end = paused ? (this.end ?? this.latest) : null;
    this.changed?.();
    this.dirty();
  }

  follow() {
    this.vertical = null;
    this.pause(false);
  }

  dirty() {
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.#draw();
    });
  }

  /** Zoom in time; `at` is the fixed point, as a fraction of the window from the left. */
  zoom(factor, at) {
    const right = this.end ?? this.latest;
    const time = right - this.span * (1 - at);
    const span = Math.min(600, Math.max(0.05, this.span * factor));
    if (this.paused) this.end = time + (right - time) * (span / this.span);
    this.span = span;
    this.dirty();
  }

  /** Zoom in value; `at` is the fixed point, as a fraction of the window from the top. */
  scale(factor, at) {
    const [low, high] = this.range;
    const middle = high - at * (high - low);
    this.vertical = [middle + (low - middle) * factor, middle + (high - middle) * factor];
    this.dirty();
  }

  /** Move the window by a fraction of its width, later in time; it no longer follows the time. */
  shift(part) {
    this.end = (this.end ?? this.latest) + part * this.span;
    this.changed?.();
    this.dirty();
  }

  /** Move the window up by a fraction of its height. */
  raise(part) {
    const [low, high] = this.range;
    this.vertical = [low, high].map((value) => value + part * (high - low));
    this.dirty();
  }

  /** Show the values at a point of the canvas, or none. */
  look(place) {
    this.pointer = place;
    this.dirty();
  }

  #fit(begin, end) {
    let [low, high] = [Infinity, -Infinity];
    for (const curve of this.curves) {
      for (let i = Math.max(0, curve.from(begin) - 1); i < curve.length && curve.t[i] <= end; i += 1) {
        const value = curve.values[i];
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (!(low <= high)) return [-1, 1];
    const room = Math.max((high - low) * 0.08, Math.abs(high) * 1e-6, 1e-9);
    return high - low < 1e-12 ? [low - Math.max(0.5, Math.abs(low) * 0.1), high + Math.max(0.5, Math.abs(high) * 0.1)] : [low - room, high + room];
  }

  #draw() {
    const { canvas } = this;
    const [width, height, ratio] = [canvas.clientWidth, canvas.clientHeight, Math.min(devicePixelRatio, 2)];
    if (!width) return;
    if (canvas.width !== Math.round(width * ratio)) Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const style = getComputedStyle(canvas);
    const [quiet, line, text] = ["--quiet", "--line", "--text"].map((name) => style.getPropertyValue(name));
    const end = this.end ?? this.latest;
    const begin = end - this.span;
    const [low, high] = (this.range = this.vertical ?? this.#fit(begin, end));
    const x = (t) => LEFT + ((t - begin) / this.span) * (width - LEFT);
    const y = (value) => (height - BELOW) * (1 - (value - low) / (high - low));
    pen.font = "11px system-ui, sans-serif";
    this.#axes(pen, { width, height, begin, end, low, high, x, y, quiet, line });
    pen.save();
    pen.beginPath();
    pen.rect(LEFT, 0, width - LEFT, height - BELOW);
    pen.clip();
    for (const curve of this.curves) this.#curve(pen, curve, begin, end, x, y);
    pen.restore();
    if (this.pointer && this.pointer.x > LEFT) this.#values(pen, { width, height, begin, x, y, text, quiet });
  }

  #axes(pen, { width, height, begin, end, low, high, x, y, quiet, line }) {
    pen.strokeStyle = line;
    pen.fillStyle = quiet;
    pen.lineWidth = 1;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const value of ticks(low, high, height / 40)) {
      pen.beginPath();
      pen.moveTo(LEFT, y(value));
      pen.lineTo(width, y(value));
      pen.stroke();
      if (y(value) > 5) pen.fillText(label(value, high - low), LEFT - 5, y(value));
    }
    pen.textAlign = "center";
    for (const value of ticks(begin, end, width / 80)) {
      if (x(value) < LEFT + 8 || x(value) > width - 12) continue;
      pen.beginPath();
      pen.moveTo(x(value), 0);
      pen.lineTo(x(value), height - BELOW);
      pen.stroke();
      pen.fillText(`${label(value, this.span)} s`, x(value), height - BELOW / 2);
    }
  }

  // Each column of pixels shows the minimum and maximum of its samples, so that peaks stay visible.
  #curve(pen, curve, begin, end, x, y) {
    pen.strokeStyle = curve.colour;
    pen.lineWidth = 1.6;
    pen.lineJoin = "round";
    pen.beginPath();
    let [column, low, high, open] = [null, 0, 0, false];
    const first = Math.max(0, curve.from(begin) - 1);
    for (let i = first; i < curve.length && (i === first || curve.t[i - 1] <= end); i += 1) {
      const value = curve.values[i];
      if (Number.isNaN(value)) {
        open = false;
        continue;
      }
      const at = x(curve.t[i]);
      if (open && Math.round(at) === column) {
        if (value < low) pen.lineTo(at, y((low = value)));
        if (value > high) pen.lineTo(at, y((high = value)));
        continue;
      }
      [column, low, high] = [Math.round(at), value, value];
      if (open) pen.lineTo(at, y(value));
      else pen.moveTo(at, y(value));
      open = true;
    }
    pen.stroke();
  }

  #values(pen, { width, height, begin, x, y, text, quiet }) {
    const t = begin + ((this.pointer.x - LEFT) / (width - LEFT)) * this.span;
    pen.strokeStyle = quiet;
    pen.beginPath();
    pen.moveTo(this.pointer.x, 0);
    pen.lineTo(this.pointer.x, height - BELOW);
    pen.stroke();
    pen.textAlign = this.pointer.x > width / 2 ? "right" : "left";
    const side = this.pointer.x > width / 2 ? -7 : 7;
    this.curves.forEach((curve, k) => {
      const i = Math.min(curve.length - 1, curve.from(t));
      if (i < 0) return;
      pen.fillStyle = curve.colour;
      pen.beginPath();
      pen.arc(x(curve.t[i]), y(curve.values[i]), 3, 0, 7);
      pen.fill();
      pen.fillText(String(Number(curve.values[i].toPrecision(5))), this.pointer.x + side, 10 + 14 * k);
    });
    pen.fillStyle = text;
    pen.fillText(`${t.toFixed(this.span < 2 ? 3 : 2)} s`, this.pointer.x + side, height - BELOW - 8);
  }
}

/** About `count` round numbers between two bounds. */
export function ticks(low, high, wanted) {
  const rough = (high - low) / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= rough) ?? 10 * power;
  const found = [];
  for (let value = Math.ceil(low / step) * step; value <= high && found.length < 50; value += step) found.push(Math.abs(value) < step / 1e6 ? 0 : value);
  return found;
}

function label(value, span) {
  if (value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-4)) return value.toExponential(1);
  return String(Number(value.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(span)))))));
}
