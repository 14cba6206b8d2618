// Measuring between two points, and publishing a point. Points move with their links.
/* global MeshCat */

import { h, icon, short } from "../page/dom.js";
import { copyText } from "./inspector.js";
import { offer } from "../page/edited_fields.js";
import { numberForm, unitField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const RULER = "M3 16L16 3l5 5L8 21zM7 12l2 2M10 9l3 3M13 6l2 2";
const POINT = "M12 10a2 2 0 1 0 0 4a2 2 0 0 0 0-4zM7.8 7.8a6 6 0 0 0 0 8.4M16.2 7.8a6 6 0 0 1 0 8.4M5 5a10 10 0 0 0 0 14M19 5a10 10 0 0 1 0 14";
const CLOSE = "M6 6l12 12M18 6L6 18";
const COLOUR = 0xe0399b;
const WORLD = "world"; // the world frame of a simulation

class Points {
  constructor(page) {
    this.page = page;
    this.geometry = new THREE.BufferGeometry();
    this.dots = new THREE.Points(this.geometry, new THREE.PointsMaterial({ color: COLOUR, size: 9, sizeAttenuation: false, depthTest: false, transparent: true }));
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: COLOUR, depthTest: false, transparent: true }));
    for (const object of [this.dots, this.lines]) {
      object.frustumCulled = false;
      object.renderOrder = 30;
      page.viewport.viewer.scene.add(object);
    }
  }

  /** Current position of a point in the frame of the grid [m]; the last position if its link was removed. */
  at(point) {
    const world = point.link ? this.page.labels.at(point.link, point.local) : null;
    if (world) point.point = this.page.viewport.viewer.scene.worldToLocal(world).toArray();
    return point.point;
  }

  draw(dots, pairs) {
    this.geometry.setAttribute("position", new THREE.Float32BufferAttribute(dots.flat(), 3));
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(pairs.flat(2), 3));
    this.dots.visible = dots.length > 0;
    this.lines.visible = pairs.length > 0;
  }
}

