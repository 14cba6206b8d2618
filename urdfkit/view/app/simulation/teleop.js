// Teleoperation: input of keys, pad, sliders and gamepad, sent as axes twenty times a second until it is zero.

import { Pad } from "./drive_pad.js";

const PERIOD = 50; // ms
const SHIFTED = { "<": ",", ">": ".", ";": ",", ":": "." };

export class Drive {
  /** @param send called with {axes, speed, turn, robot}; @param pause called for the pause key; @param halt for stop */
  constructor(send, pause, halt) {
    Object.assign(this, { send, pause, halt });
    this.moves = {};
    this.factors = {};
    this.robot = "";
    this.down = new Map(); // KeyboardEvent.code → key
    this.shift = false;
    this.stick = [0, 0];
    this.held = new Map(); // other inputs: name → [x, y, z, turn]
    this.timer = null;
    this.speed = new Speed("speed", "m/s");
    this.turn = new Speed("turn", "rad/s");
    for (const speed of [this.speed, this.turn]) speed.input.addEventListener("input", () => this.changed());
    this.pad = new Pad((forward, left) => {
      this.stick = [forward, left];
      this.changed();
    });
  }

  /** Set the key tables and speeds of the server, and handle key events. */
  use({ moves, factors, speed, turn }) {
    const listening = Object.keys(this.moves).length > 0;
    Object.assign(this, { moves, factors });
    if (listening) return;
    this.speed.set(speed);
    this.turn.set(turn);
    addEventListener("keydown", (event) => this.#keydown(event));
    addEventListener("keyup", (event) => this.#keyup(event));
    // When the page loses the keyboard, all input is released.
    addEventListener("blur", () => this.release());
    addEventListener("pagehide", () => this.release());
    document.addEventListener("visibilitychange", () => document.hidden && this.release());
  }

  /** Set the input of another source than keys and pad: axes [x, y, z, turn], each -1..1. */
  hold(name, axes) {
    if (axes.some(Boolean)) this.held.set(name, axes);
    else if (!this.held.delete(name)) return;
    this.changed();
  }

  /** Select the driven robot. */
  take(robot) {
    if (robot === this.robot) return;
    this.release();
    this.robot = robot;
  }

  /** Stop all robots, whichever page drives. */
  stop() {
    this.release();
    this.halt();
  }

  release() {
    this.down.clear();
    this.held.clear();
    this.shift = false;
    if (this.pad.pointer !== null) this.pad.release();
    this.stick = [0, 0];
    this.released?.();
    this.changed();
  }

  #keydown(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return this.release();
    const target = event.target instanceof Element ? event.target : document.body;
    if (target.closest("input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select") || document.querySelector("dialog[open]")) return;
    this.shift = event.shiftKey;
    const key = SHIFTED[event.key] ?? (event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (event.key === "Shift") return this.changed();
    const onControl = target.closest("input, button, summary, a");
    if (key.startsWith("Arrow") && onControl?.matches("input[type=range]")) return; // it moves the slider
    if (key === " " && onControl) return; // it presses the button
    if (key in this.moves) {
      event.preventDefault();
      if (!event.repeat) this.down.set(event.code || key, key), this.changed();
    } else if (key in this.factors) {
      const [speed, turn] = this.factors[key];
      this.speed.scale(speed);
      this.turn.scale(turn);
      this.changed();
    } else if (key === "p") {
      if (!event.repeat) this.pause();
    } else if (key === "k" || key === " ") {
      event.preventDefault();
      if (!event.repeat) this.stop();
    }
  }

  #keyup(event) {
    this.shift = event.shiftKey;
    if (this.down.delete(event.code || event.key.toLowerCase()) || event.key === "Shift") this.changed();
    if (event.key === "Meta") this.release(); // macOS sends no keyup events for keys held with it
  }

  /** The current input: x, y, z, turn, each -1..1. */
  axes() {
    const sum = [this.stick[0], this.shift ? this.stick[1] : 0, 0, this.shift ? 0 : this.stick[1]];
    const add = (axes) => axes.forEach((value, i) => (sum[i] += value));
    for (const key of this.down.values()) add(this.#direction(key));
    for (const axes of this.held.values()) add(axes);
    return sum.map((value) => Math.max(-1, Math.min(1, value)));
  }

  #direction(key) {
    const move = this.moves[key];
    if (!this.shift) return move;
    const strafe = this.moves[{ ",": "<", ".": ">" }[key] ?? key.toUpperCase()];
    return strafe && strafe !== move ? strafe : [move[0], move[3], move[2], 0];
  }

  changed() {
    const axes = this.axes();
    const moving = axes.some(Boolean);
    if (moving || this.timer !== null) this.#send(axes);
    if (moving && this.timer === null) this.timer = setInterval(() => this.#send(this.axes()), PERIOD);
    if (!moving && this.timer !== null) this.timer = clearInterval(this.timer) ?? null;
  }

  #send(axes) {
    this.send({ axes, speed: this.speed.value, turn: this.turn.value, robot: this.robot });
  }
}

class Speed {
  constructor(id, unit) {
    this.input = document.getElementById(id);
    this.output = document.getElementById(`${id}-value`);
    this.unit = unit;
    this.input.addEventListener("input", () => this.set(this.input.valueAsNumber));
    // After the pointer is released, the arrow keys drive again.
    this.input.addEventListener("pointerup", () => this.input.blur());
  }

  set(value) {
    this.value = Math.min(Number(this.input.max), Math.max(Number(this.input.min), value));
    this.input.value = this.value;
    this.output.textContent = `${this.value.toFixed(2)} ${this.unit}`;
  }

  scale(factor) {
    if (factor !== 1) this.set(this.value * factor);
  }
}
