// Screenshots and videos of the viewport.

import { h, icon, short } from "../page/dom.js";
import { numberField } from "../page/number_field.js";

const SHOT = "M4 7h4l2-3h4l2 3h4v13H4zM12 10a3.5 3.5 0 1 0 0 7a3.5 3.5 0 0 0 0-7z";
const FILM = "M20 12a8 8 0 1 1-3-6.2M20 3v4h-4M10 9l5 3-5 3z";
const SCALE = 2; // resolution of a screenshot relative to the viewport

function keep(blob, name) {
  const link = h("a", { download: name, href: URL.createObjectURL(blob) });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function stem(page) {
  return (page.model?.name ?? "robot").replace(/[^\w.-]+/g, "_");
}

/** Take a screenshot as a PNG blob. */
export function picture(page) {
  const { renderer } = page.viewport.viewer;
  const before = renderer.getPixelRatio();
  renderer.setPixelRatio(SCALE);
  page.viewport.resize();
  page.viewport.viewer.render();
  // Read before the next frame is drawn, because the buffer is not preserved.
  const taken = new Promise((resolve, reject) => renderer.domElement.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the screenshot failed"))), "image/png"));
  renderer.setPixelRatio(before);
  page.viewport.resize();
  return taken;
}

/** Record one turn around the target of the camera as a WebM blob. `progress` is called with 0..1; it stops by returning false. */
export function turntable(page, seconds, progress = () => true) {
  const { viewer } = page.viewport;
  const { camera, controls } = viewer;
  const kind = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"].find((each) => MediaRecorder.isTypeSupported(each));
  if (!kind) return Promise.reject(new Error("this browser cannot record video"));
  const stream = viewer.renderer.domElement.captureStream(30);
  const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 8e6 });
  const parts = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  const arm = camera.position.clone().sub(controls.target);
  const target = controls.target.clone();
  const up = arm.clone().set(0, 1, 0);
  return new Promise((resolve, reject) => {
    let stopped = false;
    recorder.addEventListener("error", (event) => reject(event.error));
    recorder.addEventListener("stop", () => {
      stream.getTracks().forEach((track) => track.stop());
      camera.position.copy(target).add(arm);
      page.viewport.dirty();
      if (stopped) reject(new Error("stopped"));
      else resolve(new Blob(parts, { type: kind.split(";")[0] }));
    });
    recorder.start(250);
    const start = performance.now();
    const turn = (now) => {
      const done = Math.min(1, (now - start) / (1000 * seconds));
      camera.position.copy(target).add(arm.clone().applyAxisAngle(up, done * 2 * Math.PI));
      page.viewport.dirty();
      stopped = progress(done) === false;
      if (done < 1 && !stopped) requestAnimationFrame(turn);
      else requestAnimationFrame(() => recorder.stop());
    };
    requestAnimationFrame(turn);
  });
}

export function capture(page) {
  const shoot = async () => keep(await picture(page), `${stem(page)}.png`);
  page.tools.action({ id: "shot", title: "Screenshot", icon: SHOT, order: 60, run: shoot });
  page.shortcut({ key: "s", does: "save a screenshot", group: "Tools", run: () => void shoot() });

  const seconds = numberField({ id: "turn-seconds", min: 1, max: 60, step: 1, value: 6, unit: "s" });
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Recording" });
  const button = h("button#turntable", { type: "button" }, icon(FILM), h("span", {}, "Record a turn"));
  let running = false;
  button.addEventListener("click", async () => {
    if (running) return void (running = false);
    if (page.cameras.way !== "orbit") document.getElementById("camera-orbit").click();
    running = true;
    bar.hidden = false;
    button.lastChild.textContent = "Stop";
    const length = seconds.valueAsNumber || 6;
    try {
      const film = await turntable(page, length, (done) => ((bar.value = done), running));
      keep(film, `${stem(page)}.${film.type.split("/")[1]}`);
      page.toast(`Saved the turn (${short(film.size / 1e6, 1)} MB)`, "good");
    } catch (error) {
      page.toast(error.message);
    }
    running = false;
    bar.hidden = true;
    button.lastChild.textContent = "Record a turn";
  });
  page.viewPanel.body.append(
    h("h3", {}, "Capture"),
    h("div.row.wrap", {}, h("button", { type: "button", onclick: () => void shoot() }, icon(SHOT), h("span", {}, "Screenshot")), button),
    h("label.inline", {}, "One turn takes ", seconds, " s"),
    bar,
  );
  page.expose("capture", { picture: () => picture(page), turntable: (length) => turntable(page, length) });
}
