// Trails of the robot: its true path and the path of its odometry.
/* global MeshCat */

import { check, h } from "../page/dom.js";

const THREE = MeshCat.THREE;
const ROOM = 6000; // maximum number of points of a trail; beyond this every second point is dropped
const STEP = 0.005; // metres between two points

class Trail {
  constructor(viewport, colour, height) {
    this.viewport = viewport;
    this.height = height;
    this.count = 0;
    this.step = STEP;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * ROOM), 3).setUsage(THREE.DynamicDrawUsage));
    this.line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour }));
    this.line.frustumCulled = false;
    this.clear();
    viewport.viewer.scene.add(this.line);
  }

  clear() {
    this.count = 0;
    this.step = STEP;
    this.line.geometry.setDrawRange(0, 0);
  }

  add(x, y) {
    const at = this.line.geometry.getAttribute("position");
    const k = this.count - 1;
    if (k >= 0 && Math.hypot(x - at.array[3 * k], y - at.array[3 * k + 1]) < this.step) return;
    if (this.count === ROOM) {
      for (let i = 0; i < ROOM / 2; i += 1) at.array.copyWithin(3 * i, 6 * i, 6 * i + 3);
      this.count = ROOM / 2;
      this.step *= 2;
    }
    at.setXYZ(this.count, x, y, this.height);
    this.count += 1;
    at.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
    if (this.line.visible) this.viewport.dirty();
  }

  show(shown) {
    this.line.visible = shown;
    this.viewport.dirty();
  }
}

export function trails(page) {
  const real = new Trail(page.viewport, 0x3b7df5, 0.004);
  const believed = new Trail(page.viewport, 0xe0399b, 0.006);
  let last = 0;
  let from = null; // pose of the odometry frame in the world
  const clear = () => {
    real.clear();
    believed.clear();
    from = null;
    page.viewport.dirty();
  };
  const box = h("div.sim-layers", { "data-mode": "sim" });
  const tick = (words, id, trail) => {
    const { label } = check(words, { id, checked: true, changed: (shown) => trail.show(shown) });
    box.append(label);
  };
  tick("Trail", "show-trail", real);
  tick("Odometry trail", "show-odometry", believed);
  box.append(h("button", { type: "button", id: "clear-trail", onclick: clear }, "Clear trails"));
  page.panels.all.get("show").body.append(box);
  let driven = null;
  page.on("status", ({ time, pose, robots, odometry }) => {
    const name = page.driven ?? null;
    if (time < last - 1e-9 || name !== driven) clear();
    last = time;
    driven = name;
    const now = robots[page.driven] ?? pose;
    real.add(now.x, now.y);
    const [first] = page.followed === undefined ? Object.values(odometry) : [];
    if (!first) return;
    const [x, y, yaw] = first;
    if (!from) {
      const turn = pose.yaw - yaw;
      from = { turn, x: pose.x - (Math.cos(turn) * x - Math.sin(turn) * y), y: pose.y - (Math.sin(turn) * x + Math.cos(turn) * y) };
    }
    const [c, s] = [Math.cos(from.turn), Math.sin(from.turn)];
    believed.add(from.x + c * x - s * y, from.y + s * x + c * y);
  });
  page.expose("trails", { real, believed });
}