export function measure(page) {
  const points = new Points(page);
  const panel = page.panels.add({ id: "measure", title: "Measure", icon: RULER, order: 47 });
  const hint = h("p.quiet", {}, "Select the ruler or the point tool in the toolbar, then click on the robot or the ground. Clicks snap to corners.");
  const list = h("ol.measures");
  const [from, to] = ["from", "to"].map((name) => pointFields(name));
  const publishes = h("button", { type: "button", id: "publish-point", onclick: () => form.valid() && publish(typed(from)) }, "Publish the first");
  const form = numberForm({ id: "measure-form" }, () => add([typed(from), typed(to)]), h("h3", {}, "By numbers"), from.element, to.element, h("div.row", {}, h("button", { type: "submit", id: "measure-typed" }, "Measure"), publishes));
  const clear = h("button", { type: "button", hidden: true, onclick: () => (items.slice().forEach(remove), (first = null)) }, "Clear");
  panel.tools.append(clear);
  panel.body.append(hint, list, form);
  let items = []; // {points: [one or two], label, row, text}
  let first = null;
  let last = "";

  const taken = (held) => {
    first = null;
    page.viewport.pane.style.cursor = held ? "crosshair" : "";
    if (held && !page.panels.narrow.matches) page.panels.open("measure");
  };
  page.tools.tool({ id: "measure", title: "Measure between two points", icon: RULER, order: 20, take: taken });
  page.tools.tool({ id: "point", title: "Publish a point", icon: POINT, order: 30, take: taken });
  page.shortcut({ key: "d", does: "measure a distance", group: "Tools", run: () => page.tools.hold("measure") });
  page.shortcut({ key: "b", does: "publish a point", group: "Tools", run: () => page.tools.hold("point") });
  page.on("click3d", (hit) => {
    const point = { link: hit.link, local: hit.local, point: hit.point };
    if (page.tools.held === "measure") measured(point);
    if (page.tools.held === "point") publish(point);
  });
  page.on("draw", update);
  page.on("robot", () => page.viewport.dirty());
  page.on("model", () => [from, to].forEach(offerFrames));
  page.expose("measures", { get items() { return items; } });

  function measured(point) {
    if (first === null) {
      first = point;
      page.viewport.dirty();
      return;
    }
    add([first, point]);
    first = null;
  }

  // A frame and a point in it.
  function pointFields(name) {
    const frame = h("select", { id: `measure-${name}` });
    const fields = [..."xyz"].map((axis) => unitField(axis, { id: `measure-${name}-${axis}`, value: "0", step: 0.01, unit: "m", "aria-label": `${axis} in the frame, ${name} [m]` }));
    const element = h("div", {}, h("label.field.choice", {}, name === "from" ? "From" : "To", frame), h("div.pose", {}, fields.map(([, label]) => label)));
    return { frame, inputs: fields.map(([input]) => input), element };
  }

  function offerFrames({ frame }) {
    offer(frame, [["", "ground"], ...[...page.scene.byLink.keys()].map((link) => [link, link.replace(/^world\//, "")])]);
  }

  function typed({ frame, inputs }) {
    const local = inputs.map(({ valueAsNumber }) => valueAsNumber);
    const point = { link: frame.value || null, local, point: local };
    points.at(point);
    return point;
  }

  async function publish(point) {
    add([point]);
    const { order, values, place, frame } = page.mode === "sim" ? inWorld(point) : onLink(point);
    try {
      await page.connection.request(order, values);
      page.toast(`Published ${place.map((x) => short(x, 4)).join(", ")} in ${frame}`, "good");
    } catch (error) {
      page.toast(error.message, "error");
    }
  }

  function onLink({ link, local, point }) {
    const frame = link ?? (page.cameras.fixed || page.robot.kinematics.root);
    const place = link ? local : point;
    return { order: "point", values: { frame, position: place }, place, frame };
  }

  // A simulation publishes the point in the world frame, because the clicked link may belong to any model.
  function inWorld({ point: place }) {
    const [x, y, z] = place;
    const message = { header: { frame_id: WORLD }, point: { x, y, z } };
    return { order: "publish", values: { topic: "/clicked_point", type: "geometry_msgs/msg/PointStamped", message }, place, frame: WORLD };
  }

  function add(which) {
    const label = page.labels.add(h("span.measure-label"), () => middle(which));
    const text = h("span.measure-text");
    const copy = h("button.chip", { type: "button", onclick: () => copyText(text.textContent, copy) }, "Copy");
    const item = { points: which, label, text };
    const gone = h("button.bare", { type: "button", "aria-label": "Delete", title: "Delete", onclick: () => remove(item) }, icon(CLOSE));
    item.row = h("li", {}, text, copy, gone);
    list.append(item.row);
    items.push(item);
    clear.hidden = false;
    page.viewport.dirty();
  }

  function remove(item) {
    page.labels.remove(item.label);
    item.row.remove();
    items = items.filter((other) => other !== item);
    clear.hidden = items.length === 0;
    page.viewport.dirty();
  }

  function middle(which) {
    const places = which.map((point) => points.at(point));
    const mean = [0, 1, 2].map((i) => places.reduce((sum, place) => sum + place[i], 0) / places.length);
    return page.viewport.viewer.scene.localToWorld(new THREE.Vector3(...mean));
  }

  function update() {
    const dots = [...items.flatMap((item) => item.points), ...(first ? [first] : [])].map((point) => points.at(point));
    const pairs = items.filter((item) => item.points.length === 2).map((item) => item.points.map((point) => points.at(point)));
    const now = JSON.stringify([dots, items.length]);
    if (now === last) return;
    last = now;
    points.draw(dots, pairs);
    for (const item of items) describe(item);
  }

  function describe({ points: which, label, text }) {
    const [a, b] = which.map((point) => points.at(point));
    if (!b) {
      const frame = page.cameras.fixed || page.robot?.kinematics.root || WORLD;
      label.textContent = a.map((x) => short(x)).join(", ");
      text.textContent = `${which[0].link ?? "ground"}: ${a.map((x) => short(x, 4)).join("  ")} m in ${frame}`;
      return;
    }
    const apart = b.map((x, i) => x - a[i]);
    label.textContent = metres(Math.hypot(...apart));
    text.textContent = `${metres(Math.hypot(...apart))}  (x ${short(apart[0], 4)}, y ${short(apart[1], 4)}, z ${short(apart[2], 4)})`;
  }
}

function metres(length) {
  return length < 1 ? `${short(1000 * length, 1)} mm` : `${short(length, 4)} m`;
}
