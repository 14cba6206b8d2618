// Films of the viewport: WebM, or MP4 where the browser writes it, at the speed at which the page is drawn.

import { soft } from "../viewport/graphics_device.js";

const RATE = 30; // frames/s at most
const PATIENCE = 15000; // ms
const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
const SOFT_KINDS = KINDS.slice(1); // the processor, which also draws, encodes VP8 faster

const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));

/**
 * Record the viewport and return a blob, which has at least one frame.
 * @param patience ms to wait for the first encoded frame
 * @param each called before each frame with the seconds since the start and the number of frames; ends the film by returning false
 */
export async function film(viewport, each, patience = PATIENCE) {
  const kind = (soft ? SOFT_KINDS : KINDS).find((name) => window.MediaRecorder?.isTypeSupported(name));
  if (!kind) throw new Error("this browser does not record video");
  const { viewer } = viewport;
  viewport.budget.until = 0;
  const budgeted = viewport.budget.on;
  viewport.budget.on = false; // all frames of a film have the same size
  viewport.dirty();
  const stream = viewer.renderer.domElement.captureStream(RATE);
  const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 8e6 });
  const parts = [];
  let fault = null;
  recorder.addEventListener("dataavailable", ({ data }) => data.size && parts.push(data));
  recorder.addEventListener("error", ({ error }) => (fault = error ?? new Error("the browser could not encode the video")));
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve));
  try {
    recorder.start(250);
    const start = performance.now();
    for (let frames = 0; !fault && each((performance.now() - start) / 1000, frames) !== false; frames++) {
      viewer.set_dirty();
      await nextFrame();
    }
    // A busy computer may not have encoded a frame yet: the encoder writes nothing before the first one.
    const end = performance.now();
    while (!fault && !parts.length && performance.now() - end < patience) {
      viewer.set_dirty();
      await nextFrame();
      if (recorder.state === "recording") recorder.requestData();
    }
  } finally {
    viewport.budget.on = budgeted;
    if (recorder.state !== "inactive") {
      recorder.stop();
      await stopped;
    }
    for (const track of stream.getTracks()) track.stop();
  }
  if (fault) throw fault;
  if (!parts.length) throw new Error(`no video was saved: the browser encoded no frame within ${patience / 1000} s; make the window smaller, or end other programs`);
  return new Blob(parts, { type: kind.split(";")[0] });
}

/** Record one turn around the target of the camera. `progress` is called with 0..1; it stops the film by returning false. */
export async function turntable(viewport, seconds, progress = () => true) {
  const { camera, controls } = viewport.viewer;
  const arm = camera.position.clone().sub(controls.target);
  const target = controls.target.clone();
  const up = arm.clone().set(0, 1, 0);
  const step = 1 / 24; // of a turn: the largest between two frames, also where drawing is slower than the film
  let turned = 0;
  let before = 0;
  let stopped = false;
  try {
    const blob = await film(viewport, (elapsed) => {
      turned = Math.min(1, turned + Math.min(step, (elapsed - before) / seconds));
      before = elapsed;
      camera.position.copy(target).add(arm.clone().applyAxisAngle(up, turned * 2 * Math.PI));
      stopped = progress(turned) === false;
      return turned < 1 && !stopped;
    });
    if (stopped) throw new Error("the recording was stopped");
    return blob;
  } finally {
    camera.position.copy(target).add(arm);
    viewport.dirty();
  }
}
