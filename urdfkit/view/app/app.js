// Entry point of the page: connects the WebSocket with the viewport, the panels and the features.

import { Connection } from "./connection/connection.js";
import { drawnBy } from "./viewport/graphics_device.js";
import { Page } from "./page/page.js";
import { Panels } from "./page/panels.js";
import { Scene } from "./viewport/scene_nodes.js";
import { simFeatures } from "./simulation/simulation_features.js";
import { Viewport } from "./viewport/viewport.js";
import { viewFeatures } from "./robot/robot_features.js";

const PROTOCOL = 3;
const $ = (id) => document.getElementById(id);

if (drawnBy === null) {
  $("fault").hidden = false;
  $("fault").textContent = "This browser does not support WebGL 2. Enable hardware acceleration in its settings, or use another browser.";
}

const viewport = new Viewport($("pane"));
const scene = new Scene(viewport);
const page = new Page(viewport, scene, new Panels($("panel"), $("rail")));
let root = 0;
let fitted = false;
let changed = false; // whether the robot has changed since the view was fitted
let touched = false; // whether the user has moved the camera
viewport.viewer.controls.addEventListener("start", () => (touched = true));

// For tests and the console; features add to it with page.expose.
Object.defineProperty(window, "urdfkit", { value: { page, viewport, scene, link: (index) => scene.nodes[index ?? root] } });

page.on("hello", (message) => {
  if (message.protocol !== PROTOCOL) return location.reload(); // the server has another version than this page
  if (page.mode !== null && page.mode !== message.mode) return location.reload(); // viewer and simulation follow each other
  page.mode = message.mode;
  page.settings = message;
  document.body.dataset.mode = message.mode;
  for (const element of document.querySelectorAll("[data-mode]:not(body)")) element.hidden = element.dataset.mode !== message.mode;
  page.panels.use(message.mode);
});
page.on("accepts", (message) => (page.requests = message.requests));
page.on("model", (message) => {
  if (!page.model || (page.mode === "sim" && page.model.name !== message.name)) fitted = false;
  changed = true;
  page.model = message;
  root = message.root;
  document.title = `${message.name} · urdfkit`;
  $("robot-name").textContent = message.name;
  scene.use(message);
});
page.on("teleop", () => {
  // Until now only the robot was shown, without its world.
  if (!document.body.dataset.running && !touched) fitted = false;
});
page.on("status", () => (document.body.dataset.running = true));
page.on("fault", (message) => {
  $("fault").hidden = !message.message;
  $("fault").textContent = message.message ?? "";
});
page.on("notice", (message) => page.toast(message.text, message.tone));

page.panels.changed = () => page.emit("panels", null);
for (const install of [...viewFeatures, ...simFeatures]) install(page);

page.connection = new (window.urdfkitConnection ?? Connection)({
  state(name, text) {
    $("state").dataset.state = name;
    $("state").textContent = text;
    if (name === "lost") page.emit("lost", null);
  },
  text: (message) => page.emit(message.type, message),
  command: (bytes) => scene.command(bytes),
  poses: (frame) => scene.poses(frame, applied),
  sensed: (frame) => page.emit("sensed", frame),
});
page.expose("connection", page.connection);

// In the viewer, a robot stands on the ground, wherever its root link is.
function stand() {
  if (page.mode !== "view") return;
  viewport.floor = scene.lowest();
  viewport.at(0, 0, 0, false);
}

function applied(sequence, time) {
  page.send("ack", { sequence });
  const followed = scene.nodes[page.followed ?? root]; // the driven robot
  const { x, y, z } = page.mode === "sim" && followed ? followed.position : { x: 0, y: 0, z: 0 };
  if (page.mode === "sim" || !fitted) viewport.at(x, y, z, page.mode === "sim" && page.following !== false && !page.cameras.tracks);
  page.emit("poses", time);
  if (!fitted) {
    fitted = true;
    scene.settled().then(async () => {
      const collision = document.getElementById("show-collision");
      if (scene.bare) {
        if (!collision.checked) collision.click();
        scene.restyle({ solid: true });
        await scene.settled();
      }
      stand();
      document.body.dataset.ready = page.fit();
    });
  } else if (changed && page.mode === "view") {
    scene.settled().then(() => {
      stand();
      if (viewport.outgrown(scene.bounds())) page.fit(null);
    });
  }
  changed = false;
  document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
}
