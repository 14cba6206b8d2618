// The 3-D viewport: meshcat's viewer with its own light, ground, camera and theme.
/* global MeshCat */

import { DrawingBudget } from "./drawing_budget.js";
import { soft, sparing } from "./graphics_device.js";
import { gridMaterial } from "./ground_grid.js";
import { GroundPlanes } from "../appearance/ground_planes.js";
import { SunShadow } from "../appearance/sun_shadow.js";
import { studio, SUN } from "../appearance/surfaces.js";
import { light, WorldLight } from "../appearance/world_light.js";

const THREE = MeshCat.THREE;
const THEMES = {
  light: { sky: 0xeef1f5, major: 0xaab4c2, minor: 0xd3dae3, shadow: 0.3, floor: 0.6 },
  dark: { sky: 0x161b23, major: 0x49566a, minor: 0x2a3340, shadow: 0.5, floor: 0.25 },
};
const FOV = 42;
const ROOM = 1.3; // factor by which a robot may outgrow the fitted view
const PATIENCE = 2500; // ms after which an incomplete scene is drawn

export class Viewport {
  constructor(pane) {
    this.pane = pane;
    this.viewer = sparing(() => new MeshCat.Viewer(pane));
    this.viewer.gui.domElement.remove();
    this.viewer.set_3d_pane_size = () => this.resize(); // meshcat's version uses the height of the window
    this.viewer.delete_path(["Lights"]); // they end ten metres from the origin
    this.viewer.delete_path(["Grid"]);
    this.viewer.renderer.setPixelRatio(soft ? 1 : Math.min(devicePixelRatio, 2));
    this.viewer.renderer.shadowMap.autoUpdate = false; // shadows change when objects move, not when the camera moves
    this.budget = new DrawingBudget(this);
    this.#wait();
    this.radius = 0.5;
    this.floor = 0; // height of the ground [m]
    this.followed = null;
    this.aspect = 1;
    this.#light();
    this.#ground();
    this.viewer.camera.fov = FOV;
    this.viewer.controls.enableDamping = false;
    this.viewer.controls.maxPolarAngle = Math.PI * 0.98;
    this.viewer.controls.addEventListener("start", () => this.budget.hold(true));
    this.viewer.controls.addEventListener("end", () => this.budget.hold(false));
    this.viewer.controls.addEventListener("change", () => {
      this.budget.motion();
      this.haze();
    });
    this.visible("Axes", false);
    this.theme(matchMedia("(prefers-color-scheme: dark)").matches);
    new ResizeObserver(() => this.resize()).observe(pane);
    this.resize();
  }

  /** Mark the scene as changed, so that it is drawn again with its shadows. */
  dirty() {
    this.viewer.renderer.shadowMap.needsUpdate = true;
    this.viewer.set_dirty();
  }

