// Where panels are: in the column at the side, in the strip below the view, or floating; and the sizes of column and strip.

import { h, icon } from "./dom.js";

const PLACES = ["side", "below", "floating"];
const ICONS = { side: "M4 5h16v14H4zM14 5v14", below: "M4 5h16v14H4zM4 14h16", floating: "M4 5h11v9H4zM9 10h11v9H9z" };
const WORDS = { side: "at the side", below: "below the view", floating: "floating" };
const STEP = 16; // px per arrow key
const LIMITS = { width: [240, 0.6], height: [120, 0.6] }; // least px, and largest part of the window

export class PanelPlaces {
  constructor(panels) {
    this.panels = panels;
    this.sizes = {};
    this.strip = h("div", { id: "strip", "data-closed": "", role: "region", "aria-label": "Panels below the view" });
    document.getElementById("viewport").after(this.strip);
    const stage = h("div", { id: "stage" });
    this.strip.before(stage);
    stage.append(document.getElementById("viewport"), this.strip);
    this.stage = stage;
    panels.host.before(this.#divider("width", "vertical", "Width of the panels"));
    this.strip.before(this.#divider("height", "horizontal", "Height of the panels below the view"));
  }

  /** Give a panel the button that changes its place. */
  equip(panel) {
    const button = h("button.bare.place-button", { type: "button" });
    button.addEventListener("click", () => this.put(panel, PLACES[(PLACES.indexOf(panel.place) + 1) % PLACES.length], true));
    panel.placeButton = button;
    panel.pin.before(button);
    const head = panel.section.querySelector(".panel-head");
    head.addEventListener("pointerdown", (event) => this.#drag(panel, head, event));
    head.addEventListener("keydown", (event) => event.target === button && panel.place === "floating" && this.#keys(panel, event));
    this.#show(panel);
  }

  /** Put a panel at a place. @param chosen whether the user did it @param at position of a floating panel */
  put(panel, place, chosen = false, at = null) {
    panel.place = PLACES.includes(place) ? place : "side";
    const hosts = { side: this.panels.host, below: this.strip, floating: this.stage };
    hosts[panel.place].append(panel.section);
    if (panel.place === "side") this.panels.sort();
    panel.section.classList.toggle("floating", panel.place === "floating");
    if (panel.place === "floating") this.#move(panel, ...(at ?? [Math.max(0, this.stage.clientWidth - 380), 60]));
    else panel.section.removeAttribute("style");
    this.#show(panel);
    if (chosen) {
      this.panels.chosen = true;
      this.panels.refresh();
      panel.placeButton.focus();
    }
  }

  #show(panel) {
    const next = PLACES[(PLACES.indexOf(panel.place) + 1) % PLACES.length];
    panel.placeButton.replaceChildren(icon(ICONS[next]));
    panel.placeButton.title = `Put ${WORDS[next]}${panel.place === "floating" ? "; the arrow keys move it" : ""}`;
    panel.placeButton.setAttribute("aria-label", `Put ${panel.title} ${WORDS[next]}`);
  }

  #move(panel, x, y) {
    const most = [this.stage.clientWidth - 80, this.stage.clientHeight - 40];
    panel.at = [x, y].map((value, i) => Math.max(0, Math.min(most[i], value)));
    Object.assign(panel.section.style, { left: `${panel.at[0]}px`, top: `${panel.at[1]}px` });
  }

  #drag(panel, head, event) {
    if (panel.place !== "floating" || event.button !== 0 || event.target.closest("button, input, select")) return;
    event.preventDefault();
    const from = [event.clientX - panel.at[0], event.clientY - panel.at[1]];
    this.#follow(head, event, (move) => this.#move(panel, move.clientX - from[0], move.clientY - from[1]));
  }

  #follow(element, event, moved) {
    element.setPointerCapture(event.pointerId);
    element.addEventListener("pointermove", moved);
    element.addEventListener("lostpointercapture", () => (element.removeEventListener("pointermove", moved), this.panels.changed()), { once: true });
  }

  #keys(panel, event) {
    const by = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.#move(panel, panel.at[0] + by[0], panel.at[1] + by[1]);
    this.panels.changed();
  }

  // A line between two parts of the page that is dragged, or moved by the arrow keys.
  #divider(name, orientation, words) {
    const line = h("div.divider", { role: "separator", tabindex: "0", "aria-orientation": orientation, "aria-label": words, "aria-valuemin": LIMITS[name][0], "aria-valuenow": name === "width" ? 352 : 224, "data-divides": name });
    const sized = () => (name === "width" ? this.panels.host.offsetWidth : this.strip.offsetHeight);
    line.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      const [start, size] = [name === "width" ? event.clientX : event.clientY, sized()];
      this.#follow(line, event, (move) => this.size(name, size + start - (name === "width" ? move.clientX : move.clientY)));
    });
    line.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: STEP, ArrowUp: STEP, ArrowRight: -STEP, ArrowDown: -STEP }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.size(name, sized() + by);
      this.panels.changed();
    });
    this[name] = line;
    return line;
  }

  /** Set the width of the column or the height of the strip [px]. */
  size(name, value) {
    const [least, part] = LIMITS[name];
    const kept = Math.round(Math.max(least, Math.min(value, part * (name === "width" ? innerWidth : innerHeight))));
    this.sizes[name] = kept;
    document.documentElement.style.setProperty(`--panel-${name}`, `${kept}px`);
    this[name].setAttribute("aria-valuenow", kept);
  }

  /** Places and sizes, for a layout. */
  get state() {
    const moved = [...this.panels.all.values()].filter(({ place }) => place !== "side");
    return { places: Object.fromEntries(moved.map(({ id, place, at }) => [id, place === "floating" ? { place, at } : { place }])), sizes: this.sizes };
  }

  restore({ places = {}, sizes = {} }) {
    for (const panel of this.panels.all.values()) {
      const { place, at } = places[panel.id] ?? { place: "side" };
      if (place !== panel.place || at) this.put(panel, place, false, at);
    }
    for (const [name, value] of Object.entries(sizes)) if (name in LIMITS) this.size(name, value);
  }
}
