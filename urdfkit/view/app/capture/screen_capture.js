// Screenshots of any size, and films: of a turn, of whatever happens, and of a replay in a chosen time.

import { check, h, icon, short } from "../page/dom.js";
import { numberField } from "../page/number_field.js";
import { film, turntable } from "./film.js";

const SHOT = "M4 7h4l2-3h4l2 3h4v13H4zM12 10a3.5 3.5 0 1 0 0 7a3.5 3.5 0 0 0 0-7z";
const TURN = "M20 12a8 8 0 1 1-3-6.2M20 3v4h-4M10 9l5 3-5 3z";
const FILM = "M4 6h11v12H4zM15 10l5-3v10l-5-3z";
const LAPSE = "M12 4a8 8 0 1 0 0 16a8 8 0 0 0 0-16zM12 8v4l3 2";
const SCALE = 2; // resolution of a screenshot relative to the viewport
const FASTEST = 200; // of a replay

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

/**
 * Take a screenshot as a PNG blob.
 * @param size {width, height} in pixels; twice the viewport if omitted
 * @param transparent whether sky and grid are omitted; shadows on the ground remain
 */
export function picture(page, { width, height, transparent = false } = {}) {
  const { viewport } = page;
  const { renderer, scene } = viewport.viewer;
  const before = { ratio: renderer.getPixelRatio(), sky: scene.background, grid: viewport.grid.visible, planes: viewport.planes.group.visible };
  const { clientWidth, clientHeight } = viewport.pane;
  const size = width && height ? [width, height] : [SCALE * clientWidth, SCALE * clientHeight];
  if (transparent) Object.assign(scene, { background: null });
  if (transparent) renderer.setClearAlpha(0);
  viewport.grid.visible = before.grid && !transparent;
  viewport.planes.group.visible = before.planes && !transparent;
  renderer.setPixelRatio(1);
  viewport.draw(...size);
  // Read before the next frame is drawn, because the buffer is not preserved.
  const taken = new Promise((resolve, reject) => renderer.domElement.toBlob((blob) => (blob ? resolve(blob) : reject(new Error(`the browser cannot draw ${size.join(" × ")} pixels`))), "image/png"));
  scene.background = before.sky;
  viewport.grid.visible = before.grid;
  viewport.planes.group.visible = before.planes;
  renderer.setPixelRatio(before.ratio);
  viewport.resize();
  return taken;
}

export function capture(page) {
  const largest = Math.min(8192, page.viewport.viewer.renderer.capabilities.maxTextureSize);
  const pixels = (id, value, name) => numberField({ id, min: 16, max: largest, step: 10, whole: true, unit: "px", value, "aria-label": name });
  const [width, height] = [pixels("shot-width", 1920, "Width of screenshots [px]"), pixels("shot-height", 1080, "Height of screenshots [px]")];
  const sizes = h("div.row.inside", { hidden: true }, width, "×", height, "px");
  const sized = check("Custom size of screenshots", { id: "shot-sized", changed: (on) => (sizes.hidden = !on) });
  const clear = check("Transparent ground and sky", { id: "shot-transparent" });
  const options = () => ({ transparent: clear.box.checked, ...(sized.box.checked && { width: width.valueAsNumber, height: height.valueAsNumber }) });
  const shoot = () => picture(page, options()).then((blob) => keep(blob, `${stem(page)}.png`), (error) => page.toast(error.message, "error"));
  page.tools.action({ id: "shot", title: "Screenshot", icon: SHOT, order: 60, run: shoot });
  page.shortcut({ key: "s", does: "save a screenshot", group: "Tools", run: () => void shoot() });

  const seconds = numberField({ id: "turn-seconds", min: 1, max: 600, step: 1, value: 6, unit: "s" });
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Recording" });
  const buttons = [];
  let running = false;

  // A button that starts a film, and stops it when it is pressed again.
  function filming(id, words, d, make) {
    const button = h("button", { type: "button", id, "aria-pressed": "false" }, icon(d), h("span", {}, words));
    button.addEventListener("click", async () => {
      if (running) return void (running = false);
      running = true;
      for (const other of buttons) other.disabled = other !== button;
      button.lastChild.textContent = "Stop";
      button.setAttribute("aria-pressed", "true");
      bar.hidden = false;
      bar.removeAttribute("value");
      try {
        const blob = await make();
        keep(blob, `${stem(page)}.${blob.type.split("/")[1]}`);
        page.toast(`Saved the video (${short(blob.size / 1e6, 1)} MB)`, "good");
      } catch (error) {
        page.toast(error.message, "error");
      }
      running = false;
      bar.hidden = true;
      button.lastChild.textContent = words;
      button.setAttribute("aria-pressed", "false");
      for (const other of buttons) other.disabled = false;
    });
    buttons.push(button);
    return button;
  }
  const length = () => seconds.valueAsNumber || 6;
  const progress = (done) => ((bar.value = done), running);
  const turn = filming("turntable", "Record a turn", TURN, () => {
    if (page.cameras.way !== "orbit") document.getElementById("camera-orbit").click();
    return turntable(page.viewport, length(), progress);
  });
  const free = filming("film", "Record a video", FILM, () => film(page.viewport, () => running));
  const lapse = filming("timelapse", "Timelapse of the replay", LAPSE, () => timelapse(page, length(), progress));
  lapse.hidden = true;
  let replay = null;
  page.on("recorder", (message) => {
    replay = message;
    lapse.hidden = message.recording || !message.frames;
  });

  // The replay from its beginning to its end, so fast that it takes `wanted` seconds.
  async function timelapse(page, wanted, progress) {
    const { begin, end } = replay;
    const speed = Math.min(FASTEST, Math.max(0.05, (end - begin) / wanted));
    await page.connection.request("replay", { action: "show", at: begin });
    await page.connection.request("replay", { action: "play", speed });
    let started = false;
    const last = 2 * ((end - begin) / speed) + 5; // [s], where the page falls behind
    const blob = await film(page.viewport, (elapsed) => {
      started ||= replay.running;
      const done = replay.running ? (replay.at - begin) / (end - begin) : Number(started);
      return progress(done) && done < 1 && elapsed < last;
    });
    await page.connection.request("replay", { action: "pause" });
    return blob;
  }

  page.viewPanel.body.append(
    h("h3", {}, "Capture"),
    h("div.row.wrap", {}, h("button", { type: "button", onclick: shoot }, icon(SHOT), h("span", {}, "Screenshot")), free, turn, lapse),
    sized.label,
    sizes,
    clear.label,
    h("label.inline", { for: "turn-seconds" }, "One turn, or a timelapse, takes ", seconds, " s"),
    bar,
  );
  page.expose("capture", { picture: (options) => picture(page, options), turntable: (length) => turntable(page.viewport, length), film: (each, patience) => film(page.viewport, each, patience) });
}