  // An empty scene is not drawn, because that would delay the robot.
  #wait() {
    const render = this.viewer.render.bind(this.viewer);
    this.empty = true;
    this.viewer.render = () => {
      if (this.empty) return;
      this.budget.draw(() => {
        if (this.viewer.renderer.shadowMap.needsUpdate) this.#relight();
        render();
      });
    };
    setTimeout(() => this.begin(), PATIENCE);
  }

  begin() {
    this.empty = false;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.pane;
    if (!width || !height) return;
    this.aspect = width / height;
    this.#frame();
    this.viewer.renderer.setSize(width, height);
    this.dirty();
  }

  /** Draw one frame of this size [px] at once; `resize` restores the size of the pane. */
  draw(width, height) {
    this.aspect = width / height;
    this.#frame();
    this.viewer.renderer.setSize(width, height, false);
    this.dirty();
    this.budget.until = 0;
    this.viewer.render();
  }

  // The frustum of the camera; for an orthographic one, `halfHeight` metres above and below its centre.
  #frame() {
    const { camera } = this.viewer;
    if (camera.isOrthographicCamera) {
      const half = camera.userData.halfHeight ?? this.radius;
      Object.assign(camera, { top: half, bottom: -half, left: -half * this.aspect, right: half * this.aspect });
    } else {
      camera.aspect = this.aspect;
    }
    camera.updateProjectionMatrix();
  }

  theme(dark) {
    const theme = THEMES[dark ? "dark" : "light"];
    const scene = this.viewer.scene;
    this.sky = new THREE.Color(theme.sky);
    scene.background = this.world?.background ?? this.sky;
    this.shade.material.opacity = theme.shadow;
    const { major, minor } = this.grid.material.uniforms;
    major.value.set(theme.major);
    minor.value.set(theme.minor);
    this.planes.share.value = theme.floor;
    this.dirty();
  }

  /** Show shadows, or draw without them. */
  shadows(shown) {
    // The ground is transparent but for shadows, which those of bulbs and spots would make too dark. Planes of the world
    // have their own in its light.
    this.shade.visible = shown && !(this.world && (this.planes.some || this.world.casters.some(({ kind }) => kind > 0)));
    this.sunShadow.sun.castShadow = shown;
    for (const caster of this.world?.casters ?? []) caster.light.castShadow = shown;
  }

  /** Light the scene as the cameras of a world do, or by the studio (null). */
  lightBy(message) {
    this.world?.dispose();
    this.world = message && new WorldLight(this.viewer, message);
    for (const each of this.studio) each.visible = !message;
    this.planes.light(Boolean(message));
    this.viewer.scene.background = this.world?.background ?? this.sky;
    this.shadows(this.budget.used === 0);
    this.dirty();
  }

  // Meshes that have arrived get the light too.
  #relight() {
    light(this.viewer.scene, this.world?.code ?? null);
    if (!this.world) this.sunShadow.fit();
    for (const caster of this.world?.casters ?? []) caster.fit();
  }

  visible(name, shown) {
    if (name === "Grid") this.grid.visible = shown;
    else if (name === "Ground") this.#showPlanes(shown);
    else this.viewer.scene_tree.find([name]).object.visible = shown;
    this.dirty();
  }

  #showPlanes(shown) {
    this.planes.group.visible = shown;
    this.shadows(this.budget.used === 0);
  }

  #light() {
    // The children of the scene use the axes of the robot, z up.
    const { sky, fill, sun } = studio();
    this.viewer.scene.add(sky, fill, sun, sun.target);
    this.studio = [sky, fill, sun];
    this.sunShadow = new SunShadow(this.viewer, sun, SUN);
  }

  #ground() {
    this.ground = new THREE.Group();
    this.viewer.scene.add(this.ground);
    this.shade = new THREE.Mesh(new THREE.PlaneGeometry(400, 400), new THREE.ShadowMaterial({ opacity: 0.25 }));
    this.shade.receiveShadow = true;
    this.grid = new THREE.Mesh(new THREE.PlaneGeometry(400, 400), gridMaterial());
    this.grid.renderOrder = -1;
    this.ground.add(this.shade, this.grid);
    this.planes = new GroundPlanes(this.viewer, this.grid.material.uniforms.reach);
    this.cell = 1;
  }

  /** Fade the grid with distance in a perspective view, which hides its edge and flicker. */
  haze() {
    const { camera, controls } = this.viewer;
    const distance = camera.isOrthographicCamera ? 1e6 : camera.position.distanceTo(controls.target);
    this.grid.material.uniforms.reach.value = distance * 5 + 4 * this.cell;
  }

  /** Camera distance that fits a box [m]. */
  distance(box, zoom = 1) {
    const radius = Math.max(box.getBoundingSphere(new THREE.Sphere()).radius, 0.02);
    return (radius / Math.sin((FOV * Math.PI) / 360) / Math.min(1, this.aspect)) * 1.12 * zoom;
  }

  /** Fit the view to a box. `direction` points from the box to the camera, z up; null keeps the current direction. */
  fit(box, direction = null, zoom = 1) {
    if (box.isEmpty()) return false;
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const radius = (this.radius = Math.max(sphere.radius, 0.02));
    this.cell = this.grid.material.uniforms.cell.value = radius < 1.2 ? 0.2 : radius < 6 ? 1 : 5;
    const { camera, controls } = this.viewer;
    const narrow = Math.min(1, this.aspect);
    const distance = this.distance(box, zoom);
    const towards = camera.position.clone().sub(controls.target);
    if (camera.isOrthographicCamera) {
      towards.set(0, 1, 0);
      camera.userData.halfHeight = ((radius * 1.12) / narrow) * zoom;
      camera.zoom = 1;
      this.#frame();
    } else if (direction) towards.set(direction[0], direction[2], -direction[1]);
    towards.normalize();
    controls.target.copy(sphere.center);
    camera.position.copy(sphere.center).addScaledVector(towards, distance);
    camera.near = radius / 50;
    camera.far = Math.max(200, radius * 200);
    controls.minDistance = radius / 10;
    controls.maxDistance = radius * 60;
    this.haze();
    controls.update();
    this.fitted = { sphere, place: this.#place() };
    this.begin();
    this.dirty();
    return true;
  }

  /** Whether a box is outside of the last fitted view, or small in it, and the camera has not been moved since. */
  outgrown(box) {
    if (!this.fitted || box.isEmpty() || this.#place() !== this.fitted.place) return false;
    const { center, radius } = box.getBoundingSphere(new THREE.Sphere());
    const before = this.fitted.sphere;
    return before.center.distanceTo(center) + radius > ROOM * before.radius || radius * ROOM * ROOM < before.radius;
  }

  #place() {
    const { camera, controls } = this.viewer;
    return [...camera.position.toArray(), ...controls.target.toArray(), camera.isOrthographicCamera ? camera.zoom : 0].map((x) => x.toPrecision(4)).join();
  }

  /** Set the position of the root link [m, z up]; light, ground and optionally the camera follow it. */
  at(x, y, z, follow) {
    const stands = [x, y, z, this.radius, follow, this.floor];
    if (this.stands?.every((value, i) => value === stands[i])) return;
    this.stands = stands;
    const major = this.cell * 5;
    this.ground.position.set(Math.round(x / major) * major, Math.round(y / major) * major, this.floor);
    if (follow && this.followed) {
      const [fx, fy, fz] = this.followed;
      const move = new THREE.Vector3(x - fx, z - fz, -(y - fy));
      this.viewer.camera.position.add(move);
      this.viewer.controls.target.add(move);
    }
    this.followed = [x, y, z];
    this.dirty();
  }
}
