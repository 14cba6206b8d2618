// Switches the controls off, with the reason, while they have no effect: no connection, no response, another driver.
// Hides panels, tools and controls of requests that the server does not accept: those of a recording or a live robot.

const NEEDS = {
  panels: { world: "spawn", physics: "gravity", push: "push", recorder: "replay" },
  tools: { push: "push", place: "spawn", walls: "walls", goal: "publish_pose", estimate: "publish_pose", point: "publish" },
  controls: { pause: "speed", "key-pause": "speed", reset: "speed", factor: "speed", "publish-pose": "publish_pose", "publish-point": "publish", "publish-new": "publish" },
};
const CONTROLS = [".transport", "#pad", "#drive-section"];
const RESPONSE = 1500; // ms without a status message after which the simulation counts as not responding
const INPUT = 500; // ms of input without becoming the driver after which the input counts as interrupted

export function availability(page) {
  const line = document.getElementById("driver-other");
  let me = null;
  let lost = false;
  let received = null; // time of the last status message
  let driver = null;
  let sending = null; // time since which this page sends input
  let silent = 0; // checks in a row without a status message; after a slow frame, the first runs before waiting messages
  function reason() {
    if (page.mode !== "sim") return null;
    if (lost) return ["off", "No connection: the controls are switched off. The robot has stopped if this page drove it."];
    if (silent > 1) {
      return ["off", "The simulation does not respond: the controls are switched off."];
    }
    if (driver !== null && driver !== me) return ["watch", "Another page is driving."];
    if (sending !== null && driver === null && performance.now() - sending > INPUT) {
      return ["watch", "Your input does not arrive in time: the robot has stopped."];
    }
    return null;
  }
  function update() {
    const [state, text] = reason() ?? ["on", ""];
    document.body.dataset.controls = state;
    line.hidden = state === "on";
    if (line.textContent !== text) line.textContent = text;
    for (const selector of CONTROLS) for (const part of document.querySelectorAll(selector)) part.inert = state === "off";
    if (state === "off" && window.urdfkit.drive?.timer != null) window.urdfkit.drive.release();
  }
  page.on("accepts", () => {
    for (const [id, request] of Object.entries(NEEDS.panels)) page.panels.available(id, page.accepts(request));
    for (const [id, request] of Object.entries(NEEDS.tools)) if (!page.accepts(request)) page.tools.buttons.get(id).button.dataset.modes = "";
    for (const [id, request] of Object.entries(NEEDS.controls)) document.getElementById(id).hidden = !page.accepts(request);
    page.tools.offer();
  });
  page.on("you", (message) => {
    me = message.client;
    lost = false;
    received = driver = null;
    silent = 0;
    update();
  });
  page.on("lost", () => {
    lost = true;
    update();
  });
  page.on("status", (message) => {
    received = performance.now();
    silent = 0;
    driver = message.driver;
    if (window.urdfkit.drive?.timer == null || driver === me) sending = null;
    else sending ??= received;
    update();
  });
  setInterval(() => {
    silent = received !== null && !document.hidden && performance.now() - received > RESPONSE ? silent + 1 : 0;
    update();
  }, 250);
}
