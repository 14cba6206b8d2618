// The panels at the sides (on a phone: the sheet at the bottom) and the rail of buttons that open them.

import { h, icon } from "./dom.js";
import { PanelPlaces } from "./panel_places.js";

const PIN = "M9 3h6l-1 6 4 4v2H6v-2l4-4zM12 15v6";
const SETTLE = 5000; // ms within which an opened panel receives its content
const CLOSE = "M6 6l12 12M18 6L6 18";

/** One panel. Its content goes into `body`; `badge` shows a count on the rail. */
class Panel {
  constructor(panels, { id, title, icon: path, modes, order, element, pinned }) {
    Object.assign(this, { id, title, modes, order, ordered: order, pinned, available: true, place: "side", size: null });
    this.count = h("span.count", { hidden: true });
    this.button = h(
      "button.rail-button",
      { type: "button", id: `open-${id}`, title, "aria-expanded": "false", "aria-controls": `panel-${id}` },
      path ? icon(path) : null,
      h("span", {}, title),
      this.count,
    );
    this.button.addEventListener("click", () => panels.toggle(id));
    this.pin = h("button.bare.pin", { type: "button", "aria-pressed": String(pinned), title: "Keep open when another panel opens" }, icon(PIN));
    this.pin.setAttribute("aria-label", `Keep ${title} open`);
    this.pin.addEventListener("click", () => {
      this.pinned = !this.pinned;
      panels.chosen = true;
      panels.changed();
      this.pin.setAttribute("aria-pressed", this.pinned);
    });
    const close = h("button.bare", { type: "button", "aria-label": `Close ${title}`, title: "Close" }, icon(CLOSE));
    close.addEventListener("click", () => panels.close(id, true));
    this.tools = h("div.panel-tools");
    this.body = element ?? h("div");
    this.body.classList.add("panel-body");
    this.body.hidden = false;
    const head = h("div.panel-head", {}, h("h2", { id: `title-${id}` }, title), this.tools, this.pin, close);
    this.section = h("section.panel", { id: `panel-${id}`, "aria-labelledby": `title-${id}`, hidden: true }, head, this.body);
  }

  get open() {
    return !this.section.hidden;
  }

  /** Show a count on the rail, or hide it (null); `tone` is error, warning, note or empty. */
  badge(text, tone = "") {
    this.count.hidden = text === null || text === "";
    this.count.textContent = text ?? "";
    this.count.dataset.tone = tone;
  }
}

export class Panels {
  /** @param host container of the panels; @param rail container of the buttons */
  constructor(host, rail) {
    this.host = host;
    this.rail = rail;
    this.all = new Map();
    this.mode = null;
    this.wanted = [];
    this.changed = () => {}; // called when panels were opened, closed or pinned
    this.chosen = false; // whether the user has opened or closed a panel
    this.arranged = false; // whether a layout has, so that pinned panels without content at first stay closed
    this.places = new PanelPlaces(this);
    this.narrow = matchMedia("(max-width: 760px)");
  }

  /**
   * Add a panel.
   * @param id unique name; @param title label; @param icon the `d` of a 24 × 24 line drawing
   * @param modes modes in which it is available: ["view"], ["sim"] or both; @param order position on the rail, ascending
   * @param element its body; a new element if null
   * @param pinned whether it initially stays open when another panel opens
   * @returns the panel: {body, tools, badge(text, tone), open}
   */
  add({ id, title, icon = null, modes = ["view", "sim"], order = 50, element = null, pinned = false }) {
    const panel = new Panel(this, { id, title, icon, modes, order, element, pinned });
    const after = [...this.all.values()].filter((other) => other.order > order).sort((a, b) => a.order - b.order)[0];
    this.host.insertBefore(panel.section, after?.section.parentElement === this.host ? after.section : null);
    this.rail.insertBefore(panel.button, after?.button ?? null);
    this.all.set(id, panel);
    this.#offer(panel);
    this.places.equip(panel);
    return panel;
  }

  /** Put the panels of each place into their order. */
  sort() {
    for (const [name, host] of Object.entries(this.places.hosts)) {
      const here = [...this.all.values()].filter(({ place }) => place === name).sort((a, b) => a.order - b.order);
      host.append(...here.map(({ section }) => section));
    }
  }

