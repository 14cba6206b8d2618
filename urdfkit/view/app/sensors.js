// What lidars and cameras see: points in the scene, small pictures in the panel.
/* global MeshCat */

const THREE = MeshCat.THREE;
const HEADER = 16;
const PICTURE = 1;
const COLOURS = [0xe0399b, 0x0aa37f, 0xe08a00, 0x7a5cff];

export class Sensors {
  constructor(stage) {
    this.stage = stage;
    this.shown = [];
  }

  /** @param sensors [{topic, picture}], in the order of the numbers of their frames */
  use(sensors) {
    const before = new Map(this.shown.map((each) => [each.topic, each]));
    this.shown = sensors.map((sensor, i) => before.get(sensor.topic) ?? this.#make(sensor, i));
    for (const [topic, each] of before) if (!this.shown.some((kept) => kept.topic === topic)) each.remove();
    document.getElementById("sensor-section").hidden = sensors.length === 0;
  }

  #make(sensor, i) {
    return sensor.picture ? new Picture(sensor.topic) : new Cloud(sensor.topic, this.stage, COLOURS[i % COLOURS.length]);
  }

  /** Take one binary frame. */
  frame(buffer) {
    const view = new DataView(buffer);
    const shown = this.shown[view.getUint16(2, true)];
    if (shown?.picture === (view.getUint8(1) === PICTURE)) shown.take(buffer);
  }
}

function row(topic, list) {
  const item = document.createElement("li");
  const label = document.createElement("label");
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = true;
  label.append(box, ` ${topic}`);
  item.append(label);
  document.getElementById(list).append(item);
  return { item, box };
}

class Cloud {
  picture = false;
  constructor(topic, stage, colour) {
    this.topic = topic;
    this.stage = stage;
    const material = new THREE.PointsMaterial({ color: colour, size: 4, sizeAttenuation: false });
    this.points = new THREE.Points(new THREE.BufferGeometry(), material);
    this.points.frustumCulled = false;
    stage.viewer.scene.add(this.points);
    const { item, box } = row(topic, "sensors");
    this.item = item;
    box.style.accentColor = `#${colour.toString(16).padStart(6, "0")}`;
    box.addEventListener("change", () => {
      this.points.visible = box.checked;
      stage.dirty();
    });
  }

  get count() {
    return this.points.geometry.getAttribute("position")?.count ?? 0;
  }

  take(buffer) {
    this.points.geometry.dispose();
    this.points.geometry = new THREE.BufferGeometry();
    this.points.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(buffer, HEADER), 3));
    this.stage.dirty();
  }

  remove() {
    this.stage.viewer.scene.remove(this.points);
    this.points.geometry.dispose();
    this.item.remove();
    this.stage.dirty();
  }
}

class Picture {
  picture = true;
  constructor(topic) {
    this.topic = topic;
    const { item, box } = row(topic, "sensors");
    this.item = item;
    this.image = document.createElement("img");
    this.image.alt = `what comes on ${topic}`;
    this.url = null;
    item.append(this.image);
    box.addEventListener("change", () => (this.image.hidden = !box.checked));
  }

  take(buffer) {
    const old = this.url;
    this.url = URL.createObjectURL(new Blob([new Uint8Array(buffer, HEADER)], { type: "image/jpeg" }));
    this.image.onload = this.image.onerror = () => old && URL.revokeObjectURL(old);
    this.image.src = this.url;
  }

  remove() {
    if (this.url) URL.revokeObjectURL(this.url);
    this.item.remove();
  }
}
