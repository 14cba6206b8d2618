// Properties of the selected link or joint with their source locations.

import { h, icon, short } from "../page/dom.js";

const CARD = "M4 5h16v14H4zM8 9h8M8 12.5h8M8 16h5";
const COPY = "M9 9h10v11H9zM15 9V5H5v11h4";

export function inspector(page) {
  const panel = page.panels.add({ id: "inspect", title: "Inspect", icon: CARD, order: 30 });
  page.on("select", show);
  page.on("robot", () => show(page.selected));

  function show(selected) {
    const link = page.robot?.links.get(selected?.link);
    const joint = page.robot?.joints.get(selected?.joint);
    const content = link ? aboutLink(page, link) : joint ? aboutJoint(page, joint) : nothing();
    panel.body.replaceChildren(...content);
  }
}

function nothing() {
  return [h("p.quiet", {}, "Click a link in the viewport, or select one in the tree.")];
}

function aboutLink(page, link) {
  const { kinematics, joints } = page.robot;
  const above = kinematics.above.get(link.name);
  const below = kinematics.below.get(link.name) ?? [];
  const parts = [title("Link", link.name)];
  if (above) parts.push(go(page, "Parent joint", { joint: above.name }, above.name, `from ${above.parent}`));
  else parts.push(h("p.quiet", {}, "The root link."));
  if (below.length) parts.push(h("div.go-list", {}, h("span.quiet", {}, "Children"), below.map((joint) => go(page, null, { link: joint.child }, joint.child, joints.get(joint.name).type))));
  parts.push(source(link.source, true));
  parts.push(link.inertial ? inertial(link.inertial) : h("section.fact", {}, h("h3", {}, "Inertial"), h("p.quiet", {}, "The link has no <inertial>: simulators merge it with its parent or reject it.")));
  for (const [words, shapes] of [["Visual", link.visuals], ["Collision", link.collisions]]) {
    shapes.forEach((shape, i) => parts.push(aboutShape(shapes.length > 1 ? `${words} ${i + 1}` : words, shape)));
    if (shapes.length === 0) parts.push(h("section.fact", {}, h("h3", {}, words), h("p.quiet", {}, "none")));
  }
  return parts;
}

function inertial({ mass, origin, rpy, tensor, ellipsoid, source: place }) {
  const rows = [["mass", mass === null ? "none" : `${short(mass, 6)} kg`], ...placement(origin, rpy)];
  if (tensor) {
    const [xx, xy, xz, yy, yz, zz] = tensor;
    rows.push(["ixx iyy izz", numbers([xx, yy, zz], "kg·m²")], ["ixy ixz iyz", numbers([xy, xz, yz], "kg·m²")]);
    rows.push(ellipsoid ? ["principal", numbers(ellipsoid.moments, "kg·m²")] : ["principal", "not physically valid"]);
  }
  return h("section.fact", {}, h("h3", {}, "Inertial"), table(rows), source(place));
}

function aboutShape(words, shape) {
  const rows = [["geometry", shape.geometry], ...placement(shape.origin, shape.rpy)];
  if (shape.name) rows.unshift(["name", shape.name]);
  if (shape.material) rows.push(["material", shape.material]);
  return h("section.fact", {}, h("h3", {}, words), table(rows), source(shape.source));
}

function aboutJoint(page, joint) {
  const unit = joint.type === "prismatic" ? "m" : "rad";
  const force = joint.type === "prismatic" ? "N" : "N·m";
  const rows = [["type", joint.type], ...placement(joint.origin, joint.rpy)];
  if (joint.type !== "fixed" && joint.type !== "floating") rows.push(["axis", joint.axis.map((x) => short(x, 4)).join("  ")]);
  if (joint.lower !== null && joint.upper !== null) rows.push(["limits", `${short(joint.lower, 4)} … ${short(joint.upper, 4)} ${unit}`]);
  else if (["revolute", "prismatic", "continuous"].includes(joint.type)) rows.push(["limits", "none"]);
  if (joint.velocity !== null) rows.push(["velocity", `${short(joint.velocity, 4)} ${unit}/s`]);
  for (const [rate, power] of [["acceleration", "²"], ["deceleration", "²"], ["jerk", "³"]])
    if (joint[rate] !== null) rows.push([rate, `${short(joint[rate], 4)} ${unit}/s${power}`]);
  if (joint.effort !== null) rows.push(["effort", `${short(joint.effort, 4)} ${force}`]);
  if (joint.damping !== null) rows.push(["damping", short(joint.damping, 6)], ["friction", short(joint.friction, 6)]);
  if (joint.mimic) rows.push(["mimics", `${short(joint.mimic.multiplier, 4)} · ${joint.mimic.master} + ${short(joint.mimic.offset, 4)}`]);
  return [
    title("Joint", joint.name),
    h("div.go-list", {}, go(page, "From", { link: joint.parent }, joint.parent), go(page, "to", { link: joint.child }, joint.child)),
    source(joint.source, true),
    h("section.fact", {}, h("h3", {}, "Joint"), table(rows)),
  ];
}

function title(kind, name) {
  return h("p.subject", {}, h("span.quiet", {}, kind), h("strong", {}, name));
}

function go(page, words, selected, name, note = null) {
  const button = h("button.chip", { type: "button", onclick: () => page.select(selected) }, name, note ? h("small", {}, note) : null);
  return words ? h("div.go", {}, h("span.quiet", {}, words), button) : button;
}

function placement(origin, rpy) {
  const rows = [["xyz", numbers(origin.slice(0, 3), "m")]];
  if (rpy.some((x) => x !== 0)) rows.push(["rpy", numbers(rpy, "rad")]);
  return rows;
}

function numbers(values, unit) {
  return `${values.map((x) => (x !== 0 && Math.abs(x) < 1e-4 ? x.toExponential(3) : short(x, 6))).join("  ")} ${unit}`;
}

export function table(rows) {
  return h("dl.facts", {}, rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

/** The source location of an element: file:line, its macro calls, and with `lines` the text. */
export function source(place, lines = false) {
  const where = `${place.file}:${place.line}`;
  const copy = h("button.place", { type: "button", title: `Copy ${where}`, "aria-label": `Copy the source location ${where}` }, h("bdi", {}, where), icon(COPY));
  copy.addEventListener("click", () => copyText(where, copy));
  const chain = (place.chain ?? []).map((call) => h("li", {}, "in macro ", h("code", {}, call.macro), ", called at ", h("bdi", { title: call.file }, `${call.file.split("/").pop()}:${call.line}`)));
  return h(
    "div.source",
    {},
    copy,
    chain.length ? h("ol.chain", {}, chain) : null,
    lines && place.lines.length ? excerpt(place.lines, place.line, place.more) : null,
  );
}

/** Source lines with their numbers, without their common indentation. */
export function excerpt(lines, first, more = 0) {
  const indents = lines.filter((line) => line.trim()).map((line) => line.match(/^\s*/)[0].length);
  const cut = Math.min(...indents, Infinity) === Infinity ? 0 : Math.min(...indents);
  const rows = lines.map((line, i) => h("span.code-line", { "data-line": first + i }, `${line.slice(cut)}\n`));
  if (more > 0) rows.push(h("span.code-line", { "data-line": "…" }, `${more} more lines\n`));
  return h("pre.code", { tabindex: "0", "aria-label": "Source" }, rows);
}

export async function copyText(text, button) {
  try {
    await navigator.clipboard.writeText(text);
    button.dataset.copied = "";
    setTimeout(() => delete button.dataset.copied, 1200);
  } catch {
    getSelection().selectAllChildren(button); // no clipboard access: select the text instead
  }
}
