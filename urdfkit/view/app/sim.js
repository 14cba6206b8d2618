// The simulation's part of the page: the wheel, the clock, what sensors see.

import { fixed } from "./dom.js";
import { Drive } from "./drive.js";
import { Sensors } from "./sensors.js";

const $ = (id) => document.getElementById(id);
const WHEEL = "M12 3a9 9 0 1 0 0 18a9 9 0 0 0 0-18zM12 10a2 2 0 1 0 0 4a2 2 0 0 0 0-4zM3.5 10l6.5 1M20.5 10l-6.5 1M12 14v7";
const EYE = "M2 12s4-7 10-7 10 7 10 7-4 7-10 7-10-7-10-7zM12 9a3 3 0 1 0 0 6a3 3 0 0 0 0-6z";

/** Everything the simulation adds to the page. */
export const simFeatures = [drive, clock, sensing];

function drive(page) {
  page.panels.add({ id: "drive", title: "Drive", icon: WHEEL, modes: ["sim"], order: 10, element: $("drive-section"), pinned: true });
  const wheel = new Drive((held) => page.send("axes", held), () => $("pause").click());
  page.on("teleop", (message) => {
    if (message.drives) wheel.use(message);
    page.panels.available("drive", message.drives);
    if (!message.drives) $("pad").hidden = true;
  });
  page.on("lost", () => wheel.release());
  page.expose("drive", wheel);
}

function clock(page) {
  let me = null;
  page.on("you", (message) => (me = message.client));
  page.on("status", (message) => {
    page.pose = message.pose;
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
  });
  $("reset").addEventListener("click", () => page.send("control", { action: "reset" }));
  $("pause").addEventListener("click", () => {
    const paused = $("pause").getAttribute("aria-pressed") === "true";
    page.send("control", { action: paused ? "play" : "pause" });
  });
}

function sensing(page) {
  page.panels.add({ id: "sensors", title: "Sensors", icon: EYE, modes: ["sim"], order: 20, element: $("sensor-section"), pinned: true });
  page.panels.available("sensors", false);
  const sensors = new Sensors(page, $("sensors"));
  page.on("sensors", (message) => {
    sensors.use(message.sensors);
    page.panels.available("sensors", message.sensors.length > 0);
    if (message.sensors.length && !page.panels.narrow.matches) page.panels.open("sensors");
  });
  page.on("sensed", (frame) => sensors.frame(frame));
  page.expose("sensors", sensors);
}
