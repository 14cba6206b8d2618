// Arms: a slider with the target of every joint of every controller, and the measured position.

import { h, short } from "../page/dom.js";
import { redraw, refill } from "../page/edited_fields.js";
import { numberField } from "../page/number_field.js";

const ARM = "M5 20h6M8 20v-6l-2-4 5-5 4 2M15 7l3-3M15 7l4 1M6 10a1 1 0 1 0 0 .1";
const MANY = 4; // more controllers than this are collapsed
const PERIOD = 60; // ms between two commands while a slider is dragged

export function arms(page) {
  const panel = page.panels.add({ id: "arms", title: "Arms", icon: ARM, modes: ["sim"], order: 11 });
  page.panels.available("arms", false);
  const rows = new Map(); // controller → joint → row
  const unfolded = new Map(); // controller → whether the user has expanded or collapsed it
  let waiting = new Map();
  let timer = null;
  const showError = (error) => page.toast(error.message, "error");

  function flush() {
    timer = null;
    const [now, empty] = [waiting, new Map()];
    waiting = empty;
    for (const [key, values] of now) page.connection.request("arm", values).catch(showError), waiting.delete(key);
  }

  function command(controller, joint, value) {
    waiting.set(`${controller}/${joint}`, { controller, joint, value });
    timer ??= setTimeout(flush, PERIOD);
  }

  function row(controller, joint) {
    const id = `arm-${controller}-${joint.name}`.replaceAll(/[^\w-]/g, "-");
    const number = numberField({ min: joint.lower, max: joint.upper, unit: joint.unit, value: short(joint.value, 3), "aria-label": `${joint.name} of ${controller} [${joint.unit}]` });
    const slider = h("input", { type: "range", id, min: joint.lower, max: joint.upper, step: "any" });
    slider.value = joint.value;
    const real = h("span.real.quiet", { title: "measured position" }, "");
    const mark = h("span.mark", { "aria-hidden": "true" });
    slider.addEventListener("input", () => {
      number.value = short(slider.valueAsNumber, 3);
      command(controller, joint.name, slider.valueAsNumber);
    });
    number.addEventListener("change", () => {
      const value = number.valueAsNumber;
      slider.value = value;
      command(controller, joint.name, value);
    });
    const head = h("div.arm-head", {}, h("label", { for: id, title: joint.name }, joint.name), number, h("span.unit", {}, joint.unit));
    const item = h("li", { "data-joint": joint.name }, head, h("div.track", {}, slider, mark), real);
    return { item, slider, number, real, mark, joint };
  }

  function controllerOf(arm, _, all) {
    const joints = new Map(arm.joints.map((joint) => [joint.name, row(arm.name, joint)]));
    rows.set(arm.name, joints);
    const switched = h("button.bare", { type: "button", "aria-label": `${arm.running ? "Stop" : "Start"} ${arm.name}` }, arm.running ? "Stop" : "Start");
    switched.addEventListener("click", () => page.connection.request("controller", { controller: arm.name, running: !arm.running }).catch(showError));
    const list = h("ul.bare-list", {}, ...[...joints.values()].map(({ item }) => item));
    const fold = h("button.bare.unfold", { type: "button", "aria-label": `Joints of ${arm.name}`, hidden: all.length <= MANY });
    const show = (open) => {
      list.hidden = !open;
      fold.textContent = open ? "▾" : "▸";
      fold.setAttribute("aria-expanded", open);
    };
    show(all.length <= MANY || (unfolded.get(arm.name) ?? false));
    fold.addEventListener("click", () => (unfolded.set(arm.name, list.hidden), show(list.hidden)));
    const words = h("div.row", {}, fold, h("h3", { title: arm.type }, arm.name.split("/").slice(1).join("/").split(/(?<=[_/])/).flatMap((part) => [part, h("wbr")])), h("span.space"), switched);
    return h("section.controller", { "data-controller": arm.name, "data-running": String(arm.running) }, words, list);
  }

  page.on("arms", ({ arms: all }) => {
    redraw(panel.body, () => {
      rows.clear();
      refill(panel.body, all.map(controllerOf));
    });
    page.panels.available("arms", all.length > 0);
  });
  page.on("arms_now", ({ values }) => {
    for (const [controller, joints] of Object.entries(values)) {
      for (const [name, value] of Object.entries(joints)) {
        const found = rows.get(controller)?.get(name);
        if (!found) continue;
        const { lower, upper, unit } = found.joint;
        found.real.textContent = `at ${short(value, 3)} ${unit}`;
        const part = Math.min(1, Math.max(0, (value - lower) / (upper - lower)));
        found.mark.style.left = `calc(${part} * (100% - 16px) + 8px)`; // like the centre of the slider's thumb
      }
    }
  });
  page.on("hello", () => page.whileOpen(panel, "arms"));
}
