// Interactive markers: their handles are dragged, clicked, or moved by keys; each step is published as feedback.
/* global MeshCat */

import { gizmoKeys } from "../handles/gizmo.js";
import { HandleDrag, screen } from "../handles/handle_drag.js";
import { h } from "../page/dom.js";
import { refill } from "../page/edited_fields.js";

const THREE = MeshCat.THREE;
const TYPE = "visualization_msgs/msg/InteractiveMarkerUpdate";
const FEEDBACK = "visualization_msgs/msg/InteractiveMarkerFeedback";
const [POSE_UPDATE, MENU_SELECT, BUTTON_CLICK, MOUSE_DOWN, MOUSE_UP] = [1, 2, 3, 4, 5];
const BUTTON = 2;
const KINDS = { 3: "along", 4: "plane", 5: "about", 6: "plane", 7: "screen", 8: "turn", 9: "screen" }; // by interaction_mode
const SHIFTED = { 6: "about", 9: "turn" }; // with Shift
const FIXED = 1; // orientation_mode
const FACING = 2;
const STEP = 0.05; // m by an arrow key
const PATIENCE = 1000; // ms until the markers of a server that answered no pose are drawn where it has them
const NEAR = 1e-6; // greatest difference of the pose of an answer
const UP = new THREE.Vector3(0, 0, 1);

class InteractiveMarkers {
  constructor(page) {
    this.page = page;
    this.held = null; // {drag, display, group, control}
    this.awaited = null; // {display, name, pose}: the last pose that is published and not yet part of a message of the server
    this.queue = []; // feedback that is not yet sent: [topic, message]
    this.sending = false;
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    pane.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"]) pane.addEventListener(end, (event) => this.#up(event), { capture: true });
    const chosen = () => this.#group(document.activeElement?.dataset);
    gizmoKeys(page, { active: () => chosen() && !this.held, step: STEP, moved: (by, turn) => this.#step(chosen(), by, turn) });
    page.on("handles", (display) => this.#list(display));
  }

  /** Whether a message of a display waits: during a drag, and until the server has applied the last pose. */
  holds(display, groups) {
    if (this.held?.display === display) return true;
    if (this.awaited?.display !== display) return false;
    const { name, pose } = this.awaited;
    const marker = groups.map(({ items: [item] }) => item).find((item) => item.name === name);
    if (!marker || marker.pose.every((value, i) => Math.abs(value - pose[i]) < NEAR)) this.awaited = null;
    return this.awaited !== null;
  }

  // Draw the last message of the server, e.g. with a pose within its limits.
  #settle() {
    const { display } = this.awaited ?? {};
    this.awaited = null;
    display?.release();
  }

  // A recording has no server that reads feedback.
  get #publishes() {
    return this.page.accepts("publish");
  }

  get #shown() {
    return [...this.page.displays.all.values()].filter(({ type, options }) => type === TYPE && options.on);
  }

