// Labels at points of the scene, and the tooltip at the mouse.
/* global MeshCat */

import { h } from "../page/dom.js";

const THREE = MeshCat.THREE;
const TONES = ["error", "warning", "note"]; // of badges, the worst first

export class Labels {
  constructor(page) {
    this.page = page;
    this.viewport = page.viewport;
    this.layer = h("div#labels");
    this.viewport.pane.after(this.layer);
    this.tipBox = h("div#tip", { role: "tooltip", hidden: true });
    this.layer.after(this.tipBox);
    this.kept = new Map(); // element → function that returns where it is, a Vector3 in the world, or null
    const { viewer } = this.viewport;
    const render = viewer.render.bind(viewer);
    viewer.render = () => {
      page.emit("draw", null);
      render();
      this.place();
      page.emit("drawn", null);
    };
  }

  /** Attach an element to a point. `where` returns a Vector3 in the world, or null while there is no point. */
  add(element, where) {
    element.classList.add("label");
    this.kept.set(element, where);
    this.layer.append(element);
    this.viewport.dirty();
    return element;
  }

  remove(element) {
    this.kept.delete(element);
    element.remove();
  }

  /** Project a point of the world to the viewport [pixels]; also whether it is in front of the camera. */
  screen(point) {
    const { clientWidth: width, clientHeight: height } = this.viewport.pane;
    const at = point.clone().project(this.viewport.viewer.camera);
    return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height, at.z < 1 && at.z > -1];
  }

  place() {
    const [names, badges] = [[], []];
    const { camera } = this.viewport.viewer;
    for (const [element, where] of this.kept) {
      const point = where();
      const [x, y, seen] = point ? this.screen(point) : [0, 0, false];
      element.hidden = !seen;
      if (!seen) continue;
      element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      if (element.dataset.count) badges.push({ element, x, y, away: camera.position.distanceTo(point) });
      if (element.dataset.name) names.push({ element, x, y, away: this.wanted.has(element.dataset.name) ? -1 : camera.position.distanceTo(point) });
    }
    this.#declutter(names);
    this.#merge(badges);
  }

  /** Labels that are shown even if others overlap them. */
  get wanted() {
    return new Set([this.page.pick?.hovered, this.page.selected?.link]);
  }

  // Of overlapping labels only the nearest is shown.
  #declutter(names) {
    for (const { element } of names) element.size ??= [element.offsetWidth, element.offsetHeight];
    const shown = [];
    for (const { element, x, y } of names.sort((a, b) => a.away - b.away)) {
      const [width, height] = element.size;
      const covered = shown.some((other) => x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height);
      element.toggleAttribute("data-covered", covered);
      if (!covered) shown.push({ x, y, width, height });
    }
  }

  // Of badges that overlap only the nearest is shown, with the sum of their counts and the worst tone.
  #merge(badges) {
    const shown = [];
    for (const badge of badges.sort((a, b) => a.away - b.away)) {
      badge.element.size ??= badge.element.offsetWidth; // larger for fingers
      const first = shown.find((other) => Math.hypot(badge.x - other.x, badge.y - other.y) < other.element.size);
      badge.element.toggleAttribute("data-covered", Boolean(first));
      if (first) first.merged.push(badge.element);
      else shown.push({ ...badge, merged: [badge.element] });
    }
    for (const { element, merged } of shown) {
      const count = String(merged.reduce((sum, each) => sum + Number(each.dataset.count), 0));
      const words = merged.map((each) => each.dataset.words).join("\n");
      if (element.title === words) continue;
      element.title = words;
      element.setAttribute("aria-label", words);
      element.firstChild.textContent = count;
      element.firstChild.dataset.tone = TONES.find((tone) => merged.some(({ dataset }) => dataset.tone === tone));
    }
  }

  /** Show a tooltip at the mouse, or hide it. */
  tip(words, event) {
    this.tipBox.hidden = !words;
    if (!words || !event) return;
    const { left, top, width } = this.viewport.pane.getBoundingClientRect();
    this.tipBox.textContent = words;
    const x = Math.min(event.clientX - left + 14, width - this.tipBox.offsetWidth - 6);
    this.tipBox.style.transform = `translate(${x}px, ${event.clientY - top + 16}px)`;
  }

  /** Position of a link's frame, or of a point in it, in the world. */
  at(link, local = [0, 0, 0]) {
    const node = this.page.scene.byLink.get(link);
    node?.updateWorldMatrix(true, false); // it may have moved since the last frame
    return node ? node.localToWorld(new THREE.Vector3(...local)) : null;
  }
}

export function labels(page) {
  page.labels = new Labels(page);
}
