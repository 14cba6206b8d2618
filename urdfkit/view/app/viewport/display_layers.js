// Visibility and style of the robot's shapes, markers, grid and origin.

import { check, h } from "../page/dom.js";
import { Markers } from "./link_markers.js";

const LAYERS = "M12 3l9 5-9 5-9-5zM3 12l9 5 9-5M3 16l9 5 9-5";
const MARKS = [
  ["frames", "Link frames", "x", "the frame of every link"],
  ["axes", "Joint axes", "j", "the axis of every joint"],
  ["inertia", "Inertia", "i", "ellipsoids of uniform density with the inertia of each link"],
  ["com", "Centres of mass", "m", "the centre of mass of each link"],
];

export function layers(page) {
  const { scene, viewport } = page;
  const panel = page.panels.add({ id: "show", title: "Show", icon: LAYERS, order: 40 });
  const markers = new Markers(page);
  const boxes = h("div.checks");
  panel.body.append(boxes);

  const both = ["view", "sim"];
  function add(words, { key, modes = both, keys = ["view"], does, ...options }) {
    const { box, label } = check(words, options);
    boxes.append(label);
    if (modes.length === 1) label.dataset.mode = modes[0];
    if (key) page.shortcut({ key, does: does ?? `${words.toLowerCase()} on and off`, modes: keys, group: "Show", run: () => box.click() });
    return box;
  }
  add("Visual", { id: "show-visual", key: "v", checked: true, changed: (shown) => scene.show("visual", shown) });
  add("Collision", { id: "show-collision", key: "c", changed: (shown) => scene.show("collision", shown) });
  for (const [kind, words, key, title] of MARKS) {
    add(words, { id: `show-${kind}`, key, title, keys: kind === "frames" ? both : ["view"], changed: (shown) => markers.show(kind, shown) });
  }
  add("Names", { id: "show-names", key: "n", keys: both, changed: (shown) => names(page, shown) });
  add("Wireframe", { id: "wireframe", key: "w", changed: (wireframe) => scene.restyle({ wireframe }) });
  add("Grid", { id: "show-grid", key: "g", checked: true, changed: (shown) => viewport.visible("Grid", shown) });
  add("Ground", { id: "show-ground", checked: true, changed: (shown) => viewport.visible("Ground", shown) }).parentElement.hidden = true; // until the world has one
  add("Origin", { id: "show-axes-world", changed: (shown) => viewport.visible("Axes", shown) });
  add("Follow robot", { id: "follow", modes: ["sim"], checked: true, changed: (on) => (page.following = on) });

  panel.body.append(
    slider("Opacity", { id: "opacity", min: 0.05, max: 1, value: 1, text: (v) => `${Math.round(100 * v)} %`, moved: (opacity) => scene.restyle({ opacity }) }),
    slider("Marker size", {
      id: "mark-size", min: 0.2, max: 4, value: 1, text: (v) => `× ${v.toFixed(1)}`,
      moved: (size) => {
        markers.size = size;
        markers.update();
      },
    }),
  );
  page.on("robot", () => {
    markers.build();
    names(page, document.getElementById("show-names").checked);
  });
  page.on("fit", () => markers.update());
  page.on("hover", () => shown.length && viewport.dirty()); // whose name is in front
  page.expose("markers", markers);
}

/** A slider with its label and value. */
export function slider(words, { id, min, max, value, step = 0.01, text, moved }) {
  const output = h("output", { for: id }, text(value));
  const input = h("input", { type: "range", id, min, max, step, value });
  input.addEventListener("input", () => {
    output.textContent = text(input.valueAsNumber);
    moved(input.valueAsNumber);
  });
  return h("label.field", { for: id }, words, " ", output, input);
}

let shown = [];

function names(page, wanted) {
  for (const label of shown) page.labels.remove(label);
  shown = wanted ? [...page.robot.links.keys()].map((link) => page.labels.add(h("span.name-label", { "data-name": link }, link), () => page.labels.at(link))) : [];
  page.viewport.dirty();
}
