// Recording and replay: the motion in memory, every topic as MCAP.

import { check, h, icon } from "../page/dom.js";

const TAPE = "M5 5h14v14H5zM12 9a3 3 0 1 0 0 6a3 3 0 0 0 0-6z";
const PLAY = "M8 5l11 7-11 7z";
const PAUSE = "M8 5v14M16 5v14";

export function tape(page) {
  const panel = page.panels.add({ id: "tape", title: "Record", icon: TAPE, modes: ["sim"], order: 28 });
  const say = (error) => page.toast(error.message, "error");
  const order = (name, values) => page.connection.order(name, values).catch(say);
  const topics = check("and topics, as an MCAP file", { id: "record-topics", changed: (on) => (pictures.label.hidden = !on) });
  const pictures = check("pictures and clouds too", { id: "record-pictures", title: "Every picture is taken in full size then: this can be slower than real time" });
  pictures.label.classList.add("inside");
  pictures.label.hidden = true;
  const record = h("button.wide.record", { type: "button", id: "record", "aria-pressed": "false" }, "Record");
  const words = h("p.quiet", { role: "status", id: "tape-words" }, "Nothing recorded yet.");
  const slider = h("input", { type: "range", id: "replay-at", min: 0, max: 1, step: "any", value: 0, "aria-label": "Place on the recording" });
  const play = h("button", { type: "button", id: "replay-play" });
  const speed = h("select", { id: "replay-speed", "aria-label": "Speed of the replay" }, ...[0.1, 0.25, 0.5, 1, 2, 5].map((x) => h("option", { value: x, selected: x === 1 }, `×${x}`)));
  const end = h("button", { type: "button", id: "replay-end" }, "Back to now");
  const replay = h("div.replay", { hidden: true }, h("h3", {}, "Replay"), slider, h("div.row", {}, play, speed, h("span.space"), end));
  const banner = h("p", { id: "replaying", role: "status", hidden: true }, "Replay: the simulation waits");
  document.getElementById("stage").append(banner);
  panel.body.append(record, topics.label, pictures.label, words, replay);
  let state = { recording: false, frames: 0 };
  let grabbed = false;

  record.addEventListener("click", () => {
    if (!state.recording) return order("record", { on: true, topics: topics.box.checked, pictures: pictures.box.checked });
    return order("record", { on: false }).then((done) => {
      if (done?.messages) page.toast(done.file ? `${done.messages} messages in ${done.file}` : `${done.messages} messages, ${(done.bytes / 1e6).toFixed(1)} MB`, "good");
    });
  });
  slider.addEventListener("input", () => order("replay", { action: "show", at: slider.valueAsNumber }));
  slider.addEventListener("pointerdown", () => (grabbed = true));
  for (const name of ["pointerup", "change"]) slider.addEventListener(name, () => (grabbed = false));
  play.addEventListener("click", () => order("replay", { action: state.running ? "pause" : "play", speed: Number(speed.value) }));
  speed.addEventListener("change", () => state.running && order("replay", { action: "play", speed: Number(speed.value) }));
  end.addEventListener("click", () => order("replay", { action: "end" }));

  page.on("tape", (message) => {
    state = message;
    const length = message.end - message.begin;
    record.textContent = message.recording ? "Stop" : "Record";
    record.setAttribute("aria-pressed", message.recording);
    topics.box.disabled = pictures.box.disabled = message.recording;
    panel.badge(message.recording ? "●" : null, "error");
    words.textContent = message.recording
      ? `Recording: ${length.toFixed(1)} s${message.topics ? ", with topics" : ""}.`
      : message.frames ? `${length.toFixed(1)} s recorded.` : "Nothing recorded yet.";
    replay.hidden = message.recording || !message.frames;
    Object.assign(slider, { min: message.begin, max: message.end });
    if (!grabbed) slider.value = message.playing ? message.at : message.end;
    play.replaceChildren(icon(message.running ? PAUSE : PLAY), message.running ? "Pause" : "Play");
    end.disabled = !message.playing;
    banner.hidden = !message.playing;
    document.body.toggleAttribute("data-replay", Boolean(message.playing));
  });
}
