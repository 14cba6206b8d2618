// Point clouds in the scene with reused buffers, and a view of the points from above.
/* global MeshCat */

import { inFront } from "../appearance/in_front.js";

const THREE = MeshCat.THREE;
const ROOM = 1.5; // factor of spare space in a buffer
const BACK = { light: "#e9edf2", dark: "#0f141b" };

export class Cloud {
  /** @param viewport the 3-D viewport; @param colour of points without their own colour */
  constructor(viewport, colour, size = 4) {
    this.viewport = viewport;
    this.colour = colour;
    this.count = 0;
    this.capacity = 0;
    this.colored = false;
    this.points = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ color: colour, size, sizeAttenuation: false }));
    inFront(this.points.material); // points of a wall are noisy
    this.points.frustumCulled = false;
    viewport.viewer.scene.add(this.points);
  }

  /** Read x y z (and red, green, blue, 255 if `colored`) of each point from a frame after its header. */
  take(buffer, header, colored) {
    const stride = colored ? 16 : 12;
    this.count = Math.floor((buffer.byteLength - header) / stride);
    if (this.count > this.capacity || this.capacity === 0 || colored !== this.colored) this.#allocate(Math.ceil(this.count * ROOM) + 64, colored);
    const { position, color } = this.points.geometry.attributes;
    if (!colored) {
      position.array.set(new Float32Array(buffer, header, 3 * this.count));
    } else {
      const floats = new Float32Array(buffer, header, 4 * this.count);
      const bytes = new Uint8Array(buffer, header, 16 * this.count);
      for (let i = 0; i < this.count; i += 1) {
        position.array.set(floats.subarray(4 * i, 4 * i + 3), 3 * i);
        color.array.set(bytes.subarray(16 * i + 12, 16 * i + 16), 4 * i);
      }
      color.needsUpdate = true;
    }
    position.needsUpdate = true;
    this.points.geometry.setDrawRange(0, this.count);
    this.viewport.dirty();
  }

  #allocate(capacity, colored) {
    this.points.geometry.dispose();
    const geometry = (this.points.geometry = new THREE.BufferGeometry());
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * capacity), 3).setUsage(THREE.DynamicDrawUsage));
    if (colored) geometry.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(4 * capacity), 4, true).setUsage(THREE.DynamicDrawUsage));
    this.points.material.vertexColors = colored;
    this.points.material.color.set(colored ? 0xffffff : this.colour);
    this.points.material.needsUpdate = true;
    Object.assign(this, { capacity, colored });
  }

  /** Draw the points from above, with the robot in the centre and heading up; pose is {x, y, yaw}. */
  draw(canvas, { x, y, yaw } = { x: 0, y: 0, yaw: 0 }) {
    const { width, height } = canvas;
    const pen = canvas.getContext("2d");
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    pen.fillStyle = BACK[dark ? "dark" : "light"];
    pen.fillRect(0, 0, width, height);
    const at = this.points.geometry.attributes.position?.array;
    if (!at) return;
    let far = 1;
    for (let i = 0; i < this.count; i += 1) far = Math.max(far, Math.abs(at[3 * i] - x), Math.abs(at[3 * i + 1] - y));
    this.reach = Math.max(far * 1.05, (this.reach ?? 0) * 0.97); // decreases slowly, so that the scale is steady
    const scale = height / 2 / this.reach;
    this.#rings(pen, width, height, scale, dark);
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    pen.fillStyle = `#${this.colour.toString(16).padStart(6, "0")}`;
    for (let i = 0; i < this.count; i += 1) {
      const dx = at[3 * i] - x;
      const dy = at[3 * i + 1] - y;
      pen.fillRect(width / 2 + (dx * s - dy * c) * scale - 1, height / 2 - (dx * c + dy * s) * scale - 1, 2, 2);
    }
    pen.beginPath(); // the robot
    pen.moveTo(width / 2, height / 2 - 7);
    pen.lineTo(width / 2 + 5, height / 2 + 6);
    pen.lineTo(width / 2 - 5, height / 2 + 6);
    pen.fillStyle = dark ? "#e8edf3" : "#1b2430";
    pen.fill();
  }

  #rings(pen, width, height, scale, dark) {
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50].find((each) => each * scale > 28) ?? 100;
    pen.strokeStyle = dark ? "#263040" : "#cfd7e1";
    pen.fillStyle = dark ? "#8b98a9" : "#667385";
    pen.font = "11px system-ui";
    for (let r = step; r * scale < width / 2; r += step) {
      pen.beginPath();
      pen.arc(width / 2, height / 2, r * scale, 0, 7);
      pen.stroke();
      if (r * scale < height / 2 - 8) pen.fillText(`${Number(r.toFixed(1))} m`, width / 2 + 4, height / 2 - r * scale + 12);
    }
  }

  remove() {
    this.viewport.viewer.scene.remove(this.points);
    this.points.geometry.dispose();
    this.points.material.dispose();
    this.viewport.dirty();
  }
}
