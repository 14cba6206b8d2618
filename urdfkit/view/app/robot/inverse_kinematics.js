// Dragging a link: inverse kinematics computes the joint positions for the pose of the handle, on the server if there is one.
/* global MeshCat */

import { check, h, short } from "../page/dom.js";
import { Gizmo, gizmoKeys } from "../handles/gizmo.js";
import { HandleDrag, screen } from "../handles/handle_drag.js";
import { LinkSolver } from "./link_solver.js";
import { LostMotions } from "./lost_motions.js";
import { SolutionChoice } from "./solution_choice.js";
import { compose } from "./pose.js";

const THREE = MeshCat.THREE;
const HAND = "M12 2v20M2 12h20M12 2l-3 3M12 2l3 3M12 22l-3-3M12 22l3-3M2 12l3-3M2 12l3 3M22 12l-3-3M22 12l-3 3";
const RESTARTS = 3; // additional starting points per move of the handle, without a server
const ALL = 40; // … and when the handle is released
const DISCRETE = 6; // joints from which a pose with its orientation has few solutions, a position alone infinitely many
const COMPILING = 1000; // ms until the server is queried again while it compiles the solver
const STEP = 0.01; // of an arrow key [m]
const SIZE = 0.14; // of the smaller of height and width of the viewport

export class Dragging {
  constructor(page) {
    this.page = page;
    this.viewer = page.viewport.viewer;
    this.gizmo = new Gizmo();
    this.lost = new LostMotions();
    this.viewer.scene.add(this.gizmo, this.lost);
    this.solver = new LinkSolver(page);
    this.choice = new SolutionChoice(page, (answered) => this.#solutions(answered));
    this.words = h("span.quiet", { id: "ik-lost" });
    this.drag = null;
    this.turn = false;
    this.free = false; // without collisions between links
    this.label = null;
    const { pane } = page.viewport;
    pane.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    pane.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"]) pane.addEventListener(end, (event) => this.#up(event), { capture: true });
    gizmoKeys(page, { active: () => this.gizmo.visible && !this.drag, step: STEP, moved: (by, turn) => this.#step(by, turn) });
    page.on("draw", () => this.#place());
    page.on("tool", () => this.show());
    page.on("select", () => this.show());
    page.on("robot", () => this.show());
    page.on("poses", () => this.gizmo.visible && page.viewport.dirty());
    page.on("joints", () => this.drag || this.#inspect());
  }

  /** The link with the handle: the selected link, if a joint moves it. */
  get link() {
    if (this.page.tools.held !== "ik" || !this.page.robot) return null;
    const { link, joint } = this.page.selected ?? {};
    const name = link ?? this.page.childOf(joint);
    return name && this.page.robot.kinematics.movers(name).length ? name : null;
  }

  show() {
    this.gizmo.visible = this.link !== null;
    this.gizmo.rings = this.turn;
    this.choice.clear();
    this.#showLost([]);
    this.#inspect();
    this.page.viewport.dirty();
  }

  // Request which motions the link loses in the present configuration.
  #inspect() {
    const { link, turn } = this;
    if (!link || !this.solver.ready) return;
    this.solver.request({ link, turn }, (answer) => {
      if (!answer) setTimeout(() => this.#inspect(), COMPILING);
      else if (link === this.link) this.#showLost(answer.lost);
    });
  }

  #showLost(motions) {
    this.words.textContent = motions.length ? `singular: no ${motions.map(({ words }) => words.replaceAll("`", "")).join(", no ")}` : "";
    if (this.link) {
      const scene = this.viewer.scene.getWorldQuaternion(new THREE.Quaternion());
      this.lost.show(motions, this.#root.getWorldQuaternion(new THREE.Quaternion()).premultiply(scene.invert()));
    }
    this.page.viewport.dirty();
  }

  #solutions(answered) {
    const { link, page } = this;
    const { kinematics } = page.robot;
    if (!this.solver.ready) return answered(null);
    const turn = this.turn || kinematics.movers(link).length >= DISCRETE;
    this.solver.request({ link, pose: kinematics.forward(page.values).get(link), turn, limits: !page.ignoreLimits, collision_free: this.free, all: true }, answered);
  }

  // The handle is at the frame of the link, or at the target while it is dragged; its size on the screen is constant.
  #place() {
    this.lost.visible = this.gizmo.visible && this.lost.children.length > 0;
    if (!this.gizmo.visible) return;
    const at = this.drag?.at ?? this.page.labels.at(this.link);
    if (!at) return;
    this.gizmo.position.copy(this.viewer.scene.worldToLocal(at.clone()));
    this.lost.position.copy(this.viewer.scene.worldToLocal(this.page.labels.at(this.link).clone()));
    const { camera } = this.viewer;
    const height = camera.isOrthographicCamera ? (2 * camera.userData.halfHeight) / camera.zoom : 2 * camera.position.distanceTo(at) * Math.tan((camera.fov * Math.PI) / 360);
    this.gizmo.scale.setScalar(SIZE * height * Math.min(1, this.page.viewport.aspect));
    this.lost.scale.copy(this.gizmo.scale);
  }

  #down(event) {
    if (!this.gizmo.visible || event.button !== 0 || this.drag) return;
    this.page.pick.aim(event);
    const handle = this.gizmo.hit(this.page.pick.ray);
    if (!handle) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.page.labels.tip(null);
    this.choice.clear();
    const { link, page } = this;
    const position = this.viewer.scene.worldToLocal(page.labels.at(link).clone());
    const [kind, axis] = handle.kind === "free" ? ["plane", screen(this.viewer)[2]] : [handle.kind, handle.axis];
    const motion = new HandleDrag(page, event, { kind, axis, position, turn: new THREE.Quaternion() });
    const pose = page.robot.kinematics.forward(page.values).get(link);
    this.drag = { motion, link, pose, at: motion.at, values: { ...page.values }, goal: null, tried: 0 };
  }

  #move(event) {
    if (!this.drag || event.pointerId !== this.drag.motion.pointer) return;
    event.stopImmediatePropagation();
    const { motion, pose } = this.drag;
    const moved = motion.pose(event);
    if (!moved) return;
    if (motion.kind === "about") this.drag.goal = [...pose.slice(0, 3), ...this.#turned(pose, motion.world, moved.angle)];
    else {
      this.drag.at = this.viewer.scene.localToWorld(moved.position);
      this.drag.goal = [...this.#inRoot(this.drag.at), ...pose.slice(3)];
    }
    this.#reach(this.drag, RESTARTS);
  }

  // A step of the handle by a key: x y z in the frame of the grid, and a turn about its z axis.
  #step(by, angle) {
    const { link, page } = this;
    const { scene } = this.viewer;
    this.choice.clear();
    const pose = page.robot.kinematics.forward(page.values).get(link);
    const at = scene.localToWorld(scene.worldToLocal(page.labels.at(link)).add(new THREE.Vector3(...by)));
    const up = new THREE.Vector3(0, 0, 1).transformDirection(scene.matrixWorld);
    const goal = [...this.#inRoot(at), ...this.#turned(pose, up, angle)];
    this.#reach({ link, values: { ...page.values }, goal, tried: 0, keyed: true }, ALL);
  }

  // Without a server there is time for a few starting points while the handle moves, different ones each time; on release, for all.
  #reach(drag, restarts) {
    const { page } = this;
    if (this.solver.ready) {
      const { link, goal } = drag;
      const values = { link, pose: goal, turn: this.turn, limits: !page.ignoreLimits, collision_free: this.free };
      this.solver.request(values, (answer) => (answer ? this.#take(drag, answer) : this.#reachHere(drag, restarts)));
    } else this.#reachHere(drag, restarts);
  }

  #take(drag, { solutions, collisions, position_error: error, rotation_error: turned, reason, lost }) {
    drag.reached = true; // there is nothing left to try
    if (!collisions.length) this.page.setJoints(solutions[0]);
    if (drag.link !== this.link) return;
    this.#report(drag, { error, turned, reason }, collisions);
    this.#showLost(lost);
  }

  #reachHere(drag, restarts) {
    const { page } = this;
    const found = page.robot.kinematics.inverse(drag.link, drag.goal, drag.values, { turn: this.turn, limits: !page.ignoreLimits, restarts, first: drag.tried });
    drag.reached = found.reached;
    drag.tried = found.reached ? 0 : drag.tried + restarts;
    Object.assign(drag.values, found.values);
    page.setJoints(found.values);
    this.#report(drag, found);
    page.viewport.dirty();
  }

  // The orientation of a pose in the root link, turned about an axis of the world.
  #turned(pose, axis, angle) {
    const local = axis.clone().transformDirection(this.#root.matrixWorld.clone().invert());
    const turn = new THREE.Quaternion().setFromAxisAngle(local, angle).toArray();
    return compose([0, 0, 0, ...turn], [0, 0, 0, ...pose.slice(3)]).slice(3);
  }

  get #root() {
    return this.page.scene.byLink.get(this.page.robot.kinematics.root);
  }

  #inRoot(world) {
    return this.#root.worldToLocal(world.clone()).toArray();
  }

