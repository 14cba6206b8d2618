// Layouts: open panels, displays, layers and camera as a file, and as the last state of each robot in this browser.

import { h } from "./dom.js";

const KEY = "urdfkit-layout:";
const WAIT = 500; // ms without a change after which the state is stored

export class Layout {
  constructor(page) {
    this.page = page;
    this.timer = null;
    this.applied = null;
    const file = h("input", { type: "file", accept: ".json,application/json", id: "layout-file", "aria-label": "Layout file", hidden: true });
    file.addEventListener("change", () => file.files[0] && this.#read(file.files[0]).finally(() => (file.value = "")));
    const save = h("button", { type: "button", id: "save-layout", onclick: () => this.#download() }, "Save layout");
    const open = h("button", { type: "button", id: "open-layout", onclick: () => file.click() }, "Open layout …");
    const reset = h("button", { type: "button", id: "reset-layout", onclick: () => this.#forget() }, "Reset");
    page.viewPanel.body.append(h("h3", {}, "Layout"), h("div.row.wrap", {}, save, open, reset), file);
    page.on("model", () => this.#begin());
    for (const event of ["panels", "displays", "light"]) page.on(event, () => this.#later());
    addEventListener("change", (event) => event.target.closest?.("#panel-show") && this.#later());
    for (const event of ["pagehide", "visibilitychange"]) addEventListener(event, () => this.timer && this.#store());
  }

  /** The present layout as an object of JSON values. */
  get state() {
    const { panels, displays, viewport } = this.page;
    const { camera, controls } = viewport.viewer;
    const offered = [...panels.all.values()];
    return {
      version: 1,
      panels: { open: offered.filter(({ open }) => open).map(({ id }) => id), pinned: offered.filter(({ pinned }) => pinned).map(({ id }) => id), ...panels.places.state },
      displays: displays.state(),
      show: Object.fromEntries([...document.querySelectorAll("#panel-show input[type=checkbox]")].map(({ id, checked }) => [id, checked])),
      light: this.page.light.choice,
      camera: { position: camera.position.toArray(), target: controls.target.toArray() },
    };
  }

  /** Apply a layout; parts that it does not have stay. `whole`: with the camera. */
  apply(layout, whole = true) {
    if (layout?.version !== 1) throw new Error("this file is not a urdfkit layout (version 1)");
    const { panels, displays, viewport } = this.page;
    if (layout.panels) panels.arrange(layout.panels);
    if (layout.displays) displays.restore(layout.displays);
    for (const [id, checked] of Object.entries(layout.show ?? {})) {
      const box = document.getElementById(id);
      if (box?.type === "checkbox" && box.checked !== checked) box.click();
    }
    if (layout.light) this.page.light.choose(layout.light);
    if (!whole || !layout.camera || viewport.viewer.camera.isOrthographicCamera) return;
    viewport.viewer.camera.position.set(...layout.camera.position);
    viewport.viewer.controls.target.set(...layout.camera.target);
    viewport.dirty();
  }

  get #key() {
    return `${KEY}${this.page.mode}:${this.page.model.name}`;
  }

  // Once for each robot: the layout of the command, else the last one of this browser.
  #begin() {
    if (this.applied === this.#key) return;
    this.applied = this.#key;
    const given = this.page.settings.layout;
    const stored = given ?? storedAt(this.#key);
    if (!stored) return;
    try {
      if (given) this.page.on("fit", once(() => this.apply({ version: 1, camera: given.camera })));
      this.apply(stored, false);
    } catch (error) {
      this.page.toast(error.message, "error");
    }
  }

  #later() {
    clearTimeout(this.timer);
    if (this.page.model) this.timer = setTimeout(() => this.#store(), WAIT);
  }

  #store(text = JSON.stringify({ ...this.state, camera: undefined })) {
    clearTimeout(this.timer);
    this.timer = null;
    store(this.#key, text);
  }

  #forget() {
    this.#store(null);
    location.reload();
  }

  #download() {
    const name = this.page.model.name.replace(/[^\w.-]+/g, "_");
    const link = h("a", { download: `${name}.layout.json`, href: URL.createObjectURL(new Blob([`${JSON.stringify(this.state, null, 1)}\n`], { type: "application/json" })) });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  async #read(file) {
    try {
      this.apply(JSON.parse(await file.text()));
      this.page.toast(`opened ${file.name}`, "good");
    } catch (error) {
      this.page.toast(error instanceof SyntaxError ? `${file.name} is not JSON` : error.message, "error");
    }
  }
}

function once(run) {
  let done = false;
  return () => done || ((done = true), run());
}

// A browser may deny access to its storage.
function storedAt(key) {
  try {
    return JSON.parse(localStorage.getItem(key));
  } catch {
    return null;
  }
}

function store(key, text) {
  try {
    if (text === null) localStorage.removeItem(key);
    else localStorage.setItem(key, text);
  } catch {
    // the layout lasts until the page is closed
  }
}

export function layout(page) {
  page.layout = new Layout(page);
  page.expose("layout", page.layout);
}
