// The joint panel: a slider and a number for every joint, in radians or degrees, with or without limits.

import { check, fixed, h, short } from "../page/dom.js";
import { jointGroups } from "./robot_model.js";
import { redraw } from "../page/edited_fields.js";
import { numberField } from "../page/number_field.js";

const SLIDERS = "M4 7h9M17 7h3M15 5v4M4 17h3M11 17h9M9 15v4";
const DEGREES = 180 / Math.PI;
const BEYOND = { rad: 2 * Math.PI, m: 2, "": 1 }; // minimum range of the sliders if limits are ignored

export function joints(page) {
  const panel = page.panels.add({ id: "joints", title: "Joints", icon: SLIDERS, order: 12 });
  const made = new Joints(page, panel);
  page.on("model", (message) => {
    made.show(message.joints);
    page.panels.available("joints", message.joints.length > 0);
  });
  page.on("joints", (message) => made.update(message.positions));
  // The joints of a simulation move by themselves; while it is paused, the sliders pose the robot.
  page.on("hello", ({ mode }) => mode === "sim" && page.whileOpen(panel, "joints"));
  page.on("status", ({ paused }) => made.allow(paused && page.accepts("joints")));
  page.on("accepts", () => page.accepts("joints") || made.observe());
  page.on("select", (selected) => made.mark(selected));
  page.on("robot", () => made.group());
  page.setJoints = (values) => made.set(values);
  page.shortcut({ key: "0", does: "all joints to zero", group: "Joints", run: () => made.zero() });
  page.shortcut({ key: "5", does: "all joints to the middle of their range", group: "Joints", run: () => made.centre() });
  page.shortcut({ key: "r", does: "all joints to random positions in their range", group: "Joints", run: () => made.random() });
  page.expose("joints", made);
}

