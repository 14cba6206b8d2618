// Contact forces and slip, as arrows at their contact points.
/* global MeshCat */

import { check, h, short } from "../page/dom.js";

const THREE = MeshCat.THREE;
const HEADER = 16;
const ARROWS = 2;
const ROOM = 400;

/** Many arrows in two draw calls with reused buffers. */
class Arrows {
  constructor(viewport, colour) {
    this.viewport = viewport;
    this.longest = 0;
    this.count = 0;
    const material = { color: colour, depthTest: false, transparent: true, opacity: 0.95 };
    const copies = (geometry) => new THREE.InstancedMesh(geometry, new THREE.MeshBasicMaterial(material), ROOM);
    this.shafts = copies(new THREE.CylinderGeometry(0.09, 0.09, 1, 8).translate(0, 0.5, 0));
    this.heads = copies(new THREE.ConeGeometry(0.28, 1, 16).translate(0, -0.5, 0));
    for (const object of [this.shafts, this.heads]) {
      object.frustumCulled = false;
      object.renderOrder = 25;
      viewport.viewer.scene.add(object);
    }
    this.show(false);
  }

  show(shown) {
    this.shafts.visible = this.heads.visible = shown;
    this.viewport.dirty();
  }

  /** @param values x y z and a vector of each arrow; the longest arrow is as long as the robot */
  take(values) {
    this.count = Math.min(ROOM, values.length / 6);
    let longest = 0;
    for (let i = 0; i < this.count; i += 1) longest = Math.max(longest, Math.hypot(values[6 * i + 3], values[6 * i + 4], values[6 * i + 5]));
    this.longest = longest;
    this.measure = Math.max(longest, (this.measure ?? 0) * 0.98); // decreases slowly, so that the scale is steady
    const reach = this.measure > 0 ? (0.9 * this.viewport.radius) / this.measure : 0;
    const [up, from, along, turn, size] = [new THREE.Vector3(0, 1, 0), new THREE.Vector3(), new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
    const matrix = new THREE.Matrix4();
    for (let i = 0; i < this.count; i += 1) {
      from.fromArray(values, 6 * i);
      along.fromArray(values, 6 * i + 3).multiplyScalar(reach);
      const length = along.length();
      const end = along.clone().add(from);
      turn.setFromUnitVectors(up, length > 0 ? along.divideScalar(length) : up);
      size.setScalar(Math.min(0.3 * length, 0.16 * this.viewport.radius) || 1e-9);
      this.heads.setMatrixAt(i, matrix.compose(end, turn, size));
      size.y = Math.max(length - size.y, 1e-9);
      this.shafts.setMatrixAt(i, matrix.compose(from, turn, size));
    }
    for (const { instanceMatrix } of [this.shafts, this.heads]) instanceMatrix.needsUpdate = true;
    this.shafts.count = this.heads.count = this.count;
    this.viewport.dirty();
  }
}

export function arrows(page) {
  const all = [
    { key: "contacts", arrows: new Arrows(page.viewport, 0xd1453b), words: "Contact forces", unit: "N" },
    { key: "slip", arrows: new Arrows(page.viewport, 0xe08a00), words: "Wheel slip", unit: "m/s" },
  ];
  const rows = h("ul.bare-list.slips", { "aria-label": "Slip", hidden: true });
  const host = h("div.sim-layers", { "data-mode": "sim" });
  for (const each of all) {
    each.note = h("span.quiet.measure");
    const { label } = check(each.words, {
      id: `show-${each.key}`,
      changed: (shown) => {
        page.connection.subscribe(each.key, shown);
        each.arrows.show(shown);
        each.note.textContent = "";
        if (each.key === "slip") rows.hidden = !shown;
      },
    });
    host.append(h("div.row", {}, label, each.note));
  }
  host.append(rows);
  page.panels.all.get("show").body.append(host);
  page.on("sensed", (buffer) => {
    const view = new DataView(buffer);
    if (view.getUint8(1) !== ARROWS) return;
    const each = all[view.getUint16(2, true)];
    each.arrows.take(new Float32Array(buffer, HEADER));
    each.note.textContent = `longest ${short(each.arrows.longest, 2)} ${each.unit}`;
    const sequence = view.getUint32(4, true);
    requestAnimationFrame(() => page.send("seen", { key: each.key, sequence }));
  });
  page.on("slip", (message) => {
    rows.replaceChildren(...message.rows.map(([link, speed]) => h("li", { "data-link": link }, h("span.name", {}, link), h("span.value", {}, `${short(speed, 3)} m/s`))));
  });
  page.expose("arrows", Object.fromEntries(all.map(({ key, arrows: each }) => [key, each])));
}
