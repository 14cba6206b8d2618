// The reach map in the frame of its base link: cells as cubes coloured by score, all of them or one slice.
/* global MeshCat */

import { h, short } from "../page/dom.js";
import { slider } from "../viewport/display_layers.js";

const THREE = MeshCat.THREE;
const CELLS = "M4 4h16v16H4zM4 9.3h16M4 14.7h16M9.3 4v16M14.7 4v16";
const AXES = ["x", "y", "z"];
const ALL = 0.3; // edge of a cube, in cells, if all cells are shown
const SLICE = 0.94; // in a slice

export function reach(page) {
  const panel = page.panels.add({ id: "reach", title: "Reach", icon: CELLS, order: 15, modes: ["view"] });
  page.panels.available("reach", false);
  let map = null; // the last message `reach`, with its scores as bytes
  let mesh = null;
  const shown = { axis: 1, layer: 0, least: 0, count: 0 };
  page.expose("reach", { get map() { return map; }, get mesh() { return mesh; }, shown });

  page.on("reach", (message) => {
    map = { ...message, scores: Uint8Array.from(atob(message.scores), (letter) => letter.charCodeAt(0)) };
    page.panels.available("reach", true);
    build();
    cut(1);
    page.panels.open("reach");
  });
  page.on("draw", () => {
    const node = page.scene.byLink.get(map?.base);
    if (!mesh || !node) return;
    node.updateWorldMatrix(true, false);
    mesh.matrix.copy(page.viewport.viewer.scene.matrixWorld).invert().multiply(node.matrixWorld);
    mesh.matrixWorldNeedsUpdate = true;
  });

  const words = h("p.quiet", { id: "reach-words" });
  const layer = h("div");
  const axes = h("select", { id: "reach-axis" }, AXES.map((axis, k) => h("option", { value: k, selected: k === 1 }, `slice across ${axis}`)), h("option", { value: -1 }, "all cells"), h("option", { value: -2 }, "none"));
  axes.addEventListener("change", () => cut(Number(axes.value)));

  function build() {
    const ramp = map.colours.map((rgb) => `rgb(${rgb})`).join(", ");
    const bar = h("div", { id: "reach-colours" });
    bar.style.cssText = `height: .8rem; border-radius: .3rem; background: linear-gradient(to right, ${ramp})`;
    const ends = h("p.quiet", { id: "reach-ends" }, "score 0 (left) to 1 (right)");
    const least = slider("Minimum score", { id: "reach-least", min: 0, max: 1, value: 0, text: (v) => short(v, 2), moved: (v) => ((shown.least = v), draw()) });
    panel.body.replaceChildren(h("p", {}, `${map.tip} in ${map.base}`), h("label.stacked", { for: "reach-axis" }, "Cells", axes), layer, least, bar, ends, words);
  }

  /** Show the slice across an axis through the origin of the base; -1 for all cells, -2 for no cells. */
  function cut(axis) {
    shown.axis = axis;
    layer.replaceChildren();
    if (axis >= 0) {
      const last = map.shape[axis] - 1;
      shown.layer = Math.min(last, Math.max(0, Math.floor(1e-6 - map.origin[axis] / map.resolution)));
      const text = (k) => `${short(middle(axis, k))} m`;
      layer.append(slider(AXES[axis], { id: "reach-layer", min: 0, max: last, step: 1, value: shown.layer, text, moved: (k) => ((shown.layer = k), draw()) }));
    }
    draw();
  }

  const middle = (axis, k) => map.origin[axis] + (k + 0.5) * map.resolution;

  function draw() {
    const [, ny, nz] = map.shape;
    const cells = [];
    map.scores.forEach((score, index) => {
      const place = [Math.floor(index / (ny * nz)), Math.floor(index / nz) % ny, index % nz];
      const inside = shown.axis === -1 || (shown.axis >= 0 && place[shown.axis] === shown.layer);
      if (score > 0 && inside && score >= 255 * shown.least) cells.push([place, score / 255]);
    });
    clear();
    const edge = map.resolution * (shown.axis < 0 ? ALL : SLICE);
    const material = shown.axis < 0 ? new THREE.MeshLambertMaterial() : new THREE.MeshBasicMaterial();
    mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(edge, edge, edge), material, cells.length);
    const matrix = new THREE.Matrix4();
    cells.forEach(([place, score], k) => {
      mesh.setMatrixAt(k, matrix.makeTranslation(...place.map((number, axis) => middle(axis, number))));
      mesh.setColorAt(k, colour(score));
    });
    mesh.matrixAutoUpdate = false;
    mesh.frustumCulled = false;
    mesh.raycast = () => {}; // clicks select the robot behind it
    page.viewport.viewer.scene.add(mesh);
    shown.count = cells.length;
    words.textContent = `${cells.length} cells of ${map.resolution} m shown`;
    page.viewport.dirty();
  }

  function clear() {
    if (!mesh) return;
    page.viewport.viewer.scene.remove(mesh);
    mesh.geometry.dispose();
    mesh.material.dispose();
    mesh.dispose?.();
  }

  function colour(score) {
    const at = score * (map.colours.length - 1);
    const k = Math.min(Math.floor(at), map.colours.length - 2);
    const rgb = map.colours[k].map((low, i) => (low + (at - k) * (map.colours[k + 1][i] - low)) / 255);
    return new THREE.Color(...rgb);
  }
}