export class Joints {
  constructor(page, panel) {
    this.page = page;
    this.page.ignoreLimits = false;
    this.degrees = false;
    this.allowed = true;
    this.rows = new Map();
    this.headings = new Map(); // title of a group → its row
    this.collapsed = new Set(); // titles
    this.moved = {};
    this.before = null; // positions before the first move that is not sent yet
    this.list = h("ul#joints");
    this.filter = h("input#filter", { type: "search", placeholder: "Filter joints", "aria-label": "Filter joints", autocomplete: "off", spellcheck: "false" });
    this.filter.addEventListener("input", () => this.#filter());
    this.none = h("p.quiet", { hidden: true }, "No joint matches.");
    this.paused = h("p.quiet", { hidden: true }, "The joints move with the simulation. Pause it to pose the robot with the sliders.");
    const free = check("Ignore limits", { id: "ignore-limits", changed: (on) => this.#free(on) });
    const unit = h("select#angle-unit", { "aria-label": "Angles in" }, h("option", { value: "rad" }, "rad"), h("option", { value: "deg" }, "deg"));
    unit.addEventListener("change", () => this.#unit(unit.value === "deg"));
    const button = (words, title, run) => h("button", { type: "button", title, onclick: run }, words);
    const all = [
      button("Zero all", "Set every joint to zero, or to the limit nearest to it (0)", () => this.zero()),
      button("Centre", "Set every joint to the middle of its range (5)", () => this.centre()),
      button("Random", "Set every joint to a random position in its range (R)", () => this.random()),
    ];
    this.all = all;
    panel.body.append(this.paused, h("div.row.wrap.joint-all", {}, all), h("div.row.wrap", {}, free.label, h("span.space"), h("label.inline", {}, "Angles in ", unit)), this.filter, this.list, this.none);
  }

  /** Create the rows of a robot; the filter is kept, and rows of the same joints are. A model is sent for each change of the world. */
  show(joints) {
    const kinds = JSON.stringify(joints, (key, value) => (key === "position" ? undefined : value));
    if (kinds === this.kinds) return this.update(Object.fromEntries(joints.map(({ name, position }) => [name, position])));
    Object.assign(this, { kinds, groups: null });
    this.rows.clear();
    for (const joint of joints) this.#row(joint);
    this.filter.hidden = joints.length < 6;
    this.group();
    this.mark(this.page.selected);
  }

  /** Show the rows in groups. */
  group() {
    const groups = jointGroups([...this.rows.keys()], this.page.robot?.kinematics);
    if (JSON.stringify(groups) === this.groups) return;
    this.groups = JSON.stringify(groups);
    this.headings.clear();
    this.list.replaceChildren();
    for (const { title, names } of groups) {
      for (const name of names) this.rows.get(name).group = title;
      if (title) this.list.append(this.#heading(title, names.length));
      this.list.append(...names.map((name) => this.rows.get(name).item));
    }
    this.#filter();
  }

  #heading(title, count) {
    const fold = h("button.bare", { type: "button", onclick: () => this.#fold(title) }, `${title} (${count})`);
    const item = h("li.joint-group", {}, fold);
    this.headings.set(title, { item, fold });
    return item;
  }

  #fold(title) {
    if (!this.collapsed.delete(title)) this.collapsed.add(title);
    this.#filter();
  }

  /** Show positions from the server, except for a slider that the user is moving; a number that is typed is kept. */
  update(positions) {
    for (const [name, value] of Object.entries(positions)) {
      const row = this.rows.get(name);
      if (row && !row.held && !(name in this.moved)) this.#put(row, value, redraw);
    }
  }

  /** Enable or disable all that moves joints. */
  allow(allowed) {
    if (this.allowed === allowed) return;
    this.allowed = allowed;
    this.paused.hidden = allowed;
    for (const button of this.all) button.disabled = !allowed;
    for (const row of this.rows.values()) this.#enable(row);
  }

  /** Show the joints of a robot that is moved elsewhere. */
  observe() {
    this.paused.textContent = "The joints move with the robot. This page only shows them.";
    this.allow(false);
    for (const button of this.all) button.hidden = true;
    document.getElementById("ignore-limits").closest("label").hidden = true;
  }

  #enable({ number, slider, joint }) {
    number.disabled = slider.disabled = joint.mimic !== null || !this.allowed;
  }

  zero() {
    this.#all(({ joint }) => (joint.name.endsWith("/rot_w") ? 1 : 0));
  }

  centre() {
    this.#all(({ joint }) => (joint.limited ? (joint.lower + joint.upper) / 2 : joint.name.endsWith("/rot_w") ? 1 : 0));
  }

  random() {
    this.#all(({ joint }) => joint.lower + Math.random() * (joint.upper - joint.lower));
  }

  /** Set several joints [rad or m], like the sliders; `remembered`: the change can be undone. */
  set(values, remembered = true) {
    for (const [name, value] of Object.entries(values)) if (this.rows.has(name)) this.#move(name, value, remembered);
  }

  mark(selected) {
    for (const { item, joint } of this.rows.values()) item.toggleAttribute("data-selected", selected?.joint === joint.name || this.#above(selected?.link) === joint.name);
  }

  #above(link) {
    return this.page.robot?.kinematics.above.get(link)?.name ?? null;
  }

  #all(value) {
    for (const row of this.rows.values()) if (row.joint.mimic === null) this.#move(row.joint.name, value(row));
  }

  #row(joint) {
    const { name } = joint;
    const label = h("label", { title: name, for: `joint-${name}` }, name);
    const number = numberField();
    const unit = h("span.unit");
    const slider = h("input", { type: "range", step: "any", id: `joint-${name}` });
    const ends = h("div.joint-ends", {}, h("span"), h("span"));
    const item = h("li", {}, h("div.joint-head", {}, label, h("span.joint-value", {}, number, unit)), slider, ends);
    item.dataset.joint = name;
    item.toggleAttribute("data-mimic", joint.mimic !== null);
    const row = { joint, item, number, slider, unit, ends, held: false, value: joint.position };
    this.rows.set(name, row);
    this.#range(row);
    this.#put(row, joint.position);
    this.#enable(row);
    slider.addEventListener("pointerdown", () => (row.held = true));
    for (const end of ["pointerup", "pointercancel"]) slider.addEventListener(end, () => (row.held = false));
    slider.addEventListener("input", () => this.#move(name, slider.valueAsNumber));
    slider.addEventListener("dblclick", () => this.#move(name, 0));
    slider.addEventListener("keydown", (event) => this.#keys(event, row));
    number.addEventListener("change", () => this.#move(name, number.valueAsNumber / this.#factor(joint)));
    label.addEventListener("click", () => this.page.select({ joint: name.split("/")[0] }));
    return item;
  }

  #factor(joint) {
    return this.degrees && joint.unit === "rad" ? DEGREES : 1;
  }

  // The range of a slider and the text below it.
  #range(row) {
    const { joint } = row;
    const free = this.page.ignoreLimits;
    const reach = BEYOND[joint.unit];
    row.lower = free ? Math.min(joint.lower, -reach) : joint.lower;
    row.upper = free ? Math.max(joint.upper, reach) : joint.upper;
    const factor = this.#factor(joint);
    const unit = this.degrees && joint.unit === "rad" ? "deg" : joint.unit;
    Object.assign(row.slider, { min: row.lower, max: row.upper });
    row.unit.textContent = unit === "deg" ? "°" : unit;
    row.number.setAttribute("aria-label", unit ? `${joint.name} [${unit}]` : joint.name);
    const texts = joint.mimic ? [law(joint), ""] : joint.limited ? [short(joint.lower * factor), short(joint.upper * factor)] : ["no limit", ""];
    if (joint.limited && !joint.mimic && free) texts.splice(0, 2, `limits ${texts[0]} … ${texts[1]}`, "ignored");
    // The rounded limits below the slider are accepted as input.
    const typed = (end, outer) => (joint.limited && !free ? outer(end * factor, Number(short(end * factor))) : null);
    Object.assign(row.number.bounds, { min: typed(joint.lower, Math.min), max: typed(joint.upper, Math.max), unit: unit === "deg" ? "°" : unit });
    [...row.ends.children].forEach((end, i) => (end.textContent = texts[i]));
  }

  #unit(degrees) {
    this.degrees = degrees;
    for (const row of this.rows.values()) this.#range(row), this.#put(row, row.value);
  }

  #free(on) {
    this.page.ignoreLimits = on;
    for (const row of this.rows.values()) {
      this.#range(row);
      this.#put(row, row.value);
      // When limits apply again, the robot moves back within them.
      if (!on && row.joint.mimic === null && (row.value < row.lower || row.value > row.upper) && row.joint.limited) this.#move(row.joint.name, row.value);
    }
  }

  // A slider with step "any" moves by a hundredth of its range per arrow key, and by a tenth with shift.
  #keys(event, row) {
    const directions = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    this.#move(row.joint.name, row.slider.valueAsNumber + direction * (row.upper - row.lower) * (event.shiftKey ? 0.1 : 0.01));
  }

  get #positions() {
    return Object.fromEntries([...this.rows].filter(([, { joint }]) => joint.mimic === null).map(([name, { value }]) => [name, value]));
  }

