// Camera modes: orbit, top down (orthographic), first person, follow; target frame and fixed frame.
/* global MeshCat */

import { h } from "../page/dom.js";
import { offer } from "../page/edited_fields.js";
import { FirstPerson } from "./first_person_camera.js";

const THREE = MeshCat.THREE;
const CAMERA = "M3 7h11v10H3zM14 11l7-4v10l-7-4";
const WAYS = [
  ["orbit", "Orbit", "o", "rotate around a point"],
  ["top", "Top down", "t", "orthographic view from above"],
  ["first", "First person", "p", "drag to look around; W A S D and Q E move"],
  ["follow", "Follow", "u", "behind the target frame, rotating with it"],
];
const SIDES = { Front: [1, 0, 0.02], Back: [-1, 0, 0.02], Left: [0, 1, 0.02], Right: [0, -1, 0.02], Above: [0.001, 0, 1], Oblique: [1, 0.75, 0.6] };

export class Cameras {
  constructor(page) {
    this.page = page;
    this.viewport = page.viewport;
    this.viewer = page.viewport.viewer;
    this.way = "orbit";
    this.target = ""; // a link; empty for none
    this.fixed = "";
    this.was = null; // position of the target in the last frame
    this.eye = { camera: this.viewer.camera, controls: this.viewer.controls };
    this.first = new FirstPerson(page, this.viewer.camera, this.viewer.controls);
    page.on("poses", () => this.#moved());
  }

  /** Whether the camera follows a frame. */
  get tracks() {
    return this.way === "follow" || this.#anchor !== "";
  }

  // In a simulation, whose ground and scans stay in the world, the camera moves with the fixed frame instead.
  get #turns() {
    return this.page.mode === "sim" && this.fixed !== "";
  }

  get #anchor() {
    return this.#turns ? this.fixed : this.target;
  }

  use(way) {
    if (way === this.way) return;
    const { camera, controls } = this.viewer;
    if (this.way === "top") this.#leaveTop(controls);
    this.first.use(false);
    this.way = way;
    if (way === "top") this.#fromAbove(camera, controls);
    if (way === "first") this.first.use(true);
    if (way === "follow") this.#behind();
    this.was = this.#stand();
    this.viewport.haze();
    this.viewport.dirty();
    this.page.emit("camera", way);
  }

  #fromAbove({ position }, { target }) {
    const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -500, 1000);
    camera.userData.halfHeight = position.distanceTo(target) * Math.tan((this.eye.camera.fov * Math.PI) / 360);
    camera.up.set(0, 0, -1); // x to the right, y up
    camera.position.copy(target).add(new THREE.Vector3(0, 10, 0));
    const controls = new this.eye.controls.constructor(camera, this.viewport.pane);
    Object.assign(controls, { enableRotate: false, enableKeys: false, screenSpacePanning: true });
    controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };
    controls.touches = { ONE: THREE.TOUCH.PAN, TWO: THREE.TOUCH.DOLLY_PAN };
    controls.target.copy(target);
    controls.addEventListener("change", () => this.viewport.dirty());
    this.eye.controls.enabled = false;
    Object.assign(this.viewer, { camera, controls });
    this.viewport.resize();
  }

  #leaveTop(controls) {
    const { camera: eye, controls: own } = this.eye;
    eye.position.add(controls.target.clone().sub(own.target));
    own.target.copy(controls.target);
    controls.dispose();
    own.enabled = true;
    Object.assign(this.viewer, this.eye);
    this.viewport.resize();
  }

  /** The link that is followed. */
  get followed() {
    const root = this.page.robot?.kinematics.root ?? [...this.page.scene.byLink.keys()][this.page.model?.root ?? 0];
    return this.page.scene.byLink.has(this.#anchor) ? this.#anchor : root;
  }

  // Position of the followed link in the world, and its yaw.
  #stand() {
    const node = this.page.scene.byLink.get(this.followed);
    if (!node) return null;
    node.updateWorldMatrix(true, false);
    const at = new THREE.Vector3().setFromMatrixPosition(node.matrixWorld);
    const ahead = new THREE.Vector3(1, 0, 0).transformDirection(node.matrixWorld);
    return { at, yaw: Math.atan2(-ahead.z, ahead.x) };
  }

  #behind() {
    const stand = this.#stand();
    if (!stand) return;
    const { camera, controls } = this.viewer;
    const away = 3.2 * this.viewport.radius;
    controls.target.copy(stand.at);
    camera.position.set(-Math.cos(stand.yaw) * away, 0.5 * away, Math.sin(stand.yaw) * away).add(stand.at);
  }

  // Keep the fixed frame in place, then follow the target.
  #moved() {
    this.#hold();
    if (!this.tracks) return (this.was = null);
    const now = this.#stand();
    const before = this.was;
    this.was = now;
    if (!now || !before || this.way === "first") return;
    if (now.at.distanceTo(before.at) < 1e-6 && Math.abs(now.yaw - before.yaw) < 1e-6) return (this.was = before);
    const { camera, controls } = this.viewer;
    const arm = camera.position.clone().sub(controls.target);
    if (this.way === "follow" || this.#turns) arm.applyAxisAngle(new THREE.Vector3(0, 1, 0), now.yaw - before.yaw);
    controls.target.add(now.at.clone().sub(before.at));
    camera.position.copy(controls.target).add(arm);
    this.viewport.dirty();
  }

  #hold() {
    if (this.page.mode === "sim") return;
    const robot = this.viewer.scene_tree.find(["robot"]).object;
    const node = this.page.scene.byLink.get(this.fixed);
    robot.quaternion.identity();
    robot.position.set(0, 0, 0);
    if (!node) return;
    robot.quaternion.copy(node.quaternion).invert();
    robot.position.copy(node.position).applyQuaternion(robot.quaternion).negate();
  }

  /** Set the fixed frame; empty for the root link. */
  fix(link) {
    this.fixed = link;
    this.#hold();
    this.was = this.#stand();
    this.viewport.dirty();
    this.page.emit("fixed", link);
  }

  /** Set the frame that the camera follows. */
  aim(link) {
    this.target = link;
    this.was = this.#stand();
    if (link) this.look(link);
  }

  /** Centre the view on a link, at a distance that fits it. */
  look(link) {
    const box = new THREE.Box3();
    for (const group of this.page.scene.shapes(link)) box.expandByObject(group);
    const size = box.isEmpty() ? 0.2 * this.viewport.radius : box.getSize(new THREE.Vector3()).length();
    const { camera, controls } = this.viewer;
    const at = box.isEmpty() ? this.page.labels.at(link) : box.getCenter(new THREE.Vector3());
    if (!at) return;
    const arm = camera.position.clone().sub(controls.target).setLength(Math.max(2.2 * size, 0.6 * this.viewport.radius));
    controls.target.copy(at);
    camera.position.copy(at).add(arm);
    this.viewport.haze();
    this.viewport.dirty();
  }
}

