// The toolbar of the viewport: buttons for single actions, and tools that stay active.

import { h, icon } from "./dom.js";

const FIT = "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5M9 9h6v6H9z";

// Distances of the first view of a simulation, relative to the fitted one. A robot that drives spans a third of the height, so
// that its driver sees two robot lengths ahead and to both sides.
const DRIVING = 2.6;
const STANDING = 1.2;

export class Tools {
  constructor(page, bar) {
    this.page = page;
    this.bar = bar;
    this.held = null;
    this.buttons = new Map();
  }

  /** Add a button for a single action. @param order position in the bar @returns the button */
  action({ id, title, icon: path, modes = ["view", "sim"], order = 50, run }) {
    const button = h("button.tool", { type: "button", id: `tool-${id}`, title, "aria-label": title, onclick: run }, icon(path));
    this.#put(button, order, modes);
    return button;
  }

  /** Add a tool; `take(held)` is called when it is activated or deactivated; with `clicks` it receives clicks (click3d). */
  tool({ id, title, icon: path, modes = ["view", "sim"], order = 50, clicks = true, take = () => {} }) {
    const button = this.action({ id, title, icon: path, modes, order, run: () => this.hold(this.held === id ? null : id) });
    button.setAttribute("aria-pressed", "false");
    this.buttons.set(id, { button, take, clicks });
    return button;
  }

  takesClicks(id) {
    return this.buttons.get(id)?.clicks ?? false;
  }

  /** Activate a tool, or deactivate the active one (null). */
  hold(id) {
    if (id === this.held) return;
    const [before, now] = [this.held, id];
    this.held = id;
    for (const [name, { button }] of this.buttons) button.setAttribute("aria-pressed", name === id);
    if (before) this.buttons.get(before).take(false);
    if (now) this.buttons.get(now).take(true);
    document.body.toggleAttribute("data-tool", now !== null);
    this.page.emit("tool", id);
  }

  #put(button, order, modes) {
    button.style.order = order;
    button.dataset.modes = modes.join(" ");
    this.bar.append(button);
    if (this.page.mode) this.offer();
  }

  offer() {
    for (const button of this.bar.children) button.hidden = !button.dataset.modes?.split(" ").includes(this.page.mode);
  }
}

export function tools(page) {
  page.tools = new Tools(page, document.getElementById("tools"));
  page.on("hello", () => page.tools.offer());
  /** Fit the view to the robot; `direction` null keeps the current direction of the camera. */
  page.fit = (direction) => {
    // In the simulation the camera is behind the robot, so that forward is away from the driver and left is left.
    const sim = page.mode === "sim";
    const room = sim ? (page.drives === false ? STANDING : DRIVING) : 1;
    const box = page.scene.bounds();
    const view = sim && !box.isEmpty() ? page.occlusion.clearDirection(box, [-1, -0.55, 0.75], page.viewport.distance(box, room)) : { direction: [1, 0.75, 0.6], part: 1 };
    const done = page.viewport.fit(box, direction === null ? null : view.direction, room * view.part);
    page.emit("fit", done);
    return done;
  };
  page.tools.action({ id: "fit", title: "Fit view", icon: FIT, order: 10, run: () => page.fit() });
  page.shortcut({ key: "f", does: "fit the view to the robot", group: "View", run: () => page.fit() && undefined });
}
