// Overlays of an image, which are the boxes of a detector or another image, and a larger window.

import { h } from "../page/dom.js";
import { offer } from "../page/edited_fields.js";

const SVG = "http://www.w3.org/2000/svg";

export class ImageOverlay {
  constructor(page, topic, image) {
    Object.assign(this, { page, topic, image });
    this.key = null; // of the boxes
    this.other = ""; // topic of the other image
    this.over = h("canvas.over", { "aria-hidden": "true", hidden: true });
    this.boxes = svg("svg", { class: "boxes", preserveAspectRatio: "none", "aria-hidden": "true" });
    this.figure = h("div.picture", {}, image, this.over, this.boxes);
    this.choice = h("select", { "aria-label": `Overlay of ${topic}` }, h("option", { value: "" }, "no overlay"));
    this.choice.addEventListener("change", () => this.choose(this.choice.value));
    this.enlarge = h("button", { type: "button", "aria-label": `Enlarge ${topic}`, onclick: () => this.#open() }, "Enlarge");
    this.controls = h("div.row", {}, this.choice, this.enlarge);
    this.home = h("div.picture-home", {}, this.figure, this.controls);
    this.dialog = null;
  }

  /** Offer these topics: of detections, and of other images. */
  offer(detections, images) {
    const names = [...detections.map((name) => [`boxes ${name}`, name]), ...images.filter((name) => name !== this.topic).map((name) => [`image ${name}`, name])];
    const chosen = this.choice.value;
    offer(this.choice, [["", "no overlay"], ...names], () => chosen !== this.choice.value && this.choose(""));
  }

  choose(value) {
    const [kind, name] = value.split(" ");
    if (this.key) this.page.connection.subscribe(this.key, false);
    this.key = kind === "boxes" ? `display:${name}:${this.topic}` : null;
    if (this.key) this.page.connection.subscribe(this.key, true);
    this.other = kind === "image" ? name : "";
    this.over.hidden = true;
    this.boxes.replaceChildren();
  }

  /** Show another image over this one, if it is the chosen one. */
  follow({ topic, image }) {
    if (topic !== this.other) return;
    draw(image, this.over);
    this.over.hidden = false;
  }

  /** Draw the boxes of a message. */
  take({ source, groups }) {
    const item = groups?.[0]?.items[0];
    if (source !== this.key || !item) return;
    const [width, height] = item.size ?? [this.image.width, this.image.height];
    const unit = width / 100;
    this.boxes.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.boxes.replaceChildren(...item.boxes.flatMap(([x, y, w, h, turn, label]) => {
      const words = svg("text", { x: x - w / 2, y: Math.max(y - h / 2 - unit, 4 * unit), "font-size": 4 * unit });
      words.textContent = label;
      return [svg("rect", { x: x - w / 2, y: y - h / 2, width: w, height: h, transform: `rotate(${turn} ${x} ${y})` }), words];
    }));
  }

  show(on) {
    this.figure.hidden = this.controls.hidden = !on;
    if (!on) this.#close();
  }

  remove() {
    this.#close();
    this.choose("");
  }

  #open() {
    if (this.dialog) return this.#close();
    const close = h("button", { type: "button", onclick: () => this.#close() }, "Close");
    const head = h("div.dialog-head", {}, h("h2", {}, this.topic), close);
    this.dialog = h("dialog.enlarged", { "aria-label": `Image of ${this.topic}` }, head, this.figure, this.controls);
    this.dialog.addEventListener("keydown", (event) => event.key === "Escape" && (event.stopPropagation(), this.#close()));
    document.body.append(this.dialog);
    this.enlarge.hidden = true;
    this.dialog.show();
    this.page.connection.subscribe(`large:${this.topic}`, true);
  }

  #close() {
    if (!this.dialog) return;
    this.page.connection.subscribe(`large:${this.topic}`, false);
    this.home.append(this.figure, this.controls);
    this.dialog.remove();
    this.dialog = null;
    this.enlarge.hidden = false;
    this.enlarge.focus();
  }
}

/** Draw an image or a canvas on a canvas, which gets its size. */
export function draw(image, canvas) {
  const { width, height } = image;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const pen = canvas.getContext("2d");
  pen.globalCompositeOperation = "copy";
  pen.drawImage(image, 0, 0);
}

function svg(tag, attributes) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
