// Buttons that go through the solutions of inverse kinematics for the present pose of the dragged link.

import { h, icon } from "../page/dom.js";

const BACK = "M15 5l-7 7 7 7";
const ON = "M9 5l7 7-7 7";
const SAME = 1e-6; // [rad] or [m]: difference below which joint positions are those of a solution

export class SolutionChoice {
  /** @param page the page; @param find requests the solutions and calls back with {solutions, reached, reason} or null */
  constructor(page, find) {
    Object.assign(this, { page, find, found: [], at: 0 });
    this.count = h("span", { id: "ik-count", role: "status" });
    const step = (by, name, path) => h("button.bare", { type: "button", "aria-label": name, title: name, onclick: () => this.#go(this.at + by) }, icon(path));
    this.steps = h("span.ik-steps", { hidden: true }, step(-1, "Previous solution", BACK), this.count, step(1, "Next solution", ON));
    this.button = h("button", { type: "button", id: "ik-solutions", title: "other joint positions with the same pose of the link", onclick: () => this.#request() }, "Solutions");
    this.element = h("span", {}, this.button, this.steps);
    page.on("joints", ({ positions }) => this.found.length && !this.found.some((one) => Object.entries(one).every(([name, value]) => Math.abs(value - positions[name]) < SAME)) && this.clear());
  }

  clear() {
    this.found = [];
    this.steps.hidden = true;
    this.button.hidden = false;
  }

  #request() {
    this.find((answer, missing) => {
      if (!answer) return this.page.toast(missing ?? "the solver is not ready yet", "warning");
      if (!answer.reached) return this.page.toast(`no solution: ${answer.reason}`, "warning");
      this.found = answer.solutions;
      this.steps.hidden = false;
      this.button.hidden = true;
      this.#go(0);
    });
  }

  #go(index) {
    const { length } = this.found;
    this.at = (index + length) % length;
    this.count.textContent = `${this.at + 1} of ${length}`;
    this.page.setJoints(this.found[this.at]);
  }
}
