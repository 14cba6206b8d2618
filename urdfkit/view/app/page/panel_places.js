// Where panels are: in a column at the side or at the left, in the strip below the view, or floating; and their sizes.

import { h, icon } from "./dom.js";

const PLACES = ["side", "below", "floating", "left"];
const ICONS = { side: "M4 5h16v14H4zM14 5v14", below: "M4 5h16v14H4zM4 14h16", floating: "M4 5h11v9H4zM9 10h11v9H9z", left: "M4 5h16v14H4zM10 5v14" };
const WORDS = { side: "at the side", below: "below the view", floating: "floating", left: "at the left" };
const STEP = 16; // px per arrow key
const LIMITS = { width: [240, 0.6], left: [240, 0.6], height: [120, 0.6] }; // least px, and largest part of the window
const INITIAL = { width: 344, left: 344, height: 224 }; // px, as in the style sheet
const SMALLEST = 96; // px of a panel next to others
const FLOATING = [336, 384]; // px
const START = 6; // px that the pointer moves before a panel does
const DOCK = 48; // px from an edge of the view within which a panel is docked

export class PanelPlaces {
  constructor(panels) {
    this.panels = panels;
    this.sizes = {};
    const viewport = document.getElementById("viewport");
    const strip = h("div", { id: "strip", "data-closed": "", role: "region", "aria-label": "Panels below the view" });
    const left = h("aside", { id: "left", "data-closed": "", "aria-label": "Panels at the left" });
    this.target = h("div", { id: "dock-target", hidden: true });
    this.stage = h("div", { id: "stage" });
    viewport.before(left, this.stage);
    this.stage.append(viewport, strip, this.target);
    this.hosts = { side: panels.host, below: strip, left, floating: this.stage };
    this.docks = Object.entries(this.hosts).slice(0, 3); // hidden without an open panel
    panels.host.before(this.#divider("width", "vertical", "Width of the panels", () => panels.host.offsetWidth, -1));
    left.after(this.#divider("left", "vertical", "Width of the panels at the left", () => left.offsetWidth, 1));
    strip.before(this.#divider("height", "horizontal", "Height of the panels below the view", () => strip.offsetHeight, -1));
  }

  /** Give a panel the button that changes its place, and the edge that changes its size. */
  equip(panel) {
    const button = h("button.bare.place-button", { type: "button" });
    button.addEventListener("click", () => this.put(panel, this.#next(panel), true));
    panel.placeButton = button;
    panel.pin.before(button);
    panel.edge = h("div.edge", { role: "separator", tabindex: "0", "aria-valuenow": 0, title: "Drag to resize; a double click restores the size" });
    this.#resizes(panel.edge, {
      isVertical: () => panel.place === "below",
      sized: () => panel.section[panel.place === "below" ? "offsetWidth" : "offsetHeight"],
      kept: () => panel.size,
      set: (value) => this.#size(panel, value),
    });
    panel.edge.addEventListener("dblclick", () => (this.#size(panel, null), this.panels.changed()));
    panel.section.append(panel.edge);
    panel.section.addEventListener("pointerup", () => panel.place === "floating" && this.panels.changed()); // resized by its corner
    const head = panel.section.querySelector(".panel-head");
    head.addEventListener("pointerdown", (event) => this.#drag(panel, event));
    head.addEventListener("keydown", (event) => event.target === button && panel.place === "floating" && this.#keys(panel, event));
    this.#show(panel);
  }

  #next({ place }) {
    return PLACES[(PLACES.indexOf(place) + 1) % PLACES.length];
  }

  /** Put a panel at a place. @param chosen whether the user did it @param at position of a floating panel, and its size */
  put(panel, place, chosen = false, at = null) {
    panel.place = PLACES.includes(place) ? place : "side";
    panel.section.removeAttribute("style");
    this.hosts[panel.place].append(panel.section);
    this.panels.sort();
    this.#size(panel, null);
    const isFloating = panel.place === "floating";
    panel.section.classList.toggle("floating", isFloating);
    if (isFloating) this.#move(panel, ...(at ?? [Math.max(0, this.stage.clientWidth - FLOATING[0] - 44), 60]));
    if (isFloating && at?.length === 4) Object.assign(panel.section.style, { width: `${at[2]}px`, height: `${at[3]}px` });
    this.#show(panel);
    if (chosen) {
      this.panels.chosen = true;
      this.panels.refresh();
      panel.placeButton.focus();
    }
  }

  #show(panel) {
    const next = this.#next(panel);
    panel.placeButton.replaceChildren(icon(ICONS[next]));
    panel.placeButton.title = `Put ${WORDS[next]}${panel.place === "floating" ? "; the arrow keys move it" : ""}`;
    panel.placeButton.setAttribute("aria-label", `Put ${panel.title} ${WORDS[next]}`);
    panel.edge.hidden = panel.place === "floating";
    panel.edge.setAttribute("aria-orientation", panel.place === "below" ? "vertical" : "horizontal");
    panel.edge.setAttribute("aria-label", `${panel.place === "below" ? "Width" : "Height"} of ${panel.title}`);
  }

  // The size of a panel next to others [px], or null for that of its content.
  #size(panel, value) {
    panel.size = value && Math.round(Math.max(SMALLEST, value));
    panel.section.toggleAttribute("data-sized", panel.size !== null);
    panel.section.style.setProperty("--size", `${panel.size}px`);
    panel.edge.setAttribute("aria-valuenow", panel.size ?? 0);
  }

  #move(panel, x, y) {
    const most = [this.stage.clientWidth - 80, this.stage.clientHeight - 40];
    panel.at = [x, y].map((value, i) => Math.max(0, Math.min(most[i], value)));
    Object.assign(panel.section.style, { left: `${panel.at[0]}px`, top: `${panel.at[1]}px` });
  }

  // Drag a panel by its head: to a column or the strip, where it is docked, or over the view, where it floats.
  #drag(panel, event) {
    if (event.button !== 0 || this.panels.narrow.matches || event.target.closest("button, input, select, a")) return;
    const isFloating = panel.place === "floating";
    event.preventDefault();
    const box = panel.section.getBoundingClientRect();
    const grip = [event.clientX - box.left, event.clientY - box.top].map((value, i) => (isFloating ? value : Math.min(value, FLOATING[i] - DOCK)));
    const before = panel.at;
    let place = null;
    this.#follow(event, (move) => {
      if (place === null && Math.hypot(move.clientX - event.clientX, move.clientY - event.clientY) < START) return;
      const view = this.stage.getBoundingClientRect();
      const at = [move.clientX - grip[0] - view.left, move.clientY - grip[1] - view.top];
      place = this.#under(move.clientX, move.clientY);
      if (isFloating) this.#move(panel, ...at);
      this.#outline(place, at, isFloating);
      return at;
    }, (at, last) => {
      this.target.hidden = true;
      if (place === null) return;
      if (place !== "floating") this.#sort(panel, place, last.clientY);
      if (place !== panel.place) this.put(panel, place, true, at);
      else this.panels.sort();
    }, () => {
      this.target.hidden = true;
      if (isFloating) this.#move(panel, ...before);
    });
  }

