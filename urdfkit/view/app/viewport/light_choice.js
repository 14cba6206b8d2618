// Choice of the light: that of a studio, or that of the world, as in images of its cameras.

import { h } from "../page/dom.js";

const LIGHTS = [
  ["studio", "Studio", "a studio, with reflections and tone mapping"],
  ["world", "Of the world", "the lights, the ambient light and the background of the world, as in images of its cameras"],
];

class Light {
  constructor(page) {
    this.page = page;
    this.message = null; // the lights of the world
    this.choice = "studio";
    this.inputs = new Map();
    const ways = h("div.segments", { role: "radiogroup", "aria-label": "Light" });
    for (const [way, words, does] of LIGHTS) {
      const input = h("input", { type: "radio", name: "light", value: way, id: `light-${way}`, checked: way === this.choice });
      input.addEventListener("change", () => this.choose(way));
      this.inputs.set(way, input);
      ways.append(h("label", { title: does }, input, h("span", {}, words)));
    }
    this.section = h("div", { hidden: true }, h("h3", {}, "Light"), ways);
    page.viewPanel.body.append(this.section);
    page.on("lights", (message) => {
      this.message = message;
      this.section.hidden = false;
      this.#use();
    });
  }

  /** Use a light of `LIGHTS`; that of the world, when it is known. */
  choose(way) {
    if (!this.inputs.has(way)) return;
    this.choice = way;
    this.inputs.get(way).checked = true;
    this.#use();
    this.page.emit("light", way);
  }

  #use() {
    const wanted = this.choice === "world" ? this.message : null;
    if (wanted !== (this.used ?? null)) this.page.viewport.lightBy(wanted);
    this.used = wanted;
  }
}

export function lightChoice(page) {
  page.light = new Light(page);
}
