// Views of lidars and cameras: points in the scene and from above, images in the panel. Only selected topics are subscribed.

import { check, h } from "../page/dom.js";
import { Cloud } from "./point_cloud.js";
import { draw, ImageOverlay } from "./image_overlay.js";

const HEADER = 16;
const POINTS = 0;
const PICTURE = 1;
const COLORED = 3;
const DETECTIONS = "vision_msgs/msg/Detection2DArray";
const COLOURS = [0xe0399b, 0x0aa37f, 0xe08a00, 0x7a5cff];

export class Sensors {
  constructor(page, list) {
    this.page = page;
    this.list = list;
    this.shown = [];
    this.detections = []; // topics with boxes for images
    page.on("topics", ({ rows }) => {
      this.detections = rows.filter(([, type]) => type === DETECTIONS).map(([topic]) => topic);
      this.#offer();
    });
    page.on("display", (message) => this.#overlays.forEach((overlay) => overlay.take(message)));
    page.on("picture", (picture) => this.#overlays.forEach((overlay) => overlay.follow(picture)));
  }

  get #overlays() {
    return this.shown.map(({ overlay }) => overlay).filter(Boolean);
  }

  #offer() {
    const images = this.shown.filter(({ overlay }) => overlay).map(({ topic }) => topic);
    for (const overlay of this.#overlays) overlay.offer(this.detections, images);
  }

  /** @param sensors [{topic, picture, camera}], in the order of the numbers of their frames */
  use(sensors) {
    const before = new Map(this.shown.map((each) => [each.topic, each]));
    this.shown = sensors.map((sensor, i) => before.get(sensor.topic) ?? this.#make(sensor, i));
    for (const [topic, each] of before) if (!this.shown.some((kept) => kept.topic === topic)) each.remove();
    this.#offer();
  }

  #make(sensor, i) {
    const Kind = sensor.picture ? Picture : Points;
    // The point cloud of a camera has one point per pixel, so it is initially off.
    return new Kind(this.page, this.list, sensor.topic, { on: sensor.picture || !sensor.camera, colour: COLOURS[i % COLOURS.length] });
  }

  /** Show a binary frame. */
  frame(buffer) {
    const view = new DataView(buffer);
    const kind = view.getUint8(1);
    const shown = this.shown[view.getUint16(2, true)];
    if (!shown?.kinds.includes(kind)) return;
    const sequence = view.getUint32(4, true);
    shown.arrived();
    shown.take(buffer, kind, () => this.page.send("seen", { key: shown.key, sequence }));
  }
}

/** The view of one topic, with a checkbox. */
class SensorView {
  constructor(page, list, topic, { on }) {
    this.page = page;
    this.topic = topic;
    this.key = `sensor:${topic}`;
    this.on = this.received = false;
    const { box, label } = check(topic, { checked: on, changed: (ticked) => this.tick(ticked) });
    this.box = box;
    this.waiting = h("p.quiet", { hidden: true }, this.awaited);
    this.item = h("li", {}, label, this.waiting);
    list.append(this.item);
  }

  tick(on) {
    if (on === this.on) return;
    this.on = on;
    this.page.connection.subscribe(this.key, on);
    this.waiting.hidden = !on || this.received;
    this.show(on);
  }

  /** The first message hides the text that stands for it. */
  arrived() {
    if (this.received) return;
    this.received = this.waiting.hidden = true;
    this.show(this.on);
  }

  remove() {
    this.tick(false);
    this.item.remove();
  }
}

class Points extends SensorView {
  kinds = [POINTS, COLORED];
  get awaited() {
    return "Waiting for the first points";
  }

  constructor(page, list, topic, options) {
    super(page, list, topic, options);
    this.cloud = new Cloud(page.viewport, options.colour);
    this.box.style.accentColor = `#${options.colour.toString(16).padStart(6, "0")}`;
    this.above = h("canvas.above", { width: 320, height: 200, role: "img", "aria-label": `${topic} from above` });
    this.item.append(this.above);
    this.tick(options.on);
    this.show(options.on);
  }

  get points() {
    return this.cloud.points;
  }

  get count() {
    return this.cloud.count;
  }

  show(on) {
    this.cloud.points.visible = on;
    this.above.hidden = !on || !this.received;
    this.page.viewport.dirty();
  }

  take(buffer, kind, shown) {
    this.cloud.take(buffer, HEADER, kind === COLORED);
    requestAnimationFrame(() => {
      if (this.page.panels.all.get("sensors").open) this.cloud.draw(this.above, this.page.pose);
      shown();
    });
  }

  remove() {
    super.remove();
    this.cloud.remove();
  }
}

class Picture extends SensorView {
  kinds = [PICTURE];
  get awaited() {
    return "Waiting for the first image";
  }

  constructor(page, list, topic, options) {
    super(page, list, topic, options);
    // One canvas for all images: an element with a new URL for each would keep the memory of many of them.
    this.image = h("canvas", { width: 1, height: 1, role: "img", "aria-label": `image of ${topic}` });
    this.taken = this.drawn = 0;
    this.overlay = new ImageOverlay(page, topic, this.image);
    this.item.append(this.overlay.home);
    this.tick(options.on);
    this.show(options.on);
  }

  show(on) {
    this.overlay.show(on && this.received);
  }

  async take(buffer, kind, shown) {
    const number = (this.taken += 1);
    const bitmap = await createImageBitmap(new Blob([new Uint8Array(buffer, HEADER)])).catch(() => null); // null: not an image
    if (bitmap && number > this.drawn) {
      this.drawn = number;
      draw(bitmap, this.image);
      this.page.emit("picture", this);
    }
    bitmap?.close();
    shown();
  }

  remove() {
    super.remove();
    this.overlay.remove();
  }
}
