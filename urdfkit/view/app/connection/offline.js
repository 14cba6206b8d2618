// Replaces the server in a page that was exported to one file: replays the recorded messages and moves the robot.

import { Kinematics } from "../robot/kinematics.js";

const recording = JSON.parse(document.getElementById("recording").textContent);

function bytes(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

export class Offline {
  constructor(on) {
    this.on = on;
    this.values = {};
    this.open = false;
    setTimeout(() => this.#begin(), 0); // asynchronous, like a real connection
  }

  #begin() {
    this.on.state("connected", "one file, no server");
    for (const command of recording.commands) this.on.command(bytes(command));
    const texts = recording.texts.map((text) => JSON.parse(text));
    for (const message of texts) {
      if (message.type === "inspect") this.kinematics = new Kinematics(message);
      if (message.type === "joints") this.values = { ...message.positions };
      this.on.text(message);
    }
    if (recording.poses) this.on.poses(bytes(recording.poses).buffer);
  }

  send(type, values) {
    if (type !== "joints" || !this.kinematics) return;
    Object.assign(this.values, values.positions);
    for (const joint of this.kinematics.joints) {
      if (joint.mimic) this.values[joint.name] = this.kinematics.value(joint, this.values);
    }
    this.on.poses(this.#frame());
    this.on.text({ type: "joints", positions: this.values });
  }

  #frame() {
    const poses = this.kinematics.forward(this.values);
    const { links } = this.kinematics;
    const buffer = new ArrayBuffer(16 + 28 * links.length);
    const view = new DataView(buffer);
    view.setUint8(0, 1);
    view.setUint8(1, 1);
    view.setUint16(2, links.length, true);
    new Float32Array(buffer, 16).set(links.flatMap((link) => poses.get(link)));
    return buffer;
  }

  request() {
    return Promise.reject(new Error("this exported page has no server; open the robot with `urdfkit view`"));
  }

  subscribe() {}
}

/** Return a mesh by the hash of its content, in the format of the server. */
async function mesh(name) {
  const packed = recording.meshes[name];
  if (!packed) throw new Error("not in this file");
  const stream = new Blob([bytes(packed)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function texture(name) {
  if (!recording.textures[name]) throw new Error("not in this file");
  return new Blob([bytes(recording.textures[name])], { type: "image/webp" });
}

window.urdfkitConnection = Offline;
window.urdfkitMesh = mesh;
window.urdfkitTexture = texture;
