// The joint panel: a slider and a number for every joint.

import { h, short } from "./dom.js";

const SLIDERS = "M4 7h9M17 7h3M15 5v4M4 17h3M11 17h9M9 15v4";

export function joints(page) {
  const panel = page.panels.add({ id: "joints", title: "Joints", icon: SLIDERS, modes: ["view"], order: 10 });
  const made = new Joints(panel, (positions) => page.send("joints", { positions }));
  page.on("model", (message) => {
    made.show(message.joints);
    page.panels.available("joints", message.joints.length > 0);
  });
  page.on("joints", (message) => made.update(message.positions));
  page.expose("joints", made);
}

export class Joints {
  /** @param send called with {name: value} when a person moves something, at most once per picture */
  constructor(panel, send) {
    this.send = send;
    this.list = h("ul#joints");
    this.rows = new Map();
    this.moved = {};
    this.filter = h("input#filter", { type: "search", placeholder: "Filter joints", "aria-label": "Filter joints", autocomplete: "off", spellcheck: "false" });
    this.filter.addEventListener("input", () => this.#filter());
    this.none = h("p.quiet", { hidden: true }, "No joint of this name.");
    panel.tools.append(h("button", { type: "button", onclick: () => this.zero() }, "Zero all"));
    panel.body.append(this.filter, this.list, this.none);
  }

  /** Build the rows for a robot; the filter stays. */
  show(joints) {
    this.rows.clear();
    this.list.replaceChildren(...joints.map((joint) => this.#row(joint)));
    this.filter.hidden = joints.length < 6;
    this.#filter();
  }

  /** Values from Python; what a person is moving at this moment stays under their hand. */
  update(positions) {
    for (const [name, value] of Object.entries(positions)) {
      const row = this.rows.get(name);
      if (row && !row.held && !(name in this.moved)) this.#put(row, value);
    }
  }

  zero() {
    for (const [name, row] of this.rows) {
      if (row.joint.mimic === null) this.#move(name, 0);
    }
  }

  #row(joint) {
    const { name, lower, upper, unit } = joint;
    const item = document.createElement("li");
    item.dataset.joint = name;
    const head = document.createElement("div");
    head.className = "joint-head";
    const label = document.createElement("label");
    label.textContent = label.title = name;
    const number = document.createElement("input");
    Object.assign(number, { type: "number", step: unit === "m" ? "0.001" : "0.01", min: lower, max: upper });
    number.setAttribute("aria-label", `${name} [${unit}]`);
    const unitText = document.createElement("span");
    unitText.className = "unit";
    unitText.textContent = unit;
    const slider = document.createElement("input");
    Object.assign(slider, { type: "range", min: lower, max: upper, step: "any", id: `joint-${name}` });
    label.htmlFor = slider.id;
    const ends = document.createElement("div");
    ends.className = "joint-ends";
    const texts = joint.mimic ? [`follows ${joint.mimic}`, ""] : joint.limited ? [short(lower), short(upper)] : ["no limit", ""];
    ends.append(...texts.map((text) => Object.assign(document.createElement("span"), { textContent: text })));
    head.append(label, number, unitText);
    item.append(head, slider, ends);
    const row = { joint, item, number, slider, held: false };
    this.rows.set(name, row);
    this.#put(row, joint.position);
    number.disabled = slider.disabled = joint.mimic !== null;
    slider.addEventListener("pointerdown", () => (row.held = true));
    for (const end of ["pointerup", "pointercancel"]) slider.addEventListener(end, () => (row.held = false));
    slider.addEventListener("input", () => this.#move(name, slider.valueAsNumber));
    slider.addEventListener("dblclick", () => this.#move(name, 0));
    slider.addEventListener("keydown", (event) => this.#keys(event, row));
    number.addEventListener("change", () => Number.isFinite(number.valueAsNumber) && this.#move(name, number.valueAsNumber));
    return item;
  }

  // A slider with step "any" moves by a hundredth of its range per arrow key, and by a tenth with shift.
  #keys(event, row) {
    const directions = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    const { name, lower, upper } = row.joint;
    this.#move(name, row.slider.valueAsNumber + direction * (upper - lower) * (event.shiftKey ? 0.1 : 0.01));
  }

  #move(name, value) {
    const row = this.rows.get(name);
    const clamped = Math.min(row.joint.upper, Math.max(row.joint.lower, value));
    this.#put(row, clamped);
    if (Object.keys(this.moved).length === 0) requestAnimationFrame(() => this.#flush());
    this.moved[name] = clamped;
  }

  #flush() {
    const moved = this.moved;
    this.moved = {};
    this.send(moved);
  }

  #put(row, value) {
    row.slider.value = value;
    const text = value.toFixed(3);
    row.number.value = text === "-0.000" ? "0.000" : text;
    row.slider.setAttribute("aria-valuetext", `${short(value)} ${row.joint.unit}`);
  }

  #filter() {
    const wanted = this.filter.value.trim().toLowerCase();
    let found = 0;
    for (const [name, row] of this.rows) {
      const fits = name.toLowerCase().includes(wanted);
      row.item.hidden = !fits;
      found += fits;
    }
    this.none.hidden = found > 0 || this.rows.size === 0;
  }
}