  // The place under the pointer.
  #under(x, y) {
    const view = this.stage.getBoundingClientRect();
    if (x > view.right - DOCK) return "side";
    if (x < view.left + DOCK) return "left";
    return y > Math.min(view.bottom - DOCK, this.hosts.below.hasAttribute("data-closed") ? Infinity : this.hosts.below.getBoundingClientRect().top) ? "below" : "floating";
  }

  // Outline where a panel will be.
  #outline(place, at, isFloating) {
    const [view, main] = [this.stage, this.stage.parentElement].map((each) => each.getBoundingClientRect());
    const size = (name, otherwise) => (this.hosts[name].hasAttribute("data-closed") ? otherwise : name === "below" ? this.hosts[name].offsetHeight : this.hosts[name].offsetWidth);
    const wide = { side: size("side", 0), left: size("left", 0) };
    const [left, top, width, height] = {
      side: [wide.side ? view.right : view.right - FLOATING[0], main.top, wide.side || FLOATING[0], main.height],
      left: [main.left, main.top, wide.left || FLOATING[0], main.height],
      below: [view.left, view.bottom - size("below", 224), view.width, size("below", 224)],
      floating: [at[0] + view.left, at[1] + view.top, ...FLOATING],
    }[place];
    Object.assign(this.target.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
    this.target.hidden = isFloating && place === "floating";
  }

  // Give a panel its position in a column: before the first panel whose middle is below the pointer.
  #sort(panel, place, y) {
    const others = [...this.panels.all.values()].filter((each) => each !== panel && each.open && each.place === place).sort((a, b) => a.order - b.order);
    const next = others.findIndex(({ section }) => section.getBoundingClientRect().top + section.offsetHeight / 2 > y);
    if (place === "below" || !others.length) return;
    if (next < 0) panel.order = Math.max(panel.order, others.at(-1).order + 0.5);
    else panel.order = next ? (others[next - 1].order + others[next].order) / 2 : Math.min(panel.order, others[0].order - 0.5);
  }

  // Call `moved` while the pointer is down, and `done` with its last result and the last event; or `cancelled` on Escape, and
  // where the browser ends a touch.
  #follow(event, moved, done, cancelled) {
    let result = null;
    let last = event;
    const go = (move) => move.pointerId === event.pointerId && ((last = move), (result = moved(move) ?? result));
    const end = (up) => {
      if (up.pointerId !== event.pointerId) return;
      stop();
      if (up.type === "pointercancel") return cancelled();
      done(result, last);
      this.panels.changed();
    };
    const cancel = (press) => {
      if (press.key !== "Escape") return;
      press.preventDefault();
      press.stopPropagation();
      stop();
      cancelled();
    };
    const stop = () => {
      removeEventListener("pointermove", go);
      for (const each of ["pointerup", "pointercancel"]) removeEventListener(each, end);
      removeEventListener("keydown", cancel, true);
    };
    addEventListener("keydown", cancel, true);
    addEventListener("pointermove", go);
    for (const each of ["pointerup", "pointercancel"]) addEventListener(each, end);
  }

  #keys(panel, event) {
    const by = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.#move(panel, panel.at[0] + by[0], panel.at[1] + by[1]);
    this.panels.changed();
  }

  // A line between two parts of the page.
  #divider(name, orientation, words, sized, sign) {
    const line = h("div.divider", { role: "separator", tabindex: "0", "aria-orientation": orientation, "aria-label": words, "aria-valuemin": LIMITS[name][0], "aria-valuenow": INITIAL[name], "data-divides": name });
    this.#resizes(line, { isVertical: () => orientation === "vertical", sized, kept: () => this.sizes[name] ?? null, set: (value) => this.size(name, value), sign });
    this[name] = line;
    return line;
  }

  // Drag a line, or move it by the arrow keys. @param kept size that the user chose, or null @param sign 1 if the part grows
  // to the right or downwards
  #resizes(line, { isVertical, sized, kept, set, sign = 1 }) {
    line.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      const along = isVertical() ? "clientX" : "clientY";
      const [start, size, before] = [event[along], sized(), kept()];
      this.#follow(event, (move) => set(size + sign * (move[along] - start)), () => {}, () => set(before));
    });
    line.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -STEP, ArrowUp: -STEP, ArrowRight: STEP, ArrowDown: STEP }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      set(sized() + sign * by);
      this.panels.changed();
    });
  }

  /** Set the width of a column or the height of the strip [px], or null for the initial one. */
  size(name, value) {
    const { style } = document.documentElement;
    if (value === null) {
      delete this.sizes[name];
      style.removeProperty(`--panel-${name}`);
      return this[name].setAttribute("aria-valuenow", INITIAL[name]);
    }
    const [least, part] = LIMITS[name];
    const kept = Math.round(Math.max(least, Math.min(value, part * (name === "height" ? innerHeight : innerWidth))));
    this.sizes[name] = kept;
    style.setProperty(`--panel-${name}`, `${kept}px`);
    this[name].setAttribute("aria-valuenow", kept);
  }

  /** Places and sizes, for a layout. */
  get state() {
    const places = {};
    for (const { id, place, at, size, order, ordered, section } of this.panels.all.values()) {
      if (place === "side" && size === null && order === ordered) continue;
      const floating = place === "floating" && { at: [...at, ...(section.style.height ? [parseInt(section.style.width, 10), parseInt(section.style.height, 10)] : [])] };
      places[id] = { place, ...(size !== null && { size }), ...(order !== ordered && { order }), ...floating };
    }
    return { places, sizes: this.sizes };
  }

  restore({ places = {}, sizes = {} }) {
    for (const panel of this.panels.all.values()) {
      const { place, at, size = null, order = panel.ordered } = places[panel.id] ?? { place: "side" };
      panel.order = order;
      if (place !== panel.place || at) this.put(panel, place, false, at);
      if (size !== panel.size) this.#size(panel, size);
    }
    this.panels.sort();
    for (const [name, value] of Object.entries(sizes)) if (name in LIMITS) this.size(name, value);
  }
}
