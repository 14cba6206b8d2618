// The scene: executes meshcat commands, fetches each mesh once, applies packed poses.
/* global MeshCat */

import { decoded } from "../appearance/mesh_decoding.js";
import { keepTextures, texture } from "../appearance/textures.js";
import { unescaped } from "../connection/node_names.js";
import { Downloads } from "./downloads.js";
import { placeholder } from "./placeholders.js";

const THREE = MeshCat.THREE;
const HEADER = 16;
const FAINT = 0.14; // opacity of obstacles in front of the robot
const STILL = 1e-6; // [m] and quaternion components: smaller motions do not trigger a new frame

export class Scene {
  constructor(viewport) {
    this.viewport = viewport;
    this.viewer = viewport.viewer;
    this.meshes = new Map(); // content hash → promise of its parts, see mesh_decoding.js
    this.hidden = new Map(); // path → function that requests the mesh of a shape when it is shown
    this.used = new Set(); // meshes of the current robot
    this.textures = new Set(); // and their textures
    this.downloads = new Downloads();
    this.simplified = new Map(); // link → numbers of triangles [in the file, shown]
    this.groups = { visual: new Map(), collision: new Map() };
    this.shown = { visual: true, collision: false };
    this.look = { wireframe: false, opacity: 1, solid: false }; // solid: collision shapes are opaque and cast shadows
    this.faded = new Set(); // transparent obstacles
    this.byLink = new Map(); // name → node
    this.linkOf = new Map(); // node → name
    this.generation = 0;
    this.nodes = [];
    this.own = [];
    this.model = -1;
    this.pending = null;
    this.placed = null; // the last applied poses
    const original = this.viewer.handle_command.bind(this.viewer);
    this.viewer.handle_command = (command) => this.#command(command, original);
  }

  command(bytes) {
    this.viewport.dirty();
    this.viewer.handle_command_bytearray(bytes);
  }