export function cameras(page) {
  page.cameras = new Cameras(page);
  page.expose("cameras", page.cameras);
  const panel = page.panels.add({ id: "camera", title: "View", icon: CAMERA, order: 60 });
  const ways = h("div.segments", { role: "radiogroup", "aria-label": "Camera" });
  for (const [way, words, key, does] of WAYS) {
    const input = h("input", { type: "radio", name: "camera", value: way, id: `camera-${way}`, checked: way === "orbit" });
    input.addEventListener("change", () => page.cameras.use(way));
    ways.append(h("label", { title: does }, input, h("span", {}, words)));
    page.shortcut({ key, does: `camera: ${words.toLowerCase()}, ${does}`, group: "View", run: () => input.click() });
  }
  const sides = h("div.chips", { role: "group", "aria-label": "Look from " });
  for (const [words, direction] of Object.entries(SIDES)) {
    sides.append(h("button.chip", { type: "button", onclick: () => page.viewport.fit(page.scene.bounds(), direction) }, words));
  }
  const target = frames("Target frame", "target-frame", (link) => page.cameras.aim(link));
  const fixed = frames("Fixed frame", "fixed-frame", (link) => page.cameras.fix(link));
  panel.body.append(h("h3", {}, "Camera"), ways, h("h3", {}, "Look from "), sides, h("div.frames", {}, target.label, fixed.label));
  page.on("robot", ({ kinematics }) => {
    target.fill(kinematics.links);
    fixed.fill(kinematics.links, page.mode === "sim" ? "the world" : "the root link");
  });
  page.viewPanel = panel;
}

function frames(words, id, chosen) {
  const select = h("select", { id });
  select.addEventListener("change", () => chosen(select.value));
  const label = h("label.stacked", {}, h("span", {}, words), select);
  function fill(links, none = "none") {
    const before = select.value;
    offer(select, [["", none], ...links.map((link) => [link, link])], () => select.value !== before && chosen(select.value));
  }
  return { label, fill };
}
