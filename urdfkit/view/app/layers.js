// What is shown of the robot and around it.

import { check, h } from "./dom.js";

const LAYERS = "M12 3l9 5-9 5-9-5zM3 12l9 5 9-5M3 16l9 5 9-5";

export function layers(page) {
  const { scene, stage } = page;
  const panel = page.panels.add({ id: "show", title: "Show", icon: LAYERS, order: 40 });
  const boxes = h("div.checks");
  panel.body.append(boxes);
  const add = (words, options) => boxes.append(check(words, options).label);
  add("Visual", { id: "show-visual", checked: true, changed: (shown) => scene.show("visual", shown) });
  add("Collision", { id: "show-collision", changed: (shown) => scene.show("collision", shown) });
  add("Grid", { id: "show-grid", checked: true, changed: (shown) => stage.visible("Grid", shown) });
  add("Origin", { id: "show-axes", changed: (shown) => stage.visible("Axes", shown) });
  const follow = check("Follow robot", { id: "follow", checked: true, changed: (on) => (page.following = on) });
  follow.label.dataset.mode = "sim";
  boxes.append(follow.label);
}
