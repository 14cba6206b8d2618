// Drawing walls: click or type the corners, add doors, build.
/* global MeshCat */

import { h, short } from "../page/dom.js";
import { numberForm, unitField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const WALL = "M3 6h18v12H3zM3 12h18M9 6v6M15 12v6";
const GRID = 0.1; // corners snap to this [m]
const CLOSE = 0.3; // a corner this near to the first closes the room [m]
const MOST = 100;

export class Walls {
  constructor(page, host) {
    this.page = page;
    this.corners = [];
    this.doors = [];
    this.steps = []; // the list that each step has extended
    this.door = false;
    this.line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xf5a524, depthTest: false }));
    this.dots = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ color: 0xf5a524, size: 9, sizeAttenuation: false, depthTest: false }));
    this.gaps = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x0aa37f, depthTest: false }));
    for (const object of [this.line, this.dots, this.gaps]) {
      object.renderOrder = 30;
      object.frustumCulled = false;
      page.viewport.viewer.scene.add(object);
    }
    const number = (id, words, value, min, max) => unitField(words, { id: `wall-${id}`, value, min, max, step: 0.05, unit: "m" });
    const [height, tall] = number("height", "height", 2.5, 0.05, 20);
    const [thickness, thick] = number("thickness", "thickness", 0.15, 0.02, 2);
    const [width, wide] = number("door", "door width", 0.9, 0.2, 20);
    Object.assign(this, { height, thickness, width });
    this.doorButton = h("button", { type: "button", id: "wall-door-mode", "aria-pressed": "false", onclick: () => this.#mode(!this.door) }, "Doors");
    this.build = h("button.main", { type: "button", id: "wall-build", disabled: true, onclick: () => this.finish() }, "Build");
    this.words = h("p.quiet", { role: "status" });
    this.box = h("div.walls", { hidden: true }, this.words, h("div.pose", {}, tall, thick, wide), this.#typed(number), h("div.row", {}, this.doorButton, h("button", { type: "button", onclick: () => this.undo() }, "Undo"), h("span.space"), this.build));
    const draw = h("button.wide", { type: "button", id: "draw-walls", onclick: () => page.tools.hold(page.tools.held === "walls" ? null : "walls") }, "Draw walls …");
    host.append(draw, this.box);
    page.tools.tool({ id: "walls", title: "Draw walls", icon: WALL, modes: ["sim"], order: 62, take: (held) => this.#held(held) });
    page.on("click3d", (hit) => page.tools.held === "walls" && this.click(hit.point, hit.event));
    page.shortcut({ key: "Enter", does: "build the drawn walls", modes: ["sim"], group: "World", run: () => (page.tools.held === "walls" ? void this.finish() : false) });
    page.shortcut({ key: "Escape", does: "deactivate the tool", modes: ["sim"], group: "World", run: () => (page.tools.held ? void page.tools.hold(null) : false) });
  }

  /** Fields for the next corner, and for a door in a wall. */
  #typed(number) {
    const [[x, atX], [y, atY]] = [number("x", "corner x", 0, -1e3, 1e3), number("y", "corner y", 0, -1e3, 1e3)];
    const corner = numberForm({ id: "wall-corner" }, () => this.#add([x.valueAsNumber, y.valueAsNumber]), h("div.pose", {}, atX, atY, h("button", { type: "submit" }, "Add corner")));
    const [wall, which] = unitField("wall", { id: "wall-number", "aria-label": "wall of the door", value: 1, min: 1, max: MOST, step: 1, whole: true, unit: "" });
    const [along, distance] = unitField("distance", { id: "wall-door-at", "aria-label": "distance of the door from the start of the wall [m]", value: 1, min: 0, step: 0.05, unit: "m" });
    const door = numberForm({ id: "wall-door-form" }, () => this.#cut(wall.valueAsNumber - 1, along.valueAsNumber), h("div.pose", {}, which, distance, h("button", { type: "submit" }, "Add door")));
    return h("div", {}, corner, door);
  }

  #held(held) {
    this.box.hidden = !held;
    if (held) this.page.panels.open("world");
    else this.clear();
    this.#showHint();
  }

  #mode(door) {
    this.door = door;
    this.doorButton.setAttribute("aria-pressed", door);
    this.#showHint();
  }

  #showHint() {
    const count = this.corners.length;
    if (this.door) this.words.textContent = "Click the position of the door on a wall.";
    else if (count < 2) this.words.textContent = count ? "Click the next corner." : "Click the first corner on the ground, or type it. Clicked corners snap to 10 cm; hold Alt to place them freely.";
    else this.words.textContent = `${count - 1} walls, the last one ${short(this.length(count - 2), 2)} m long. Click the next corner, or build.`;
    this.build.disabled = count < 2;
  }

  length(segment) {
    const [a, b] = [this.corners[segment], this.corners[segment + 1]];
    return Math.hypot(b[0] - a[0], b[1] - a[1]);
  }

  click([x, y], event) {
    if (this.door) return this.#addDoor(x, y);
    const snap = (value) => (event?.altKey ? value : Math.round(value / GRID) * GRID);
    let corner = [snap(x), snap(y)];
    const [first] = this.corners;
    if (this.corners.length > 2 && Math.hypot(first[0] - x, first[1] - y) < CLOSE) corner = [...first];
    this.#add(corner);
  }

  #add(corner) {
    const last = this.corners.at(-1);
    if (last && Math.hypot(last[0] - corner[0], last[1] - corner[1]) < 0.02) return;
    if (this.corners.length >= MOST) return this.page.toast(`at most ${MOST} corners; build these walls first`, "error");
    this.#push(this.corners, corner);
  }

  #addDoor(x, y) {
    let best = null;
    for (let k = 0; k + 1 < this.corners.length; k += 1) {
      const [[ax, ay], length] = [this.corners[k], this.length(k)];
      const [ux, uy] = [(this.corners[k + 1][0] - ax) / length, (this.corners[k + 1][1] - ay) / length];
      const along = (x - ax) * ux + (y - ay) * uy;
      const off = Math.abs((x - ax) * uy - (y - ay) * ux) + Math.max(0, -along, along - length);
      if (!best || off < best.off) best = { off, segment: k, along };
    }
    if (!best) return this.page.toast("draw a wall first", "error");
    this.#cut(best.segment, best.along);
  }

  /** Add a door. @param segment index of the wall; @param along distance of its middle from the first corner of the wall [m] */
  #cut(segment, along) {
    const walls = this.corners.length - 1;
    if (segment >= walls) return this.page.toast(walls > 0 ? `there is no wall ${segment + 1}; the last one is ${walls}` : "draw a wall first", "error");
    const [width, length] = [this.width.valueAsNumber, this.length(segment)];
    if (length < width) return this.page.toast(`this wall is ${short(length, 2)} m long: too short for a door of ${short(width, 2)} m`, "error");
    const at = Math.min(length - width / 2, Math.max(width / 2, along));
    const taken = this.doors.some((door) => door.segment === segment && Math.abs(door.at - at) < (door.width + width) / 2);
    if (taken) return this.page.toast("there is already a door", "error");
    this.#push(this.doors, { segment, at, width });
  }

  #push(list, entry) {
    list.push(entry);
    this.steps.push(list);
    this.#draw();
  }

  undo() {
    this.steps.pop()?.pop();
    this.#draw();
  }

  clear() {
    this.corners = [];
    this.doors = [];
    this.steps = [];
    this.#mode(false);
    this.#draw();
  }

  async finish() {
    if (this.corners.length < 2) return;
    const values = { corners: this.corners, doors: this.doors, height: this.height.valueAsNumber, thickness: this.thickness.valueAsNumber };
    try {
      const done = await this.page.connection.request("walls", values);
      this.page.objects.inserted(`built ${done.name}`, done);
      this.clear();
    } catch (error) {
      this.page.toast(error.message, "error");
    }
  }

  #draw() {
    const points = this.corners.map(([x, y]) => new THREE.Vector3(x, y, 0.02));
    const replace = (object, vertices) => {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry().setFromPoints(vertices);
      object.visible = vertices.length > 0;
    };
    replace(this.line, points);
    replace(this.dots, points);
    const ends = this.doors.flatMap(({ segment, at, width }) => {
      const [a, b, length] = [points[segment], points[segment + 1], this.length(segment)];
      return [at - width / 2, at + width / 2].flatMap((where) => {
        const foot = a.clone().lerp(b, where / length);
        return [foot, foot.clone().setZ(2)];
      });
    });
    replace(this.gaps, ends);
    this.#showHint();
    this.page.viewport.dirty();
  }
}

export function walls(page) {
  page.walls = new Walls(page, page.objects.extra);
  page.expose("walls", page.walls);
}