  #group({ display: topic, marker } = {}) {
    const display = marker && this.page.displays.all.get(topic);
    const groups = display?.drawn.at(-1)?.groups ?? [];
    const group = groups.map((each) => each.children[0]).find((each) => each.userData.marker.name === marker);
    return group && { display, group };
  }

  #down(event) {
    if (event.button !== 0 || this.held || this.page.tools.held || !this.#publishes) return;
    const roots = this.#shown.map(({ drawn }) => drawn.at(-1)?.root).filter(Boolean);
    if (!roots.length) return;
    for (const root of roots) root.updateWorldMatrix(true, true); // markers that arrived after the last frame
    this.page.pick.aim(event);
    for (const { object } of this.page.pick.ray.intersectObjects(roots, true)) {
      let part = object;
      while (part && !part.userData.control) part = part.parent;
      const control = part?.userData.control;
      if (!control || control.mode < BUTTON) continue;
      event.stopImmediatePropagation();
      event.preventDefault();
      this.page.labels.tip(null);
      const display = this.page.displays.all.get(object.userData.display);
      return this.#begin(event, display, part.parent, control);
    }
  }

  #begin(event, display, group, control) {
    if (control.mode === BUTTON) return this.#send(display, group, control.name, BUTTON_CLICK);
    const { viewer } = this.page.viewport;
    const { position, turn } = inGrid(group, viewer.scene);
    const kind = (event.shiftKey && SHIFTED[control.mode]) || KINDS[control.mode];
    const own = new THREE.Quaternion(...control.turn);
    const [, , towards] = screen(viewer);
    const frame = control.orientation === FIXED ? inGrid(group.parent, viewer.scene).turn : turn;
    const facing = kind === "screen" || control.orientation === FACING;
    const axis = facing ? towards : new THREE.Vector3(1, 0, 0).applyQuaternion(own).applyQuaternion(frame);
    const drag = new HandleDrag(this.page, event, { kind: kind === "screen" ? "plane" : kind, axis: kind === "turn" ? null : axis, position, turn });
    this.held = { drag, display, group, control };
    this.#send(display, group, control.name, MOUSE_DOWN);
  }

  #move(event) {
    const { drag, display, group, control } = this.held ?? {};
    if (drag?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    const pose = drag.pose(event);
    if (!pose) return;
    this.#place(group, pose);
    this.#send(display, group, control.name, POSE_UPDATE);
  }

  #up(event) {
    const { drag, display, group, control } = this.held ?? {};
    if (drag?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    drag.end();
    this.held = null;
    this.#send(display, group, control.name, MOUSE_UP);
    display.release();
  }

  #step({ display, group }, by, angle) {
    const { position, turn } = inGrid(group, this.page.viewport.viewer.scene);
    const about = new THREE.Quaternion().setFromAxisAngle(UP, angle);
    this.#place(group, { position: position.add(new THREE.Vector3(...by)), turn: about.multiply(turn) });
    this.#send(display, group, "", POSE_UPDATE);
  }

  // Move a marker to a pose in the frame of the grid.
  #place(group, { position, turn }) {
    const frame = inGrid(group.parent, this.page.viewport.viewer.scene);
    const back = frame.turn.invert();
    group.position.copy(position).sub(frame.position).applyQuaternion(back);
    group.quaternion.copy(back.multiply(turn));
    group.userData.marker.pose = [...group.position.toArray(), ...group.quaternion.toArray()];
    group.userData.settle();
    this.page.viewport.dirty();
  }

  // Poses that follow each other quickly are sent when the one before is answered.
  async #send(display, group, control, event, entry = 0) {
    const { name, frame, pose } = group.userData.marker;
    const vector = (values) => ({ x: values[0], y: values[1], z: values[2] });
    const message = {
      header: { frame_id: frame }, client_id: "urdfkit", marker_name: name, control_name: control, event_type: event, menu_entry_id: entry,
      pose: { position: vector(pose), orientation: { ...vector(pose.slice(3)), w: pose[6] } },
    };
    const topic = `${display.topic.replace(/\/[^/]*$/, "")}/feedback`;
    const last = this.queue.at(-1)?.[1];
    if (event === POSE_UPDATE && last?.event_type === event && last.marker_name === name) this.queue.pop();
    this.queue.push([topic, message]);
    if (event === POSE_UPDATE) this.awaited = { display, name, pose };
    clearTimeout(this.timer);
    if (this.sending) return;
    this.sending = true;
    try {
      while (this.queue.length) {
        const [to, next] = this.queue.shift();
        await this.page.connection.request("publish", { topic: to, type: FEEDBACK, message: next });
      }
    } catch (error) {
      this.queue = [];
      this.page.toast(error.message, "error");
    } finally {
      this.sending = false;
      this.timer = setTimeout(() => this.#settle(), PATIENCE);
    }
  }

  // A button for each marker, to move it by the arrow keys, with those of its controls and its menu.
  #list(display) {
    const groups = display.drawn.at(-1)?.groups.map((each) => each.children[0]) ?? [];
    const markers = groups.map(({ userData }) => userData.marker);
    const signature = JSON.stringify(markers.map(({ name, menu, controls }) => [name, menu, controls.map((each) => [each.name, each.mode])]));
    if (!this.#publishes || signature === display.handles.dataset.markers) return;
    display.handles.dataset.markers = signature;
    const press = (words, marker, ...rest) => h("button.quiet", { type: "button", onclick: () => this.#send(display, this.#group({ display: display.topic, marker }).group, ...rest) }, words);
    refill(display.handles, markers.map(({ name, menu, controls }) => {
      const moves = controls.some(({ mode }) => mode in KINDS);
      const keys = h("button.quiet", { type: "button", "data-display": display.topic, "data-marker": name, title: "Arrow keys move it, with Shift up, down and about z" }, `Move ${name}`);
      const buttons = controls.filter(({ mode }) => mode === BUTTON).map((each) => press(each.name || "Click", name, each.name, BUTTON_CLICK));
      return h("div.row", { role: "group", "aria-label": name }, moves && keys, buttons, menu.map(([id, title]) => press(title, name, "", MENU_SELECT, id)));
    }));
  }
}

// Position and orientation of an object in the frame of the grid.
function inGrid(object, scene) {
  object.updateWorldMatrix(true, false);
  const [position, turn] = [new THREE.Vector3(), new THREE.Quaternion()];
  scene.matrixWorld.clone().invert().multiply(object.matrixWorld).decompose(position, turn, new THREE.Vector3());
  return { position, turn };
}

export function interactiveMarkers(page) {
  page.interactive = new InteractiveMarkers(page);
}
