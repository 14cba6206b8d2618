// Pushing a link: drag from a point of the link to apply a force there, or a torque; or type it.
/* global MeshCat */

import { h, short } from "../page/dom.js";
import { offer } from "../page/edited_fields.js";
import { numberForm, unitField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const PUSH = "M4 12h11M11 7l5 5-5 5M20 5v14";
const PERIOD = 50; // ms between two requests during a drag

export class Push {
  constructor(page) {
    this.page = page;
    this.viewer = page.viewport.viewer;
    this.grip = null;
    this.torque = false;
    this.arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1, 0xe0399b);
    for (const part of [this.arrow.line, this.arrow.cone]) Object.assign(part.material, { depthTest: false });
    this.arrow.traverse((object) => (object.renderOrder = 35));
    this.arrow.visible = false;
    this.viewer.scene.add(this.arrow);
    this.#panel();
    page.tools.tool({ id: "push", title: "Push a link", icon: PUSH, modes: ["sim"], order: 50, clicks: false, take: (held) => this.#held(held) });
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    pane.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"]) pane.addEventListener(end, (event) => this.#up(event), { capture: true });
    addEventListener("blur", () => this.release());
    page.on("lost", () => this.release());
    page.on("parameters", ({ rows }) => (this.#suit(rows), this.#offer(rows)));
    page.on("poses", () => this.grip && this.#pull());
  }

  #panel() {
    this.panel = this.page.panels.add({ id: "push", title: "Push", icon: PUSH, modes: ["sim"], order: 37 });
    this.strength = h("input", { id: "push-strength", type: "range", min: -1, max: 4, step: 0.01, value: 1 });
    this.words = h("output", { for: "push-strength" });
    const showGain = () => (this.words.textContent = `${short(this.gain, this.gain < 10 ? 1 : 0)} ${this.unit}/m`);
    this.strength.addEventListener("input", showGain);
    const kind = (value, words) => {
      const input = h("input", { type: "radio", name: "push-kind", value, checked: value === "force" });
      input.addEventListener("change", () => {
        this.torque = value === "torque";
        showGain();
        this.#name();
      });
      return h("label.check", {}, input, ` ${words}`);
    };
    this.now = h("p.now", { role: "status", id: "push-now" }, "Drag a link to push it.");
    const hold = h("button.wide", { type: "button", id: "push-hold", onclick: () => this.page.tools.hold(this.page.tools.held === "push" ? null : "push") }, "Activate the tool");
    this.panel.body.append(hold, h("div.checks", {}, kind("force", "Force at the point"), kind("torque", "Torque")), h("label.field", { for: "push-strength" }, "Strength ", this.words, this.strength), this.now, this.#typed());
    showGain();
    this.#name();
  }

  /** Fields for a push of a given force or torque and duration. */
  #typed() {
    this.choice = h("select", { id: "push-link" });
    this.fields = ["x", "y", "z"].map((axis) => unitField(axis, { id: `push-${axis}`, value: "0", unit: "N" }));
    const [seconds, duration] = unitField("duration", { id: "push-seconds", value: "0.5", min: 0.001, max: 60, step: 0.1, unit: "s" });
    const apply = () => {
      const link = this.choice.value;
      const values = this.fields.map(([input]) => input.valueAsNumber);
      const done = () => (this.now.textContent = `${link}: ${short(Math.hypot(...values), 2)} ${this.unit} for ${seconds.value} s`);
      this.#request(link, values, [0, 0, 0], { seconds: seconds.valueAsNumber }).then(done, (error) => this.page.toast(error.message, "error"));
    };
    return numberForm({ id: "push-form" }, apply, h("h3", {}, "Push for a time"), h("label.field.choice", {}, "Link", this.choice), h("div.pose", {}, this.fields.map(([, label]) => label), duration), h("button.wide", { type: "submit", id: "push-apply" }, "Apply"));
  }

  // The links and bodies that move, by the names of the simulation.
  #offer(rows) {
    const moved = rows.filter(({ mass }) => mass !== null);
    const names = moved.map(({ name, link }) => (!link ? name : name === rows[0].name ? link : `${name}::${link}`));
    offer(this.choice, names.map((name) => [name, name]));
  }

  // Default: accelerates a robot of this mass with 4 m/s² per metre.
  #suit(rows) {
    if (this.suited) return;
    const robot = rows.filter(({ name, link }) => link && name === rows[0].name);
    const mass = robot.reduce((sum, row) => sum + (row.mass ?? 0), 0);
    this.suited = mass > 0;
    if (!this.suited) return;
    this.strength.value = Math.log10(4 * mass);
    this.strength.dispatchEvent(new Event("input"));
  }

  get unit() {
    return this.torque ? "N·m" : "N";
  }

  #name() {
    this.fields.forEach(([input, label], i) => {
      label.querySelector(".unit").textContent = input.bounds.unit = this.unit;
      input.setAttribute("aria-label", `${this.torque ? "torque about" : "force along"} ${"xyz"[i]} [${this.unit}]`);
    });
  }

  /** Force [N] or torque [N·m] per metre of the drag. */
  get gain() {
    return 10 ** this.strength.valueAsNumber;
  }

  #held(held) {
    if (!held) this.release();
    this.page.viewport.pane.classList.toggle("pushing", held);
    document.getElementById("push-hold").textContent = held ? "Deactivate the tool" : "Activate the tool";
  }

  #down(event) {
    if (this.page.tools.held !== "push" || event.button !== 0 || this.grip) return;
    const hit = this.page.pick.at(event);
    if (!hit) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    const node = this.page.scene.byLink.get(hit.link);
    const at = node.localToWorld(new THREE.Vector3(...hit.local));
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(this.viewer.camera.getWorldDirection(new THREE.Vector3()), at);
    this.grip = { pointer: event.pointerId, link: hit.link, node, local: hit.local, plane, event, sent: 0 };
    this.page.viewport.pane.setPointerCapture(event.pointerId);
    this.viewer.controls.enabled = false;
    this.timer = setInterval(() => this.#send(), PERIOD);
    this.#pull();
  }

  #move(event) {
    if (!this.grip || event.pointerId !== this.grip.pointer) return;
    event.stopImmediatePropagation();
    this.grip.event = event;
    this.#pull();
  }

  #up(event) {
    if (!this.grip || event.pointerId !== this.grip.pointer) return;
    event.stopImmediatePropagation();
    this.release();
  }

  release() {
    if (!this.grip) return;
    this.grip = null;
    clearInterval(this.timer);
    this.arrow.visible = false;
    this.viewer.controls.enabled = true;
    this.now.textContent = "Drag a link to push it.";
    if (this.page.connection.open) this.page.connection.request("release").catch(() => {});
    this.page.viewport.dirty();
  }

  // From the gripped point to the pointer, parallel to the screen, in world axes.
  #pull() {
    const { grip } = this;
    const ray = this.page.pick.aim(grip.event);
    const end = ray.intersectPlane(grip.plane, new THREE.Vector3());
    if (!end) return;
    const start = grip.node.localToWorld(new THREE.Vector3(...grip.local));
    const [from, to] = [start, end].map((point) => this.viewer.scene.worldToLocal(point.clone()));
    const pull = to.clone().sub(from);
    const length = pull.length();
    const view = this.viewer.camera.getWorldDirection(new THREE.Vector3()).transformDirection(this.viewer.scene.matrixWorld.clone().invert());
    grip.wrench = this.torque ? pull.clone().cross(view).multiplyScalar(-this.gain) : pull.clone().multiplyScalar(this.gain);
    this.arrow.visible = length > 1e-4;
    this.arrow.position.copy(from);
    if (length > 1e-4) {
      this.arrow.setDirection(pull.normalize());
      this.arrow.setLength(length, Math.min(0.3 * length, 0.12), Math.min(0.18 * length, 0.07));
    }
    this.now.textContent = `${grip.link.replace("world/", "")}: ${short(grip.wrench.length(), 2)} ${this.unit}`;
    this.page.viewport.dirty();
  }

  #send() {
    const { grip } = this;
    if (!grip?.wrench) return;
    this.#request(grip.link.replace(/^world\//, ""), grip.wrench.toArray(), grip.local).catch((error) => {
      this.page.toast(error.message, "error");
      this.release();
    });
  }

  #request(link, values, at, more = {}) {
    const [force, torque] = this.torque ? [[0, 0, 0], values] : [values, [0, 0, 0]];
    return this.page.connection.request("push", { link, force, torque, at, ...more });
  }
}

export function push(page) {
  page.push = new Push(page);
  page.expose("push", page.push);
}