  #report(drag, { error, turned, reason }, collisions = []) {
    if (this.drag !== drag && !drag.keyed) return;
    const cause = reason?.startsWith("limit") ? `: ${reason.replaceAll("`", "")}` : "";
    const far = error > 5e-4 ? `${short(1000 * error, 0)} mm out of reach` : turned > 5e-3 && this.turn ? `${short((turned * 180) / Math.PI, 0)}° out of reach` : "";
    const away = collisions.length ? `collision of ${collisions[0].join(" and ")}` : far && far + cause;
    if (drag.keyed) return away && this.page.toast(`${drag.link}: ${away}`, "warning");
    if (!away && this.label) this.#quiet();
    else if (away && !this.label) this.label = this.page.labels.add(h("span.measure-label"), () => this.drag?.at ?? null);
    if (this.label) this.label.textContent = away;
  }

  #quiet() {
    if (this.label) this.page.labels.remove(this.label);
    this.label = null;
  }

  #up(event) {
    if (!this.drag || event.pointerId !== this.drag.motion.pointer) return;
    event.stopImmediatePropagation();
    this.drag.motion.end();
    if (this.drag.goal && !this.drag.reached) {
      this.drag.tried = 0;
      this.#reach(this.drag, ALL);
    }
    this.drag = null;
    this.#quiet();
    this.page.viewport.dirty();
  }
}

