// The tree of transforms (TF) with the age of each.

import { h, short } from "../page/dom.js";

const OLD = 1; // s after which a transform that is not static counts as old

export function transforms(page) {
  const list = h("ul.transforms", { "aria-label": "Transforms" });
  const none = h("p.quiet", {}, "Nothing has been published on /tf or /tf_static.");
  const details = h("details", { id: "transforms" }, h("summary", {}, "Transforms"), none, list);
  let wanted = false;
  const look = () => {
    const open = details.open && details.checkVisibility();
    if (open === wanted) return;
    wanted = open;
    page.connection.subscribe("frames", open);
  };
  details.addEventListener("toggle", look);
  page.on("status", look);
  page.on("frames", ({ rows }) => {
    none.hidden = rows.length > 0;
    const below = new Map();
    for (const row of rows) below.set(row.parent, [...(below.get(row.parent) ?? []), row]);
    const names = new Set(rows.map(({ name }) => name));
    const roots = [...below.keys()].filter((name) => !names.has(name));
    list.replaceChildren(...roots.map((name) => branch({ name, root: true }, below)));
  });
  return details;
}

function branch(row, below) {
  const age = row.root ? "root" : row.static ? "static" : `${short(row.age, row.age < 10 ? 2 : 0)} s`;
  const words = h("div.transform", { "data-frame": row.name, "data-old": !row.root && !row.static && row.age > OLD }, h("bdi", {}, row.name || "(no name)"), h("small.quiet", {}, age));
  const children = (below.get(row.name) ?? []).map((child) => branch(child, below));
  return h("li", {}, words, children.length ? h("ul", {}, children) : null);
}
