// The world: a library of models to insert; a list of objects to move, rotate and delete; walls; saving.
/* global MeshCat */

import { h, short } from "../page/dom.js";
import { Mover } from "../handles/object_gizmo.js";
import { redraw, refill } from "../page/edited_fields.js";
import { numberField, unitField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const WORLD = "M12 3l8 4.5v9L12 21l-8-4.5v-9zM12 12l8-4.5M12 12v9M12 12L4 7.5";
const PLACE = "M12 21s-6-6-6-11a6 6 0 0 1 12 0c0 5-6 11-6 11zM12 8a2 2 0 1 0 0 4a2 2 0 0 0 0-4z";
const FIELDS = ["x", "y", "z", "roll", "pitch", "yaw"];

export class Objects {
  constructor(page) {
    this.page = page;
    this.chosen = null; // the model that a click inserts
    this.picked = null; // the selected object
    this.objects = [];
    this.moves = 0; // requested so far
    this.panel = page.panels.add({ id: "world", title: "World", icon: WORLD, modes: ["sim"], order: 30 });
    this.filter = h("input", { type: "search", id: "library-filter", placeholder: "Filter the library", "aria-label": "Filter the library", autocomplete: "off" });
    this.filter.addEventListener("input", () => this.#library());
    this.library = h("div.library", { role: "listbox", "aria-label": "Library", onkeydown: (event) => this.#keys(event) });
    this.entries = new Map(); // name → its button, with a picture
    this.hint = h("p.quiet", {}, "Select a model, then click its position.");
    this.form = this.#typed();
    this.list = h("ul.bare-list.objects", { "aria-label": "In the world" });
    this.detail = h("section.object", { hidden: true });
    const save = h("button.wide", { type: "button", id: "save-world", onclick: () => this.#request("save", {}).then((done) => done && page.toast(`saved ${done.bytes} bytes`, "good")) }, "Save the world as SDF");
    this.panel.body.append(h("h3", {}, "Insert"), this.filter, this.library, this.hint, this.form, (this.extra = h("div")), h("h3", {}, "In the world"), this.list, this.detail, save);
    page.tools.tool({ id: "place", title: "Insert the selected model", icon: PLACE, modes: ["sim"], order: 60, take: (held) => held || this.#choose(null) });
    this.mover = new Mover(page, (pose) => this.#place(pose));
    page.on("objects", (message) => this.#take(message));
    page.on("select", (selected) => this.#select(selected));
    page.on("click3d", (hit) => page.tools.held === "place" && this.#insert(hit.point));
    page.shortcut({ key: "Delete", does: "delete the selected object", modes: ["sim"], group: "World", run: () => this.remove() });
  }

  /** The object a link belongs to, or null. */
  nameOf(link) {
    if (!link) return null;
    return link.startsWith("world/") ? link.slice(6).split("::")[0] : (this.objects.find(({ first }) => first)?.name ?? null);
  }

  #request(name, values) {
    return this.page.connection.request(name, values).catch((error) => this.page.toast(error.message, "error"));
  }

  #take(message) {
    Object.assign(this, { objects: message.objects, models: message.models, robots: message.robots });
    this.#library();
    const kind = ({ robot, static: still }) => (robot ? "robot" : still ? "static" : "movable");
    refill(
      this.list,
      this.objects.map((object) => {
        const button = h("button.topic", { type: "button" }, h("span.name", {}, object.name), h("span.rate.quiet", {}, kind(object)));
        button.addEventListener("click", () => this.pick(this.picked === object.name ? null : object.name));
        return h("li", { "data-object": object.name, "data-chosen": object.name === this.picked }, button);
      }),
    );
    if (this.picked && !this.objects.some(({ name }) => name === this.picked)) this.page.select(null);
  }

  #library() {
    const words = this.filter.value.toLowerCase();
    const rows = [];
    for (const [kind, names] of [["model", this.models], ["robot", this.robots]]) {
      for (const name of names ?? []) {
        const title = name.replaceAll("_", " ");
        if (!title.toLowerCase().includes(words)) continue;
        if (!this.entries.has(name)) this.entries.set(name, this.#entry(name, title, kind));
        rows.push(this.entries.get(name));
      }
    }
    for (const [name, entry] of this.entries) entry.setAttribute("aria-selected", name === this.chosen);
    const { children: shown } = this.library;
    if (rows.length !== shown.length || rows.some((entry, i) => entry !== shown[i])) this.library.replaceChildren(...rows);
    this.#reach(rows.find((entry) => entry === this.entries.get(this.chosen)) ?? rows.find(({ tabIndex }) => tabIndex === 0) ?? rows[0]);
  }

  // The tab key reaches one entry, and the arrow keys the others.
  #reach(entry) {
    for (const each of this.entries.values()) each.tabIndex = each === entry ? 0 : -1;
  }

  // Pictures are requested when they are scrolled into view.
  #entry(name, title, kind) {
    const picture = h("img", { src: `/app/library/${name}.webp`, alt: "", width: 64, height: 64, loading: "lazy", onerror: () => (picture.style.visibility = "hidden") });
    const choose = () => this.#choose(name === this.chosen ? null : name);
    return h("button.library-entry", { type: "button", role: "option", tabindex: -1, "data-kind": kind, title, onclick: choose }, picture, h("span", {}, title));
  }

  // The arrow keys go through the pictures.
  #keys(event) {
    const all = [...this.library.children];
    const columns = all.filter(({ offsetTop }) => offsetTop === all[0].offsetTop).length;
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns, Home: -all.length, End: all.length }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation(); // they would drive the robot
    const next = all[Math.min(all.length - 1, Math.max(0, all.indexOf(document.activeElement) + step))];
    this.#reach(next);
    next.focus();
  }

  #choose(name) {
    if (name === this.chosen) return;
    this.chosen = name;
    this.hint.textContent = name ? `Click the position of ${name.replaceAll("_", " ")}.` : "Select a model, then click its position.";
    if (name) this.page.tools.hold("place");
    else if (this.page.tools.held === "place") this.page.tools.hold(null);
    this.form.hidden = !name;
    this.#library();
  }

  /** Fields for the pose of the inserted model. */
  #typed() {
    const field = (name, unit, step) => {
      return unitField(name, { step, unit, value: "0", id: `insert-${name}`, "aria-label": `${name} of the inserted model [${unit}]` });
    };
    const [[x, atX], [y, atY], [yaw, turned]] = [field("x", "m", 0.1), field("y", "m", 0.1), field("yaw", "°", 5)];
    const insert = () => this.#insert([x.valueAsNumber, y.valueAsNumber, 0], (yaw.valueAsNumber * Math.PI) / 180);
    return h("div", { hidden: true }, h("div.pose", {}, atX, atY, turned), h("button.wide", { type: "button", id: "insert-typed", onclick: insert }, "Insert at this pose"));
  }

  async #insert([x, y, z], yaw = 0) {
    if (!this.chosen) return this.page.panels.open("world");
    const robot = this.robots.includes(this.chosen);
    const done = await this.#request("spawn", { model: this.chosen, pose: robot ? [x, y, 0, yaw] : [x, y, Math.max(0, z), yaw] });
    if (done) this.inserted(`inserted ${done.name}`, done);
  }

  /** Report an insertion, which can be undone. */
  inserted(words, done) {
    const { name } = done;
    this.page.done(words, done);
    this.page.history.add({ words, undo: () => this.page.connection.request("remove", { name }), redo: () => this.page.connection.request("restore", { name }) });
  }

  /** Insert a copy of the selected object next to it. */
  async duplicate() {
    const name = this.picked;
    const now = name && (await this.#request("get_pose", { name }));
    if (!now) return;
    const box = new THREE.Box3();
    for (const link of this.#links(name)) for (const group of this.page.scene.shapes(link)) if (group.visible) box.expandByObject(group);
    const [x, ...rest] = now.pose;
    const done = await this.#request("duplicate", { name, pose: [x + (box.isEmpty() ? 0.5 : box.max.x - box.min.x + 0.1), ...rest] });
    if (done) this.inserted(`duplicated ${name} as ${done.name}`, done);
  }

  /** Select an object by name. */
  pick(name) {
    const object = this.objects.find((each) => each.name === name);
    if (!object) return this.page.select(null);
    const links = [...this.page.scene.byLink.keys()];
    const link = object.first ? links.find((each) => !each.startsWith("world/")) : links.find((each) => this.nameOf(each) === name && each.startsWith("world/"));
    if (link) this.page.select({ link });
  }

  async #select(selected) {
    const name = this.page.mode === "sim" ? this.nameOf(selected?.link) : null;
    if (name && name === this.picked && !this.detail.hidden) return; // emitted again after an insertion
    this.picked = name;
    for (const item of this.list.children) item.toggleAttribute("data-chosen", item.dataset.object === name);
    this.detail.hidden = true; // until the pose has arrived
    this.mover.drop();
    if (!name) return;
    const done = await this.#request("get_pose", { name });
    if (done && this.picked === name && this.detail.hidden) this.#show(name, done.pose);
  }

  #show(name, pose) {
    const object = this.objects.find((each) => each.name === name);
    const words = (i) => short(i > 2 ? (pose[i] * 180) / Math.PI : pose[i], 3);
    const inputs = FIELDS.map((field, i) => {
      const angle = i > 2;
      const input = numberField({ step: angle ? 5 : 0.1, value: words(i), "aria-label": `${field} of ${name} [${angle ? "°" : "m"}]` });
      input.addEventListener("change", () => {
        const values = inputs.map(({ valueAsNumber }, k) => valueAsNumber * (k > 2 ? Math.PI / 180 : 1));
        this.#place(values);
      });
      return input;
    });
    const grid = h("div.pose", {}, ...FIELDS.map((field, i) => h("label", {}, `${field} `, inputs[i], h("span.unit", {}, i > 2 ? "°" : "m"))));
    const away = h("button.danger", { type: "button", onclick: () => this.remove() }, "Delete");
    const twin = h("button", { type: "button", id: "duplicate-object", onclick: () => this.duplicate() }, "Duplicate");
    away.hidden = twin.hidden = Boolean(object?.first);
    const hold = h("button", { type: "button", id: "move-object", "aria-pressed": "false" }, "Move with mouse or arrows");
    hold.title = "Arrow keys: 5 cm; with Shift: up, down, turn by 5°";
    hold.addEventListener("click", () => {
      if (this.mover.held) this.mover.drop();
      else this.mover.take(this.#links(name), pose);
      hold.setAttribute("aria-pressed", this.mover.held);
    });
    this.moveTo = (now) => {
      pose = now;
      inputs.forEach((input, i) => redraw(input, () => (input.value = words(i))));
      if (!this.mover.held) return;
      this.mover.drop();
      this.mover.take(this.#links(name), pose);
    };
    this.detail.hidden = false;
    this.detail.replaceChildren(h("h3", {}, name), grid, h("div.row.wrap", {}, hold, twin, h("span.space"), away));
  }

  #links(name) {
    return [...this.page.scene.byLink.keys()].filter((link) => this.nameOf(link) === name);
  }

  async #place(pose) {
    const name = this.picked;
    const number = (this.moves += 1);
    const before = await this.#request("get_pose", { name });
    if (!before || !(await this.#request("place", { name, pose }))) return;
    const put = (where) => () => this.page.connection.request("place", { name, pose: where });
    this.page.history.add({ words: `moved ${name}`, undo: put(before.pose), redo: put(pose) });
    const now = await this.#request("get_pose", { name });
    if (!now || this.picked !== name || this.moves !== number || this.mover.moving) return; // a later move is on its way
    this.moveTo(now.pose);
  }

  /** Delete the selected object. */
  async remove() {
    if (!this.picked) return false;
    const name = this.picked;
    if (await this.#request("remove", { name })) {
      this.page.toast(`deleted ${name}`);
      this.page.history.add({ words: `deleted ${name}`, undo: () => this.page.connection.request("restore", { name }), redo: () => this.page.connection.request("remove", { name }) });
      this.page.select(null);
    }
    return true;
  }
}

export function objects(page) {
  page.objects = new Objects(page);
  page.expose("objects", page.objects);
}
