// The frame tree with the live transform of every frame in a selected frame.

import { h, icon, short } from "../page/dom.js";
import { offer } from "../page/edited_fields.js";
import { copyText } from "./inspector.js";
import { IDENTITY, compose, inverse, toRpy, turnOf } from "./pose.js";

const FRAMES = "M4 20V8M4 20h12M4 20l6-6M16 10l4-4M20 10V6h-4";
const COPY = "M9 9h10v11H9zM15 9V5H5v11h4";
const PERIOD = 150; // ms between updates
const PARENT = "";
const WORLD = "\n"; // no name of a link

export function tf(page) {
  const panel = page.panels.add({ id: "tf", title: "Frames", icon: FRAMES, order: 45 });
  const choice = h("select#tf-in", { "aria-label": "Express in" });
  const unit = h("select#tf-unit", { "aria-label": "Angles in" }, h("option", { value: "rad" }, "rad"), h("option", { value: "deg" }, "deg"));
  const list = h("ol.tf");
  panel.body.append(h("div.row.tf-head", {}, h("label.grow", {}, h("span.quiet", {}, "Express in"), choice), h("label", {}, h("span.quiet", {}, "Angles"), unit)), list);
  let rows = [];
  let due = null;

  page.on("robot", ({ kinematics }) => {
    const world = page.mode === "sim" ? [[WORLD, "world"]] : [];
    rows = [...walk(kinematics, kinematics.root, 0)].map(row);
    list.replaceChildren(...rows.map(({ item }) => item));
    offer(choice, [[PARENT, "parent frame"], ...world, ...kinematics.links.map((link) => [link, link])], update);
    update();
    mark(page.selected);
  });
  const soon = () => {
    if (panel.open) due ??= setTimeout(() => ((due = null), update()), PERIOD);
  };
  page.on("joints", soon);
  page.on("poses", () => page.mode === "sim" && soon());
  for (const select of [choice, unit]) select.addEventListener("change", update);
  panel.button.addEventListener("click", update);
  page.on("select", mark);

  function* walk(kinematics, link, depth) {
    yield { link, joint: kinematics.above.get(link), depth };
    for (const joint of kinematics.below.get(link) ?? []) yield* walk(kinematics, joint.child, depth + 1);
  }

  function row({ link, joint, depth }) {
    const name = h("button.entry", { type: "button", title: link, onclick: () => page.select({ link }) }, link);
    name.style.paddingLeft = `${0.4 + 0.4 * Math.min(depth, 12)}rem`;
    const kind = h("small", {}, joint ? joint.type : "root");
    const numbers = h("span.tf-numbers");
    const copy = h("button.bare.copy", { type: "button", title: "Copy x y z qx qy qz qw", "aria-label": `Copy the transform of ${link}` }, icon(COPY));
    const made = { link, joint, name, numbers, pose: null, item: h("li", {}, h("div.tf-name", {}, name, kind, copy), numbers) };
    made.item.dataset.frame = link;
    copy.addEventListener("click", () => copyText(made.pose.map((x) => x.toPrecision(12)).join(" "), copy));
    return made;
  }

  function update() {
    if (!page.robot) return;
    const poses = page.mode === "sim" ? placed(page) : page.robot.kinematics.forward(page.values);
    const base = choice.value === PARENT ? null : choice.value === WORLD ? IDENTITY : inverse(poses.get(choice.value));
    const factor = unit.value === "deg" ? 180 / Math.PI : 1;
    for (const made of rows) {
      const from = base ?? (made.joint ? inverse(poses.get(made.joint.parent)) : null);
      made.pose = from ? compose(from, poses.get(made.link)) : poses.get(made.link);
      const place = made.pose.slice(0, 3).map((x) => short(x, 4)).join("  ");
      const turn = toRpy(turnOf(made.pose)).map((x) => short(x * factor, unit.value === "deg" ? 2 : 4)).join("  ");
      made.numbers.textContent = `xyz ${place} m\nrpy ${turn} ${unit.value}`;
    }
  }

  function mark(selected) {
    for (const { link, name } of rows) name.toggleAttribute("data-selected", selected?.link === link);
  }
}

/** The poses of the robot's links in the world, as the scene shows them. */
function placed(page) {
  return new Map(page.robot.kinematics.links.map((link) => {
    const { position, quaternion } = page.scene.byLink.get(link);
    return [link, [...position.toArray(), ...quaternion.toArray()]];
  }));
}
