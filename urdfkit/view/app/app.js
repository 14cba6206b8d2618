// Wires the page together: connection ↔ stage, panels, wheel.

import { Connection } from "./connection.js";
import { Drive } from "./drive.js";
import { Joints } from "./joints.js";
import { Scene } from "./scene.js";
import { Sensors } from "./sensors.js";
import { Stage } from "./stage.js";

const PROTOCOL = 1;
const $ = (id) => document.getElementById(id);

if (!document.createElement("canvas").getContext("webgl2")) {
  $("fault").hidden = false;
  $("fault").textContent = "This browser shows no 3-D graphics (WebGL 2): turn on hardware acceleration in its settings, or try another one.";
}

const stage = new Stage($("pane"));
const scene = new Scene(stage);
const sensors = new Sensors(stage);
const joints = new Joints((positions) => connection.send("joints", { positions }));
const drive = new Drive((held) => connection.send("axes", held), () => $("pause").click());
let mode = null;
let me = null;
let robot = null;
let root = 0;
let fitted = false;

const on = {
  hello(message) {
    if (message.protocol !== PROTOCOL) return location.reload(); // the server is of another version than this page
    mode = message.mode;
    for (const element of document.querySelectorAll("[data-mode]")) element.hidden = element.dataset.mode !== mode;
  },
  teleop(message) {
    if (message.drives) drive.use(message);
    else for (const element of [$("drive-section"), $("pad")]) element.hidden = true;
  },
  you(message) {
    me = message.client;
  },
  model(message) {
    const another = robot !== message.name;
    robot = message.name;
    root = message.root;
    document.title = `${robot} · urdfkit`;
    $("robot-name").textContent = robot;
    scene.use(message);
    joints.show(mode === "view" ? message.joints : []);
    if (another) fitted = false;
  },
  sensors(message) {
    sensors.use(message.sensors);
  },
  joints(message) {
    joints.update(message.positions);
  },
  fault(message) {
    $("fault").hidden = !message.message;
    $("fault").textContent = message.message ?? "";
  },
  progress(message) {
    $("progress").hidden = !message.label;
    $("progress-label").textContent = message.label ?? "";
  },
  status(message) {
    $("sim-time").textContent = `${message.time.toFixed(1)} s`;
    $("rtf").textContent = message.paused ? "paused" : `×${message.real_time_factor.toFixed(2)}`;
    const { x, y, yaw } = message.pose;
    $("position").textContent = `${fixed(x, 2)}, ${fixed(y, 2)} m`;
    $("heading").textContent = `${fixed((yaw * 180) / Math.PI, 0)}°`;
    $("velocity").textContent = `${fixed(message.speed, 2)} m/s`;
    $("pause").querySelector("span").textContent = message.paused ? "Go on" : "Pause";
    $("pause").setAttribute("aria-pressed", message.paused);
    const other = message.driver !== null && message.driver !== me;
    document.body.dataset.watching = other;
    $("driver-other").hidden = !other;
  },
};

const connection = new Connection({
  state(name, text) {
    $("state").dataset.state = name;
    $("state").textContent = text;
    if (name === "lost") drive.release();
  },
  text(message) {
    on[message.type]?.(message);
  },
  command: (bytes) => scene.command(bytes),
  poses: (frame) => scene.poses(frame, applied),
  sensed: (frame) => sensors.frame(frame),
});

function applied(sequence) {
  connection.send("ack", { sequence });
  if (mode === "sim" && scene.nodes[root]) {
    const { x, y, z } = scene.nodes[root].position;
    stage.at(x, y, z, $("follow").checked);
  } else if (!fitted) {
    stage.at(0, 0, 0, false);
  }
  if (!fitted) {
    fitted = true;
    scene.settled().then(fit);
  }
  document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
}

// Like toFixed, but nothing is minus zero.
function fixed(value, digits) {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

function fit() {
  // In the simulation from behind, so that forward is away from the driver and left is left.
  const done = mode === "sim" ? stage.fit(scene.robot, [-1, -0.55, 0.75], 1.9) : stage.fit(scene.robot, [1, 0.75, 0.6]);
  document.body.dataset.ready = done;
}

for (const role of ["visual", "collision"]) {
  $(`show-${role}`).addEventListener("change", (event) => scene.show(role, event.target.checked));
}
$("show-grid").addEventListener("change", (event) => stage.visible("Grid", event.target.checked));
$("show-axes").addEventListener("change", (event) => stage.visible("Axes", event.target.checked));
$("home").addEventListener("click", fit);
$("reset").addEventListener("click", () => connection.send("control", { action: "reset" }));
$("pause").addEventListener("click", () => {
  const paused = $("pause").getAttribute("aria-pressed") === "true";
  connection.send("control", { action: paused ? "play" : "pause" });
});
$("panel-toggle").addEventListener("click", () => panel("closed" in $("panel").dataset));

function panel(open) {
  $("panel").toggleAttribute("data-closed", !open);
  $("panel-toggle").setAttribute("aria-expanded", open);
}
if (matchMedia("(max-width: 760px)").matches) panel(false);

// For tests and for the curious at the console.
Object.defineProperty(window, "urdfkit", {
  value: { stage, scene, sensors, joints, drive, connection, link: (index) => scene.nodes[index ?? root] },
});
