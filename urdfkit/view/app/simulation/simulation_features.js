// Features of a simulation's page, in the order of their installation.

import { arms } from "./controller_sliders.js";
import { displays } from "../displays/displays_panel.js";
import { interactiveMarkers } from "../displays/interactive_markers.js";
import { poseTools } from "../displays/pose_tools.js";
import { layout } from "../page/layout.js";
import { availability } from "../page/availability.js";
import { arrows } from "./contact_arrows.js";
import { clock } from "./clock_controls.js";
import { Drive } from "./teleop.js";
import { objects } from "./world_objects.js";
import { plots } from "../topics/plots_panel.js";
import { push } from "./pushing.js";
import { liveParameters } from "./live_parameters.js";
import { Sensors } from "./sensor_views.js";
import { chooser, gamepad, steering } from "./drive_sliders.js";
import { recorder } from "./replay.js";
import { topics } from "../topics/topic_list.js";
import { trails } from "./odometry_trail.js";
import { walls } from "./wall_drawing.js";
import { h } from "../page/dom.js";

const $ = (id) => document.getElementById(id);
const WHEEL = "M12 3a9 9 0 1 0 0 18a9 9 0 0 0 0-18zM12 10a2 2 0 1 0 0 4a2 2 0 0 0 0-4zM3.5 10l6.5 1M20.5 10l-6.5 1M12 14v7";
const EYE = "M2 12s4-7 10-7 10 7 10 7-4 7-10 7-10-7-10-7zM12 9a3 3 0 1 0 0 6a3 3 0 0 0 0-6z";

export const simFeatures = [common, drive, clock, availability, sensing, arms, topics, plots, recorder, objects, walls, liveParameters, push, arrows, trails, displays, interactiveMarkers, poseTools, layout];

function common(page) {
  const watched = new Set();
  /** Subscribe to a key while a panel is open. */
  page.whileOpen = (panel, key) => {
    const name = `${panel.id} ${key}`;
    if (watched.has(name)) return;
    watched.add(name);
    let wanted = false;
    const look = () => {
      if (panel.open === wanted) return;
      wanted = panel.open;
      page.connection.subscribe(key, wanted);
    };
    new MutationObserver(look).observe(panel.section, { attributes: true, attributeFilter: ["hidden"] });
    look();
  };
}

function drive(page) {
  page.panels.add({ id: "drive", title: "Drive", icon: WHEEL, modes: ["sim"], order: 10, element: $("drive-section"), pinned: true });
  const wheel = new Drive((held) => page.connection.drive(held), () => $("pause").click(), () => page.send("control", { action: "stop" }));
  const more = h("details", { id: "steering" }, h("summary", {}, "Drive sliders and gamepad"));
  $("keys").before(more);
  chooser(page, wheel, $("drive-section"));
  steering(page, wheel, more);
  gamepad(page, wheel, more);
  page.on("teleop", (message) => {
    page.drives = message.drives;
    if (message.drives) wheel.use(message);
    page.panels.available("drive", message.drives);
    $("pad").hidden = !message.drives || page.mode !== "sim";
  });
  for (const event of ["lost", "stop"]) page.on(event, () => wheel.release());
  page.expose("drive", wheel);
}

function sensing(page) {
  page.panels.add({ id: "sensors", title: "Sensors", icon: EYE, modes: ["sim"], order: 20, element: $("sensor-section"), pinned: true });
  page.panels.available("sensors", false);
  const sensors = new Sensors(page, $("sensors"));
  page.on("sensors", (message) => {
    sensors.use(message.sensors);
    page.panels.available("sensors", message.sensors.length > 0);
    // Images offer the topics that can be drawn over them.
    if (message.sensors.some(({ picture }) => picture)) page.whileOpen(page.panels.all.get("sensors"), "topics");
  });
  page.on("sensed", (frame) => sensors.frame(frame));
  page.expose("sensors", sensors);
}
