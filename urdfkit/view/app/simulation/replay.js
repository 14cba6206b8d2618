// Recording and replay: motion is recorded in memory, topics in an MCAP file.

import { check, h, icon } from "../page/dom.js";

const RECORD = "M5 5h14v14H5zM12 9a3 3 0 1 0 0 6a3 3 0 0 0 0-6z";
const PLAY = "M8 5l11 7-11 7z";
const PAUSE = "M8 5v14M16 5v14";

export function recorder(page) {
  const panel = page.panels.add({ id: "recorder", title: "Record", icon: RECORD, modes: ["sim"], order: 28 });
  const showError = (error) => page.toast(error.message, "error");
  const request = (name, values) => page.connection.request(name, values).catch(showError);
  const topics = check("Record topics to an MCAP file", { id: "record-topics", changed: (on) => (pictures.label.hidden = !on) });
  const pictures = check("Include images and point clouds", { id: "record-pictures", title: "Every image is recorded in full size, which can be slower than real time" });
  pictures.label.classList.add("inside");
  pictures.label.hidden = true;
  const record = h("button.wide.record", { type: "button", id: "record", "aria-pressed": "false" }, "Record");
  const words = h("p.quiet", { role: "status", id: "recorder-state" }, "No recording.");
  const slider = h("input", { type: "range", id: "replay-at", min: 0, max: 1, step: "any", value: 0, "aria-label": "Time in the recording" });
  const play = h("button", { type: "button", id: "replay-play" });
  const speed = h("select", { id: "replay-speed", "aria-label": "Replay speed" }, ...[0.1, 0.25, 0.5, 1, 2, 5].map((x) => h("option", { value: x, selected: x === 1 }, `×${x}`)));
  const end = h("button", { type: "button", id: "replay-end" }, "End the replay");
  const replay = h("div.replay", { hidden: true }, h("h3", {}, "Replay"), slider, h("div.row", {}, play, speed, h("span.space"), end));
  const banner = h("p", { id: "replaying", role: "status", hidden: true }, "Replay: the simulation is paused");
  document.getElementById("viewport").append(banner);
  panel.body.append(record, topics.label, pictures.label, words, replay);
  let state = { recording: false, frames: 0 };
  let grabbed = false;

  record.addEventListener("click", () => {
    if (!state.recording) return request("record", { on: true, topics: topics.box.checked, pictures: pictures.box.checked });
    return request("record", { on: false }).then((done) => {
      if (done?.messages) page.toast(done.file ? `${done.messages} messages in ${done.file}` : `${done.messages} messages, ${(done.bytes / 1e6).toFixed(1)} MB`, "good");
    });
  });
  slider.addEventListener("input", () => request("replay", { action: "show", at: slider.valueAsNumber }));
  slider.addEventListener("pointerdown", () => (grabbed = true));
  for (const name of ["pointerup", "change"]) slider.addEventListener(name, () => (grabbed = false));
  play.addEventListener("click", () => request("replay", { action: state.running ? "pause" : "play", speed: Number(speed.value) }));
  speed.addEventListener("change", () => state.running && request("replay", { action: "play", speed: Number(speed.value) }));
  end.addEventListener("click", () => request("replay", { action: "end" }));

  // The page shows a file and no simulation.
  function ofFile(name) {
    if (document.body.dataset.recording === name) return;
    document.body.dataset.recording = name;
    for (const part of [record, topics.label, pictures.label, end]) part.hidden = true;
    banner.textContent = `Replay of ${name}`;
    panel.button.children[1].textContent = "Replay";
    panel.button.title = panel.section.querySelector("h2").textContent = "Replay";
    page.panels.open("recorder");
  }

  page.on("recorder", (message) => {
    state = message;
    if (message.file) ofFile(message.file);
    const length = message.end - message.begin;
    record.textContent = message.recording ? "Stop" : "Record";
    record.setAttribute("aria-pressed", message.recording);
    topics.box.disabled = pictures.box.disabled = message.recording;
    panel.badge(message.recording ? "●" : null, "error");
    words.textContent = message.recording
      ? `Recording: ${length.toFixed(1)} s${message.topics ? ", with topics" : ""}.`
      : message.file ? `${message.frames} messages in ${length.toFixed(1)} s.`
      : message.frames ? `${length.toFixed(1)} s recorded.` : "No recording.";
    replay.hidden = message.recording || !message.frames;
    Object.assign(slider, { min: message.begin, max: message.end });
    if (!grabbed) slider.value = message.playing ? message.at : message.end;
    play.replaceChildren(icon(message.running ? PAUSE : PLAY), message.running ? "Pause" : "Play");
    end.disabled = !message.playing;
    banner.hidden = !message.playing;
    document.body.toggleAttribute("data-replay", Boolean(message.playing));
  });
}
