// The buttons that lead from the viewer to a simulation of the robot, and back.

import { h, icon } from "./dom.js";
import { offer } from "./edited_fields.js";

const PLAY = "M8 5l11 7-11 7z";
const BACK = "M10 6l-6 6 6 6M4 12h16";

export function modes(page) {
  const world = h("select", { id: "world-choice", "aria-label": "World of the simulation", title: "World of the simulation", hidden: true });
  const go = h("button", { type: "button", id: "switch-mode", hidden: true });
  document.querySelector(".bar .space").after(world, go);
  let other = null;

  page.on("modes", (message) => {
    other = message.other;
    offer(world, message.worlds.map((name) => [name, name]), () => message.worlds.includes(message.world) && (world.value = message.world));
    world.hidden = other !== "sim";
    go.hidden = false;
    const [words, title, path] = other === "sim" ? ["Simulate", "Simulate the robot in this world", PLAY] : ["Viewer", "Return to the viewer", BACK];
    go.replaceChildren(icon(path), h("span", {}, words));
    go.title = title;
    go.setAttribute("aria-label", words);
  });
  go.addEventListener("click", () => {
    const [name, values] = other === "sim" ? ["simulate", { world: world.value }] : ["view", {}];
    go.disabled = true;
    page.connection.request(name, values).catch((error) => {
      go.disabled = false;
      page.toast(error.message, "error");
    });
  });
}
