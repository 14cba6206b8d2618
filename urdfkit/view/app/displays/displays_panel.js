// The panel of displays: topics that are drawn in the 3-D view, and the tree of transforms with their ages.

import { h } from "../page/dom.js";
import { Display } from "./display.js";
import { transforms } from "./transform_tree.js";

const MONITOR = "M3 5h18v12H3zM9 21h6M12 17v4M6 14l4-4 3 2 5-5";

export class Displays {
  constructor(page) {
    this.page = page;
    this.types = new Map(); // type → names of its options
    this.all = new Map(); // topic → display
    this.saved = new Map(); // topic → options of a layout, until the topic exists
    this.panel = page.panels.add({ id: "displays", title: "Displays", icon: MONITOR, order: 22 });
    page.panels.available("displays", false);
    this.list = h("ul.bare-list.displays", { "aria-label": "Displays" });
    this.none = h("p.quiet", {}, "None of these topics can be displayed. Displays exist for maps, paths, poses, markers, scans, point clouds, ranges and wrenches.");
    this.panel.body.append(this.none, this.list, transforms(page));
    page.on("display_types", ({ types }) => {
      this.types = new Map(Object.entries(types));
      page.panels.available("displays", true);
    });
    page.on("topics", ({ rows }) => this.#take(rows));
    page.on("display", (message) => [...this.all.values()].find(({ key }) => key === message.source)?.take(message));
    page.on("theme", () => this.all.forEach((display) => display.redraw()));
    page.on("lost", () => this.all.forEach((display) => display.clear()));
    page.on("hello", () => page.whileOpen(this.panel, "topics"));
  }

  #take(rows) {
    for (const [topic, type] of rows) {
      if (!this.types.has(type) || this.all.has(topic)) continue;
      const display = new Display(this.page, { topic, type, controls: this.types.get(type) }, this.saved.get(topic));
      this.all.set(topic, display);
      this.list.append(display.item);
    }
    const names = new Set(rows.map(([topic]) => topic));
    for (const [topic, display] of this.all) if (!names.has(topic)) display.remove(), this.all.delete(topic);
    this.none.hidden = this.all.size > 0;
  }

  /** The options of all displays that are on, for a layout. */
  state() {
    const off = new Set([...this.all.values()].filter(({ options }) => !options.on).map(({ topic }) => topic));
    const waiting = [...this.saved].filter(([topic]) => !this.all.has(topic) && !off.has(topic)).map(([topic, options]) => ({ topic, ...options }));
    return [...[...this.all.values()].filter(({ options }) => options.on).map(({ topic, type, options }) => ({ topic, type, ...options })), ...waiting];
  }

  /** Show the displays of a layout; those of topics that do not exist yet appear with their topic. */
  restore(displays) {
    this.saved = new Map(displays.map(({ topic, type, ...options }) => [topic, { ...options, on: true }]));
    for (const display of this.all.values()) display.remove();
    this.all.clear();
    const present = displays.filter(({ type }) => this.types.has(type));
    this.#take(present.map(({ topic, type }) => [topic, type]));
  }
}

export function displays(page) {
  page.displays = new Displays(page);
  page.expose("displays", page.displays);
}
