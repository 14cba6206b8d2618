// Time controls: pause, step, speed and reset, and the readout of the state.

import { fixed, h, icon } from "../page/dom.js";
import { edited } from "../page/edited_fields.js";
import { numberField } from "../page/number_field.js";

const $ = (id) => document.getElementById(id);
const STEP = "M6 5v14l8-7zM17 5v14";
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];

export function clock(page) {
  let me = null;
  const showError = (error) => page.toast(error.message, "error");
  const steps = numberField({ id: "steps", min: 1, max: 10000, step: 1, whole: true, value: 1, "aria-label": "Steps", title: "Steps" });
  const step = h("button", { type: "button", id: "step", title: "Step N steps", "aria-label": "Step", hidden: true }, icon(STEP), h("span", {}, "Step"));
  const speed = h("select", { id: "factor", "aria-label": "Simulation speed", title: "Simulation speed" });
  speed.append(...SPEEDS.map((factor) => h("option", { value: factor, selected: factor === 1 }, `×${factor}`)), h("option", { value: "" }, "max"));
  steps.hidden = true;
  $("reset").before(steps, step);
  $("pause").before(speed);
  step.addEventListener("click", () => {
    page.connection.request("step", { steps: steps.valueAsNumber || 1 }).catch(showError);
  });
  speed.addEventListener("change", () => {
    page.connection.request("speed", speed.value ? { factor: Number(speed.value) } : {}).catch(showError);
    speed.blur();
  });
  // For a robot with a fixed base: the position of its last link.
  function tip(link) {
    const node = page.scene.byLink.get(link);
    $("tip-row").hidden = !node;
    if (!node) return;
    const at = node.position;
    $("tip-name").textContent = link;
    $("tip-name").title = `position of the frame ${link}`;
    $("tip-at").textContent = `${fixed(at.x, 3)}, ${fixed(at.y, 3)}, ${fixed(at.z, 3)} m`;
  }
  // During a replay: the recorded state at that time.
  let replays = false;
  function replay(time) {
    const node = page.scene.nodes[page.followed ?? page.model.root];
    if (!node) return;
    const { x: i, y: j, z: k, w } = node.quaternion;
    const yaw = Math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k));
    page.pose = { x: node.position.x, y: node.position.y, yaw };
    place(page.pose);
    tip(document.querySelector("#readout [data-base]").hidden ? page.status.tip : null);
    $("sim-time").textContent = `${time.toFixed(1)} s`;
    $("rtf").textContent = "replay";
    $("rtf").title = `the simulation is paused at ${page.status.time.toFixed(1)} s`;
    $("velocity").textContent = "–";
  }
  function place({ x, y, yaw }) {
    $("position").textContent = `${fixed(x, 2)}, ${fixed(y, 2)} m`;
    $("heading").textContent = `${fixed((yaw * 180) / Math.PI, 0)}°`;
  }
  function now(message, fixedBase) {
    page.pose = message.robots[page.driven] ?? message.pose;
    place(page.pose);
    tip(fixedBase ? message.tip : null);
    const quick = message.robots[page.driven]?.speed ?? message.speed;
    $("sim-time").textContent = `${message.time.toFixed(message.paused ? 3 : 1)} s`;
    $("rtf").textContent = message.paused ? "paused" : `×${message.real_time_factor.toFixed(2)}`;
    $("rtf").title = message.factor === null ? "as fast as possible" : `target: ×${message.factor}`;
    $("velocity").textContent = `${fixed(quick, 2)} m/s`;
  }
  page.on("recorder", (message) => (replays = Boolean(message.playing)));
  page.on("poses", (time) => replays && page.status && replay(time));
  page.on("you", (message) => (me = message.client));
  page.on("status", (message) => {
    page.status = message;
    const fixedBase = message.fixed && !(page.driven in message.robots && page.followed !== undefined);
    for (const row of document.querySelectorAll("#readout [data-base]")) row.hidden = fixedBase;
    if (!replays) now(message, fixedBase);
    $("pause").querySelector("span").textContent = message.paused ? "Continue" : "Pause";
    $("pause").setAttribute("aria-label", message.paused ? "Continue" : "Pause");
    $("pause").setAttribute("aria-pressed", message.paused);
    step.hidden = steps.hidden = !message.paused || !page.accepts("step");
    if (!edited(speed)) speed.value = message.factor ?? "";
    const other = message.driver !== null && message.driver !== me;
    document.body.dataset.watching = other;
    const permitted = (permission) => !other || (page.settings.watchers_may ?? []).includes(permission);
    for (const control of [$("pause"), steps, step, speed]) control.disabled = !permitted("pause");
    $("reset").disabled = !permitted("reset");
  });
  $("reset").addEventListener("click", () => page.send("control", { action: "reset" }));
  $("pause").addEventListener("click", () => {
    const paused = $("pause").getAttribute("aria-pressed") === "true";
    page.send("control", { action: paused ? "play" : "pause" });
  });
}