export function ik(page) {
  const dragging = new Dragging(page);
  const hold = check("Keep the orientation, show rings", { id: "ik-turn", changed: (on) => ((dragging.turn = on), dragging.show()) });
  const free = check("Without collisions", { id: "ik-free", title: "only configurations in which no links collide", changed: (on) => ((dragging.free = on), dragging.choice.clear()) });
  const mapped = h("button", { type: "button", id: "ik-reach", title: "where the link can be placed, by cell of a grid", onclick: () => map() }, "Reach map");
  const map = () => page.connection.request("reach", { link: dragging.link }).then(
    ({ resolution }) => page.toast(`computing the reach map of ${dragging.link} in cells of ${resolution} m …`),
    ({ message }) => page.toast(message, "error"),
  );
  const strip = h("div#ik-strip", { hidden: true }, h("span.quiet"), hold.label, free.label, dragging.choice.element, mapped, dragging.words);
  document.getElementById("viewport").append(strip);
  page.tools.tool({ id: "ik", title: "Drag the selected link", icon: HAND, modes: ["view"], order: 40, clicks: false });
  page.shortcut({ key: "k", does: "drag the selected link", group: "Tools", run: () => page.tools.hold(page.tools.held === "ik" ? null : "ik") });
  const showHint = () => {
    strip.hidden = page.tools.held !== "ik";
    const name = page.selected?.link ?? page.selected?.joint;
    strip.firstChild.textContent = dragging.link ? `Drag the handle of ${dragging.link}, or press the arrow keys.` : name ? "No joint moves this link." : "Click the link to drag.";
    for (const part of [hold.label, free.label, dragging.choice.element, mapped]) part.hidden = !dragging.link;
    for (const part of [free.label, dragging.choice.element, mapped]) part.hidden ||= !dragging.solver.ready;
  };
  for (const event of ["tool", "select", "robot"]) page.on(event, showHint);
  page.expose("ik", dragging);
}
