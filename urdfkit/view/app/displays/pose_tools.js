// Publishing a goal or a pose estimate: press at the position, drag to the heading, release; or by numbers.
/* global MeshCat */

import { h } from "../page/dom.js";
import { unitField } from "../page/number_field.js";

const THREE = MeshCat.THREE;
const GOAL = "M6 21V4M6 4h11l-3 4 3 4H6";
const ESTIMATE = "M12 2v4M12 18v4M2 12h4M18 12h4M12 7a5 5 0 1 0 0 10a5 5 0 0 0 0-10z";
const TOOLS = { goal: ["Publish a goal", GOAL, "Goal"], estimate: ["Publish a pose estimate", ESTIMATE, "Pose estimate"] };
const LEAST = 0.1; // m that the pointer must move to give a heading

export class PoseTools {
  constructor(page) {
    this.page = page;
    this.drag = null;
    this.arrow = new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 0.5, 0x1f9d55, 0.15, 0.1);
    this.arrow.visible = false;
    page.viewport.viewer.scene.add(this.arrow);
    Object.entries(TOOLS).forEach(([id, [title, icon]], i) => {
      page.tools.tool({ id, title, icon, modes: ["sim"], order: 54 + i, clicks: false, take: () => this.#end() });
    });
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    pane.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    pane.addEventListener("pointerup", (event) => this.#up(event), { capture: true });
    pane.addEventListener("pointercancel", () => this.#end(), { capture: true });
    page.displays.panel.body.append(this.#form());
  }

  #form() {
    const fields = [["x", "m"], ["y", "m"], ["yaw", "°"]].map(([name, unit]) => {
      return unitField(name, { value: "0", step: unit === "m" ? 0.1 : 5, unit, id: `pose-${name}`, "aria-label": `${name} of the pose [${unit}]` });
    });
    const values = () => fields.map(([{ valueAsNumber }]) => valueAsNumber);
    const button = (id) => h("button", { type: "button", id: `publish-${id}`, onclick: () => { const [x, y, yaw] = values(); this.publish(id, [x, y], (yaw * Math.PI) / 180); } }, TOOLS[id][2]);
    return h("details", { id: "publish-pose" }, h("summary", {}, "Publish a goal or a pose estimate"), h("div.pose", {}, fields.map(([, label]) => label)), h("div.row", {}, Object.keys(TOOLS).map(button)));
  }

  async publish(id, position, yaw) {
    try {
      const { topic, frame } = await this.page.connection.request("publish_pose", { as: id, position, yaw });
      this.page.toast(`${TOOLS[id][2]} published on ${topic} in ${frame}`, "good");
    } catch (error) {
      this.page.toast(error.message, "error");
    }
  }

  // The point of the ground under the pointer.
  #ground(event) {
    const ray = this.page.pick.aim(event);
    const world = ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 1, 0), 0), new THREE.Vector3());
    return world && this.page.viewport.viewer.scene.worldToLocal(world);
  }

  #down(event) {
    if (!(this.page.tools.held in TOOLS) || event.button !== 0 || this.drag) return;
    const from = this.#ground(event);
    if (!from) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.drag = { pointer: event.pointerId, from, yaw: 0 };
    this.page.viewport.pane.setPointerCapture(event.pointerId);
    this.page.viewport.viewer.controls.enabled = false;
    this.#show();
  }

  #move(event) {
    if (this.drag?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    const to = this.#ground(event);
    if (!to || to.distanceTo(this.drag.from) < LEAST) return;
    this.drag.yaw = Math.atan2(to.y - this.drag.from.y, to.x - this.drag.from.x);
    this.#show();
  }

  #up(event) {
    if (this.drag?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    const { from, yaw } = this.drag;
    const id = this.page.tools.held;
    this.page.tools.hold(null);
    this.publish(id, [from.x, from.y], yaw);
  }

  #show() {
    this.arrow.visible = true;
    this.arrow.position.copy(this.drag.from).setZ(0.05);
    this.arrow.setDirection(new THREE.Vector3(Math.cos(this.drag.yaw), Math.sin(this.drag.yaw), 0));
    this.page.viewport.dirty();
  }

  #end() {
    if (this.drag) this.page.viewport.viewer.controls.enabled = true;
    this.drag = null;
    this.arrow.visible = false;
    this.page.viewport.dirty();
  }
}

export function poseTools(page) {
  page.poseTools = new PoseTools(page);
}
