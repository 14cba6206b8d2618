// The pairs of links that collide: a matrix, and for each pair the configuration that shows a collision.

import { h, short } from "../page/dom.js";

const GRID = "M4 4h16v16H4zM4 9.3h16M4 14.7h16M9.3 4v16M14.7 4v16M4 4l16 16";
const COLOURS = { Adjacent: "#8a94a3", Default: "#7c3aed", Always: "#991b1b", Never: "#2f9e6e", check: "#f08c00" };
const MEANINGS = {
  Adjacent: "a joint connects them",
  Default: "they collide at rest",
  Always: "they collide in every sample",
  Never: "no collision was found",
  check: "they collide in some configurations",
};
const WIDTH = 300; // of the matrix

export function collisions(page) {
  const panel = page.panels.add({ id: "collisions", title: "Collisions", icon: GRID, order: 16, modes: ["view"] });
  page.panels.available("collisions", false);
  const canvas = h("canvas", { id: "collision-matrix", role: "img", "aria-label": "matrix of pairs of links; the list below has the same pairs" });
  canvas.style.cssText = `width: ${WIDTH}px; height: ${WIDTH}px; max-width: 100%; cursor: crosshair; display: block`;
  const words = h("p", { id: "collision-words", role: "status" });
  const shown = h("select", { id: "collision-reasons" });
  const list = h("ul", { id: "collision-pairs" });
  list.style.cssText = "list-style: none; margin: 0; padding: 0; max-height: 22rem; overflow: auto";
  panel.body.append(words, canvas, h("label.stacked", { for: "collision-reasons" }, "Pairs", shown), list);
  let matrix = null;
  let places = new Map(); // link → row
  let chosen = null;
  let marks = [];
  page.expose("collisions", { get matrix() { return matrix; }, get chosen() { return chosen; } });

  const reason = (pair) => pair.reason ?? "check";
  const name = (pair) => pair.links.join(" – ");

  page.on("collisions", (message) => {
    matrix = message;
    places = new Map(message.links.map((link, k) => [link, k]));
    const counts = Object.keys(COLOURS).map((key) => [key, message.pairs.filter((pair) => reason(pair) === key).length]);
    shown.replaceChildren(...counts.filter(([, count]) => count).map(([key, count]) => h("option", { value: key, selected: key === "check" }, `${key === "check" ? "to check" : key} (${count}): ${MEANINGS[key]}`)));
    page.panels.available("collisions", true);
    fill();
    choose(null);
    page.panels.open("collisions");
  });
  page.on("theme", () => matrix && draw());
  shown.addEventListener("change", fill);
  canvas.addEventListener("pointermove", (event) => (canvas.title = at(event) ? describe(at(event)) : ""));
  canvas.addEventListener("click", (event) => at(event) && choose(at(event)));

  function fill() {
    const pairs = matrix.pairs.filter((pair) => reason(pair) === shown.value).sort((a, b) => b.hits / (b.samples || 1) - a.hits / (a.samples || 1));
    list.replaceChildren(...pairs.map((pair) => h("li", {}, h("button.bare", { type: "button", onclick: () => choose(pair) }, name(pair)))));
  }

  // The pair under the pointer: row and column are links, in either order.
  function at(event) {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const count = matrix.links.length;
    const [column, row] = [((event.clientX - left) / width) * count, ((event.clientY - top) / height) * count].map(Math.floor);
    return matrix.pairs.find(({ links }) => [row, column].includes(places.get(links[0])) && [row, column].includes(places.get(links[1]))) ?? null;
  }

  function describe(pair) {
    const { samples, hits, rate_bound: bound, distance, collision } = pair;
    const rate = samples ? `; ${hits} of ${samples} samples collide, the rate is below ${Number((100 * bound).toPrecision(2))} % at 95 % confidence` : "";
    const near = distance === null ? "" : distance > 0 ? `; closest approach ${short(distance, 4)} m` : "; found by the search for the closest approach";
    return `${name(pair)}: ${pair.reason ?? "to check"}, ${MEANINGS[reason(pair)]}${rate}${near}${collision ? "; shown" : ""}`;
  }

  /** Show a pair: its numbers, the names of its links, and the configuration in which they collide. */
  function choose(pair) {
    chosen = pair;
    for (const label of marks) page.labels.remove(label);
    marks = (pair?.links ?? []).map((link) => page.labels.add(h("span.name-label", { "data-name": link }, link), () => page.labels.at(link)));
    words.textContent = pair ? describe(pair) : `${matrix.pairs.length} pairs of ${matrix.links.length} links; choose one`;
    if (pair?.collision) page.setJoints(pair.collision);
    if (pair) page.select({ link: pair.links[0] });
    draw();
    page.viewport.dirty();
  }

  function draw() {
    const count = matrix.links.length;
    const edge = Math.max(2, Math.floor((2 * WIDTH) / count));
    canvas.width = canvas.height = edge * count;
    const paint = canvas.getContext("2d");
    const gap = edge > 6 ? 1 : 0;
    for (const pair of matrix.pairs) {
      const [i, j] = pair.links.map((link) => places.get(link));
      for (const [row, column] of [[i, j], [j, i]]) {
        paint.fillStyle = COLOURS[reason(pair)];
        paint.fillRect(edge * column, edge * row, edge - gap, edge - gap);
        if (pair !== chosen) continue;
        paint.strokeStyle = getComputedStyle(canvas).color;
        paint.lineWidth = Math.max(2, edge / 5);
        paint.strokeRect(edge * column, edge * row, edge, edge);
      }
    }
  }
}