  // All moves until a pause are one change.
  #remember(before, after) {
    const put = (values) => () => {
      if (!this.allowed) throw new Error("pause the simulation to pose the robot");
      this.set(values, false);
    };
    this.page.history.add({ words: "moved joints", key: "joints", undo: put(before), redo: put(after) });
  }

  // A typed value of a joint without limits may be beyond its slider.
  #move(name, value, remembered = true) {
    const row = this.rows.get(name);
    if (remembered) this.before ??= this.#positions;
    const bound = row.joint.limited && !this.page.ignoreLimits;
    const kept = bound ? Math.min(row.upper, Math.max(row.lower, value)) : value;
    this.#put(row, kept);
    if (Object.keys(this.moved).length === 0) requestAnimationFrame(() => this.#flush());
    this.moved[name] = kept;
  }

  #flush() {
    const moved = this.moved;
    this.moved = {};
    if (this.before) this.#remember(this.before, this.#positions);
    this.before = null;
    this.page.send("joints", { positions: moved });
  }

  #put(row, value, how = (_, draw) => draw()) {
    row.value = value;
    row.slider.value = value;
    const factor = this.#factor(row.joint);
    const shown = value * factor;
    how(row.number, () => (row.number.value = fixed(shown, factor === 1 ? 3 : 1)));
    const beyond = row.joint.limited && (value < row.joint.lower - 1e-9 || value > row.joint.upper + 1e-9);
    row.item.toggleAttribute("data-beyond", beyond);
    row.slider.setAttribute("aria-valuetext", `${short(shown)} ${row.unit.textContent}`);
  }

  #filter() {
    const wanted = this.filter.value.trim().toLowerCase();
    for (const [title, { item, fold }] of this.headings) {
      item.hidden = wanted !== "";
      fold.setAttribute("aria-expanded", !this.collapsed.has(title));
    }
    let found = 0;
    for (const [name, row] of this.rows) {
      const fits = name.toLowerCase().includes(wanted);
      row.item.hidden = !fits || (wanted === "" && this.collapsed.has(row.group));
      found += fits;
    }
    this.none.hidden = found > 0 || this.rows.size === 0;
  }
}

/** Description of the mimic relation of a joint. */
function law({ mimic, multiplier, offset }) {
  const factor = multiplier === 1 ? "" : `${short(multiplier)} × `;
  const more = offset === 0 ? "" : ` ${offset < 0 ? "−" : "+"} ${short(Math.abs(offset))}`;
  return `follows ${factor}${mimic}${more}`;
}
