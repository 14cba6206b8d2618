// The panel of plots: numbers of topics over time.

import { h, icon } from "../page/dom.js";
import { COLOURS, Curve, Plot } from "./plot.js";

const CURVE = "M3 20h18M4 16c3 0 4-9 7-9s3 6 5 6 3-5 5-5";
const PAUSE = "M8 5v14M16 5v14";
const PLAY = "M8 5l11 7-11 7z";
const CLEAR = "M5 7h14M9 7V4h6v3M7 7l1 13h8l1-13";

export class Plots {
  constructor(page) {
    this.page = page;
    this.curves = new Map(); // key → {curve, item}
    this.panel = page.panels.add({ id: "plots", title: "Plots", icon: CURVE, modes: ["sim"], order: 26 });
    this.canvas = h("canvas.plot", { id: "plot", tabindex: 0, role: "application", "aria-label": "Plot; plus and minus zoom in time, up and down in value, left and right pan, Home follows the time" });
    this.legend = h("ul.bare-list.legend");
    this.hint = h("p.quiet", {}, "Choose a topic, open “Plot a number” and click one. Wheel or pinch: zoom in time (over the scale at the left: in value). Drag: pan. Double click: follow the time.");
    this.plot = new Plot(this.canvas);
    this.plot.changed = () => this.#buttons();
    this.hold = h("button.bare", { type: "button", id: "plot-pause", onclick: () => this.plot.pause(!this.plot.paused) });
    this.clear = h("button.bare", { type: "button", title: "Delete the samples", "aria-label": "Clear", onclick: () => this.empty() }, icon(CLEAR));
    this.panel.tools.append(this.hold, this.clear);
    const path = h("input", { id: "plot-path", placeholder: "/odom:twist.twist.linear.x", "aria-label": "Topic and field to plot", autocomplete: "off", spellcheck: "false" });
    const form = h("form.row", { id: "plot-form" }, path, h("button", { type: "submit" }, "Plot"));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const [topic, field] = path.value.split(":");
      if (!topic || !field) return page.toast("enter topic, colon and field, such as /odom:twist.twist.linear.x", "error");
      this.add(topic.trim(), field.trim());
      path.value = "";
    });
    this.panel.body.append(this.canvas, this.legend, form, this.hint);
    page.on("samples", (message) => this.#take(message));
    page.on("theme", () => this.plot.dirty());
    this.#buttons();
  }

  /** Plot a number of a topic. */
  add(topic, path) {
    const key = `field:${topic}:${path}`;
    if (!this.curves.has(key)) {
      const taken = this.plot.curves.map(({ colour }) => colour);
      const colour = COLOURS.find((each) => !taken.includes(each)) ?? COLOURS[taken.length % COLOURS.length];
      const curve = new Curve(`${topic} ${path}`, colour);
      const words = h("span.name", { title: curve.name }, `${topic}:${path}`.split(/(?<=[./:])/).flatMap((part) => [part, h("wbr")]));
      const value = h("span.value");
      const away = h("button.bare", { type: "button", "aria-label": `Remove ${topic}:${path}`, title: "Remove" }, "×");
      const swatch = h("span.swatch", { "aria-hidden": "true" });
      swatch.style.background = curve.colour;
      away.addEventListener("click", () => this.remove(key));
      const item = h("li", { "data-curve": key }, swatch, words, value, away);
      this.curves.set(key, { curve, item, value });
      this.legend.append(item);
      this.plot.curves.push(curve);
      this.page.connection.subscribe(key, true);
    }
    this.hint.hidden = true;
    if (!this.panel.open) {
      if (!this.panel.pinned) this.panel.pin.click(); // keep it open with the topics
      this.page.panels.open("plots");
    }
    this.plot.dirty();
  }

  remove(key) {
    const { curve, item } = this.curves.get(key);
    this.curves.delete(key);
    this.plot.curves = this.plot.curves.filter((each) => each !== curve);
    item.remove();
    this.page.connection.subscribe(key, false);
    this.hint.hidden = this.curves.size > 0;
    this.plot.dirty();
  }

  empty() {
    for (const { curve } of this.curves.values()) curve.clear();
    this.plot.dirty();
  }

  #take({ curve: key, t, values, error }) {
    const found = this.curves.get(key);
    if (!found) return;
    if (error) {
      found.value.textContent = error;
      found.value.dataset.tone = "error";
      return;
    }
    found.curve.push(t, values);
    const last = values.at(-1);
    found.value.textContent = last === null || last === undefined ? "" : Math.abs(last) < 1e-6 * found.curve.greatest ? "0" : String(Number(last.toPrecision(4))); // integration and contacts leave numbers like 1e-9
    if (this.panel.open) this.plot.dirty();
  }

  #buttons() {
    const { paused } = this.plot;
    this.hold.replaceChildren(icon(paused ? PLAY : PAUSE));
    this.hold.title = paused ? "Follow the time" : "Hold the time window";
    this.hold.setAttribute("aria-label", this.hold.title);
    this.hold.setAttribute("aria-pressed", paused);
  }
}

export function plots(page) {
  page.plots = new Plots(page);
  page.expose("plots", page.plots);
}