  /** Show the panels of a mode; open the first one and the pinned ones if there is enough space. */
  use(mode) {
    if (this.mode === mode) return;
    this.mode = mode;
    for (const panel of this.all.values()) this.#offer(panel);
    this.#settle();
  }

  // Until the user opens or closes a panel, the first available one and the pinned ones are open.
  #settle() {
    if (this.mode !== null && !this.narrow.matches && !this.chosen) {
      const offered = [...this.all.values()].filter((panel) => this.#offered(panel)).sort((a, b) => a.order - b.order);
      offered.forEach((panel, i) => this.#show(panel, i === 0 || panel.pinned));
    }
    this.#changed();
  }

  /** Set whether a panel has content; a panel without content is not on the rail. */
  available(id, is) {
    const panel = this.all.get(id);
    const came = is && !panel.available;
    panel.available = is;
    this.#offer(panel);
    if (came && this.wanted.includes(id) && this.#offered(panel) && !this.narrow.matches) this.#show(panel, true);
    if (came && panel.pinned && !this.arranged && this.#offered(panel) && !this.narrow.matches) this.#show(panel, true);
    this.#settle();
  }

  toggle(id) {
    if (this.all.get(id).open) this.close(id);
    else this.open(id);
  }

  /** Open a panel; others in the column close unless they are pinned (on a phone only one is open). */
  open(id) {
    const opened = this.all.get(id);
    if (!this.#offered(opened)) return;
    this.chosen = true;
    this.wanted = [];
    for (const panel of this.all.values()) this.#show(panel, panel === opened || (panel.open && !this.narrow.matches && (panel.pinned || panel.place !== "side" || opened.place !== "side")));
    this.#changed();
    if (opened.place === "side" || opened.place === "left") this.#scrollTo(opened.section);
  }

  // Scroll a panel that does not fit to the top of the column; content that arrives later may move it, so repeat this for a while.
  #scrollTo(section) {
    const host = section.parentElement;
    this.scrolled = { section, from: host.scrollTop };
    const show = () => {
      const [inner, outer] = [section, host].map((element) => element.getBoundingClientRect());
      if (inner.top < outer.top || inner.bottom > outer.bottom) host.scrollTop += inner.top - outer.top;
    };
    show();
    this.watching?.disconnect();
    const watching = (this.watching = new ResizeObserver(show));
    for (const child of host.children) watching.observe(child);
    for (const event of ["pointerdown", "wheel", "keydown", "touchstart"]) {
      host.addEventListener(event, () => watching.disconnect(), { once: true, passive: true });
    }
    setTimeout(() => watching.disconnect(), SETTLE);
  }

  /** Open exactly these panels, as far as they are available. @param layout {open, pinned}, lists of names */
  arrange({ open, pinned, ...places }) {
    this.chosen = this.arranged = true;
    this.places.restore(places);
    for (const panel of this.all.values()) {
      panel.pinned = pinned.includes(panel.id);
      panel.pin.setAttribute("aria-pressed", panel.pinned);
      this.#show(panel, this.#offered(panel) && open.includes(panel.id) && (!this.narrow.matches || panel.id === open[0]));
    }
    this.wanted = open; // opened when they become available
    this.#changed();
  }

  close(id, back = false) {
    const panel = this.all.get(id);
    this.chosen = true;
    this.#show(panel, false);
    this.#changed();
    if (back) panel.button.focus();
  }

  #offered(panel) {
    return panel.available && (this.mode === null || panel.modes.includes(this.mode));
  }

  #offer(panel) {
    const offered = this.#offered(panel);
    panel.button.hidden = !offered;
    if (!offered) this.#show(panel, false);
  }

  #show(panel, shown) {
    panel.section.hidden = !shown;
    if (!shown && this.scrolled?.section === panel.section) {
      this.watching.disconnect();
      panel.section.parentElement.scrollTop = this.scrolled.from; // the panels above it are where they were
      this.scrolled = null;
    }
    panel.button.setAttribute("aria-expanded", shown);
  }

  /** Show columns and strip while they have an open panel. */
  refresh() {
    this.#changed();
  }

  #changed() {
    this.changed();
    const open = [...this.all.values()].filter((panel) => panel.open);
    for (const [name, host] of this.places.docks) host.toggleAttribute("data-closed", !open.some(({ place }) => place === name));
  }
}
