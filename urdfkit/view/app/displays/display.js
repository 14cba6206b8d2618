// The display of one topic in the 3-D view, with its options: colour, size, the field that colours points, and decay.
/* global MeshCat */

import { build, decode, dispose, HEIGHT, ONE_COLOUR } from "./drawing.js";
import { h } from "../page/dom.js";
import { numberField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const MOST = 60; // drawings that are kept by the decay
const COLOURS = ["#e0399b", "#0aa37f", "#e08a00", "#7a5cff", "#3b7df5", "#d6402f"];
let count = 0;

export class Display {
  /** @param topic name and type; @param controls names of the options that change its drawing; @param options of a saved layout */
  constructor(page, { topic, type, controls }, options = {}) {
    Object.assign(this, { page, topic, type, controls });
    this.options = { on: false, color: COLOURS[count++ % COLOURS.length], size: 1, decay: 0, field: "", ...options };
    this.drawn = []; // {time, root, groups}
    this.arrived = this.newest = 0; // numbers of messages with maps: the last one, and the last that needs no drawing any more
    this.late = null; // the newest message that waits for the end of a drag
    this.handles = h("div.handles");
    this.#row();
    if (this.options.on) this.#subscribe(true);
  }

  get key() {
    return `display:${this.topic}${this.options.field ? `:${this.options.field}` : ""}`;
  }

  #row() {
    const id = `display-${this.topic.replaceAll(/\W/g, "-")}`;
    this.box = h("input", { type: "checkbox", id, checked: this.options.on });
    this.box.addEventListener("change", () => this.turn(this.box.checked));
    this.fault = h("p.quiet.fault-line", { role: "status", hidden: true });
    this.more = h("div.display-options", { hidden: !this.options.on }, ...this.#controls(), this.handles);
    const label = h("label.check", { for: id, title: this.type }, this.box, h("span.name", {}, ` ${this.topic} `), h("small.quiet", {}, this.type.split("/").pop()));
    this.item = h("li.display", { "data-display": this.topic }, label, this.fault, this.more);
  }

  #controls() {
    const color = h("input", { type: "color", value: this.options.color, "aria-label": `Colour of ${this.topic}` });
    color.addEventListener("input", () => this.#set({ color: color.value }));
    const size = h("input", { type: "range", min: 0.2, max: 5, step: 0.1, value: this.options.size, "aria-label": `Size of ${this.topic}` });
    size.addEventListener("input", () => this.#set({ size: size.valueAsNumber }));
    if (!this.controls.includes("field")) return this.controls.map((name) => ({ color, size })[name]);
    // Without a choice, a cloud has the colours of its points, else those of their height, and a scan has one colour.
    const byHeight = this.controls.includes("height");
    const choices = byHeight ? { "": "colour or height", [HEIGHT]: HEIGHT, [ONE_COLOUR]: ONE_COLOUR } : { "": ONE_COLOUR };
    const oneColour = byHeight ? ONE_COLOUR : "";
    this.field = h("select", { "aria-label": `Field that colours ${this.topic}` }, ...Object.entries(choices).map(([value, words]) => h("option", { value }, words)));
    this.#offer([this.options.field]);
    this.field.value = this.options.field;
    color.hidden = this.options.field !== oneColour;
    this.field.addEventListener("change", () => {
      color.hidden = this.field.value !== oneColour;
      this.#set({ field: this.field.value });
    });
    const decay = numberField({ min: 0, max: 60, step: 1, unit: "s", value: this.options.decay, "aria-label": `Decay of ${this.topic} [s]`, title: "Points are kept for this time" });
    decay.addEventListener("change", () => this.#set({ decay: decay.valueAsNumber }));
    return [color, size, this.field, h("label.inline", {}, "decay ", decay, h("span.unit", {}, "s"))];
  }

  #offer(fields) {
    const present = new Set([...this.field.options].map(({ value }) => value));
    this.field.append(...fields.filter((name) => !present.has(name)).map((name) => h("option", { value: name }, name)));
  }

  #set(options) {
    const on = this.options.on;
    if (on && "field" in options) this.#subscribe(false);
    Object.assign(this.options, options);
    if (on && "field" in options) this.#subscribe(true);
    this.redraw();
    this.page.emit("displays", null);
  }

  /** Draw the last message again, in the colours of the theme and with the options. */
  redraw() {
    const last = this.drawn.at(-1);
    if (last) this.#show(last.time, last.content);
  }

  turn(on) {
    if (on === this.options.on) return;
    this.options.on = this.box.checked = on;
    this.more.hidden = !on;
    this.#subscribe(on);
    if (!on) this.clear();
    this.page.emit("displays", null);
  }

  #subscribe(on) {
    this.page.connection.subscribe(this.key, on);
  }

  /** Show the last message that waits. */
  release() {
    if (this.late) this.take(this.late);
  }

  take(message) {
    const { poses, fault, time } = message;
    const groups = poses && this.late ? this.late.groups.map((group, i) => ({ ...group, pose: poses[i] })) : message.groups;
    this.late = null;
    if (groups && this.page.interactive.holds(this, groups)) return (this.late = { ...message, groups, poses: null });
    this.fault.hidden = !fault;
    this.fault.textContent = fault ?? "";
    const last = this.drawn.at(-1);
    if (!groups && last?.content.length === poses.length) {
      last.content.forEach((group, i) => (group.pose = poses[i]));
      last.groups.forEach((group, i) => place(group, poses[i]));
      this.page.viewport.dirty();
    } else if (groups) {
      this.#decoded(time, groups);
    }
  }

  // The last map stays until the next one is decoded: without one in between, a map that is published often would blink.
  #decoded(time, groups) {
    const maps = groups.flatMap(({ items }) => items.filter((item) => "map" in item));
    if (!maps.length) return this.#show(time, groups);
    const number = ++this.arrived;
    const ready = () => number > this.newest && ((this.newest = number), this.#show(time, groups));
    decode(maps).then(ready, (error) => console.warn(`${this.topic}: ${error.message}`));
  }

  #show(time, content) {
    const { decay } = this.options;
    while (this.drawn.length && (decay <= 0 || this.drawn.length >= MOST || this.drawn[0].time < time - decay || this.drawn.at(-1).time >= time)) this.#drop();
    const root = new THREE.Group();
    const byHeight = this.controls.includes("height");
    const options = { ...this.options, byHeight, changed: () => this.page.viewport.dirty(), mesh: (name) => this.page.scene.mesh(name) };
    const groups = content.map(({ pose, items }) => place(build(items, { ...options, pose }), pose));
    for (const group of groups) root.add(group);
    root.traverse((object) => (object.userData.display = this.topic));
    this.page.viewport.viewer.scene.add(root);
    this.drawn.push({ time, root, groups, content });
    if (content.length ? content[0].items[0]?.controls : this.handles.firstChild) this.page.emit("handles", this);
    const fields = content[0]?.items[0]?.fields;
    if (fields && this.field) this.#offer(fields);
    this.page.viewport.dirty();
  }

  #drop() {
    dispose(this.drawn.shift().root);
  }

  clear() {
    while (this.drawn.length) this.#drop();
    this.newest = this.arrived;
    this.late = null;
    this.fault.hidden = true;
    this.page.viewport.dirty();
  }

  remove() {
    if (this.options.on) this.#subscribe(false);
    this.clear();
    this.item.remove();
  }
}

function place(group, pose) {
  group.position.set(pose[0], pose[1], pose[2]);
  group.quaternion.set(pose[3], pose[4], pose[5], pose[6]);
  return group;
}