  #command(command, original) {
    const path = command.path.split("/").filter(Boolean);
    if (command.type === "delete" && path.length === 1) {
      this.generation += 1;
      this.used = new Set();
      this.textures = new Set();
      this.simplified.clear();
    }
    if (command.type === "delete") this.#forget(path.join("/"));
    const geometry = command.type === "set_object" ? command.object.geometries?.[0] : null;
    if (geometry?.type === "_placeholder") this.viewer.set_object(path, placeholder(geometry));
    else if (geometry?.type === "_shared") this.#shared(path, command.object, geometry.name);
    else original(command);
    if (command.type === "set_object") this.#group(path);
  }

  #forget(above) {
    for (const groups of Object.values(this.groups)) {
      for (const path of groups.keys()) if (path === above || path.startsWith(`${above}/`)) groups.delete(path);
    }
    for (const path of this.hidden.keys()) if (path.startsWith(`${above}/`)) this.hidden.delete(path);
  }

  #group(path) {
    const role = path[3];
    if (path[0] !== "robot" || !(role in this.groups)) return;
    const group = this.viewer.scene_tree.find(path.slice(0, 4)).object;
    this.groups[role].set(path.slice(0, 4).join("/"), group);
    group.visible = this.shown[role];
    if (role === "collision") group.traverse((object) => (object.castShadow = false));
    this.#style(group);
  }

  // Wireframe and opacity override the material of the description, which is stored.
  #style(group) {
    group.traverse((object) => {
      const { material } = object;
      if (!material) return;
      material.userData.opacity ??= material.opacity;
      material.wireframe = this.look.wireframe;
      const solid = this.look.solid && group.name === "collision";
      if (solid) object.castShadow = object.receiveShadow = true;
      material.opacity = (solid ? 1 : material.userData.opacity) * this.look.opacity * (this.faded.has(object) ? FAINT : 1);
      material.userData.clear ??= material.transparent; // by its texture or the colours of its vertices
      const clear = material.opacity < 1 || material.userData.clear;
      if (material.transparent !== clear) Object.assign(material, { transparent: clear, needsUpdate: true });
      material.depthWrite = !(material.opacity < 1);
    });
  }

  /** Set the style of all shapes. @param look {wireframe, opacity} with opacity in 0..1 */
  restyle(look) {
    Object.assign(this.look, look);
    for (const groups of Object.values(this.groups)) for (const group of groups.values()) this.#style(group);
    this.viewport.dirty();
  }

  /** Make these meshes transparent, and restore all others. */
  fade(meshes) {
    const before = this.faded;
    const changed = [...meshes, ...before].filter((mesh) => meshes.has(mesh) !== before.has(mesh));
    this.faded = meshes;
    for (const mesh of changed) this.#style(mesh);
    if (changed.length) this.viewport.dirty();
  }

  show(role, shown) {
    this.shown[role] = shown;
    if (shown) for (const [path, request] of [...this.hidden]) if (path.split("/")[3] === role) request();
    for (const group of this.groups[role].values()) group.visible = shown;
    this.viewport.dirty();
  }

  // The mesh of a hidden role is requested when the role is shown.
  #shared(path, object, name) {
    const key = path.join("/");
    this.used.add(name);
    const generation = this.generation;
    const request = () => {
      this.hidden.delete(key);
      if (generation === this.generation) this.#request(path, object, name);
    };
    if (this.shown[path[3]] === false) this.hidden.set(key, request);
    else request();
  }

  #request(path, object, name) {
    const generation = this.generation;
    const task = this.mesh(name)
      .then(async (parts) => {
        const shape = new THREE.Group();
        for (const part of parts) shape.add(await this.#part(part, object.materials[0]));
        if (generation !== this.generation) return; // the robot was replaced in the meantime
        this.#count(path, parts);
        for (const mesh of shape.children) Object.assign(mesh, { castShadow: path[3] !== "collision", receiveShadow: true });
        this.viewer.set_object(path, shape.children.length === 1 ? shape.children[0] : shape);
        const group = this.groups[path[3]]?.get(path.slice(0, 4).join("/"));
        if (group) this.#style(group);
        const node = this.byLink.get(this.owner(group ?? shape));
        if (node) delete node.userData.middle; // its centre has changed
        this.arrived?.(shape);
        this.viewport.dirty();
      })
      .catch((error) => console.warn(`mesh ${name.slice(0, 8)}: ${error.message}`));
    this.downloads.add(task, unescaped(path[2]).replace(/^world\//, ""));
  }

  #count(path, { simplifiedFrom, triangles }) {
    if (path[3] === "visual" && simplifiedFrom) this.simplified.set(unescaped(path[2]), [simplifiedFrom, triangles]);
  }

  async #part({ geometry, texture: name, clear, gloss }, written) {
    const material = new THREE.MaterialLoader().parse(written);
    material.userData = { gloss, ...written.userData }; // without a colour of its own, a shape has the gloss of its mesh
    if (clear) Object.assign(material, { transparent: true });
    if (name) {
      this.textures.add(name);
      const map = await texture(name).catch(() => null); // without its image, the surface has its plain colour
      if (map) Object.assign(material, { map, vertexColors: false });
    }
    return new THREE.Mesh(geometry, material);
  }

  /** Return a promise of the parts of a mesh, see mesh_decoding.js. */
  mesh(name) {
    if (!this.meshes.has(name)) {
      const mesh = (window.urdfkitMesh ?? ((each) => this.#fetched(each)))(name).then(decoded);
      mesh.catch(() => this.meshes.delete(name));
      this.meshes.set(name, mesh);
    }
    return this.meshes.get(name);
  }

  async #fetched(name) {
    const answer = await fetch(`/geometry/${name}${location.search}`); // a page in a frame sends its token
    if (!answer.ok) throw new Error(`${answer.status}`);
    this.downloads.received(Number(answer.headers.get("content-length")));
    return answer.arrayBuffer();
  }

  /** Resolves when all requested meshes are loaded. */
  async settled() {
    if (!this.groups.visual.size) for (const request of [...this.hidden.values()]) request(); // for `bounds`
    await this.downloads.finished();
    keepTextures(this.textures);
  }

  /** Bounding box of the robot without world and markers; of everything if the robot has no shapes. */
  bounds() {
    const box = new THREE.Box3();
    for (const node of this.own) node.updateWorldMatrix(true, true);
    for (const role of ["visual", "collision"]) {
      if (box.isEmpty()) for (const group of this.#groupsOf(role, this.own)) box.expandByObject(group);
    }
    if (box.isEmpty()) for (const node of this.own) box.expandByPoint(node.getWorldPosition(new THREE.Vector3()));
    const size = box.getSize(new THREE.Vector3()).length();
    if (!(size > 0)) box.setFromObject(this.viewer.scene_tree.find(["robot"]).object);
    return box;
  }

  /** Height of the lowest vertex of the robot [m]; 0 without shapes. */
  lowest() {
    let [lowest, point] = [Infinity, new THREE.Vector3()];
    const add = (object) => {
      const position = object.isMesh && object.geometry.getAttribute("position");
      for (let i = 0; i < (position?.count ?? 0); i++) {
        lowest = Math.min(lowest, point.fromBufferAttribute(position, i).applyMatrix4(object.matrixWorld).y);
      }
    };
    for (const node of this.own) node.updateWorldMatrix(true, true);
    for (const group of this.#groupsOf(this.bare ? "collision" : "visual", this.own)) group.traverse(add);
    return Number.isFinite(lowest) ? lowest : 0;
  }

  /** Whether the robot has collision shapes only. */
  get bare() {
    return !this.#groupsOf("visual", this.own).length && this.#groupsOf("collision", this.own).length > 0;
  }

  #groupsOf(role, nodes) {
    const wanted = new Set(nodes);
    return [...this.groups[role].values()].filter((group) => wanted.has(group.parent));
  }

  /** The groups of shapes of a link. @param role "visual" or "collision", or both */
  shapes(link, role = null) {
    const node = this.byLink.get(link);
    const roles = role ? [role] : Object.keys(this.groups);
    return node ? roles.flatMap((each) => this.#groupsOf(each, [node])) : [];
  }

  /** Centre of the shapes of a link, in its frame. */
  middle(link) {
    const [node, box] = [this.byLink.get(link), new THREE.Box3()];
    for (const group of this.shapes(link)) box.expandByObject(group);
    return box.isEmpty() ? new THREE.Vector3() : node.worldToLocal(box.getCenter(new THREE.Vector3()));
  }

  /** All objects that can be picked. */
  get solid() {
    return Object.values(this.groups).flatMap((groups) => [...groups.values()]).filter((group) => group.visible);
  }

  /** The link an object belongs to, or null. */
  owner(object) {
    for (let at = object; at; at = at.parent) if (this.linkOf.has(at)) return this.linkOf.get(at);
    return null;
  }

  /** The nodes that poses move, in the order of the rows of a pose frame. */
  use(model) {
    this.model = model.number;
    this.nodes = model.nodes.map((path) => this.viewer.scene_tree.find(path.split("/").filter(Boolean)).object);
    const names = model.nodes.map((path) => unescaped(path.split("/").pop()));
    this.byLink = new Map(this.nodes.map((node, i) => [names[i], node]));
    this.linkOf = new Map(this.nodes.map((node, i) => [node, names[i]]));
    // Names of links have no slash; names of world bodies do.
    this.own = this.nodes.filter((_, i) => !model.nodes[i].includes("/world%2F"));
    this.placed = null; // a pending frame of the model before is acknowledged all the same, or no other would follow
    for (const name of this.meshes.keys()) this.used.has(name) || this.meshes.delete(name);
  }

  /** Store a pose frame until the next frame is drawn; then `applied(sequence, time)` is called. */
  poses(frame, applied) {
    const idle = this.pending === null;
    this.pending = frame;
    if (idle) requestAnimationFrame(() => this.#apply(applied));
  }

  #apply(applied) {
    const frame = this.pending;
    this.pending = null;
    if (frame === null) return;
    const view = new DataView(frame);
    const sequence = view.getUint32(4, true);
    const time = view.getFloat64(8, true);
    if (view.getUint8(1) === this.model && view.getUint16(2, true) === this.nodes.length) {
      this.#place(new Float32Array(frame, HEADER));
    }
    applied(sequence, time);
  }

  #place(values) {
    if (this.placed?.every((value, i) => Math.abs(value - values[i]) < STILL)) return;
    this.placed = values;
    this.viewport.budget.motion();
    this.nodes.forEach((node, i) => {
      const at = 7 * i;
      node.position.set(values[at], values[at + 1], values[at + 2]);
      node.quaternion.set(values[at + 3], values[at + 4], values[at + 5], values[at + 6]);
    });
    this.viewport.dirty();
  }
}
