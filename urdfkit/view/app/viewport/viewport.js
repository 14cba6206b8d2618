// The 3-D view: meshcat's viewer with our own light, ground, camera and theme.
/* global MeshCat */

import { soft, sparing } from "./graphics_device.js";
import { gridMaterial } from "./ground_grid.js";

const THREE = MeshCat.THREE;
const THEMES = {
  light: { sky: 0xeef1f5, major: 0xaab4c2, minor: 0xd3dae3, shadow: 0.22, hemisphere: 0.78 },
  dark: { sky: 0x161b23, major: 0x49566a, minor: 0x2a3340, shadow: 0.45, hemisphere: 0.7 },
};
const FOV = 42;
const ROOM = 1.3; // how much larger than when the view was fitted a robot may be
const PATIENCE = 2500; // ms after which what there is is drawn, though the robot has not come yet

export class Stage {
  constructor(pane) {
    this.pane = pane;
    this.viewer = sparing(() => new MeshCat.Viewer(pane));
    this.viewer.gui.domElement.remove();
    this.viewer.set_3d_pane_size = () => this.resize(); // meshcat's own takes the window's height
    this.viewer.delete_path(["Lights"]); // they end ten metres from the origin
    this.viewer.delete_path(["Grid"]);
    this.viewer.renderer.setPixelRatio(soft ? 1 : Math.min(devicePixelRatio, 2));
    this.viewer.renderer.shadowMap.autoUpdate = false; // they change when something moves, not when one looks from elsewhere
    this.#wait();
    this.radius = 0.5;
    this.followed = null;
    this.aspect = 1;
    this.#light();
    this.#ground();
    this.viewer.camera.fov = FOV;
    this.viewer.controls.enableDamping = false;
    this.viewer.controls.maxPolarAngle = Math.PI * 0.98;
    this.viewer.controls.addEventListener("change", () => this.haze());
    this.visible("Axes", false);
    this.theme(matchMedia("(prefers-color-scheme: dark)").matches);
    new ResizeObserver(() => this.resize()).observe(pane);
    this.resize();
  }

  /** Something has changed: draw anew, shadows too. */
  dirty() {
    this.viewer.renderer.shadowMap.needsUpdate = true;
    this.viewer.set_dirty();
  }

  // An empty stage is not worth a picture: drawing it holds up the robot.
  #wait() {
    const render = this.viewer.render.bind(this.viewer);
    this.empty = true;
    this.viewer.render = () => void (this.empty || render());
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

  // What the camera's picture spans: of a parallel one `halfHeight` metres up and down from its middle.
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
    scene.background = new THREE.Color(theme.sky);
    this.hemisphere.intensity = theme.hemisphere;
    this.shade.material.opacity = theme.shadow;
    const { major, minor } = this.grid.material.uniforms;
    major.value.set(theme.major);
    minor.value.set(theme.minor);
    this.dirty();
  }

  visible(name, shown) {
    if (name === "Grid") this.grid.visible = shown;
    else this.viewer.scene_tree.find([name]).object.visible = shown;
    this.dirty();
  }

  #light() {
    // Children of the scene live in the robot's axes, z up.
    this.hemisphere = new THREE.HemisphereLight(0xffffff, 0x8f98a3, 0.75);
    this.hemisphere.position.set(0, 0, 1);
    const fill = new THREE.DirectionalLight(0xffffff, 0.22);
    fill.position.set(-3, -4, 2);
    this.sun = new THREE.DirectionalLight(0xffffff, 0.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 0.004;
    this.sun.shadow.radius = 3;
    this.viewer.scene.add(this.hemisphere, fill, this.sun, this.sun.target);
  }

  #ground() {
    this.ground = new THREE.Group();
    this.viewer.scene.add(this.ground);
    this.shade = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), new THREE.ShadowMaterial({ opacity: 0.25 }));
    this.shade.receiveShadow = true;
    this.grid = new THREE.Mesh(new THREE.PlaneGeometry(400, 400), gridMaterial());
    this.grid.renderOrder = -1;
    this.ground.add(this.shade, this.grid);
    this.cell = 1;
  }

  /** Lines of the grid fade with distance, so that the ground has no end and no flicker; seen in parallel they do not. */
  haze() {
    const { camera, controls } = this.viewer;
    const distance = camera.isOrthographicCamera ? 1e6 : camera.position.distanceTo(controls.target);
    this.grid.material.uniforms.reach.value = distance * 5 + 4 * this.cell;
  }

  /** From how far a box is well seen [m]. */
  distance(box, zoom = 1) {
    const radius = Math.max(box.getBoundingSphere(new THREE.Sphere()).radius, 0.02);
    return (radius / Math.sin((FOV * Math.PI) / 360) / Math.min(1, this.aspect)) * 1.12 * zoom;
  }

  /** Look at a box from a good distance. `direction` points from it to the camera, z up; none: from where it is now. */
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
    const reach = radius * 2.2;
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.01, far: radius * 12 });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.haze();
    controls.update();
    this.fitted = { sphere, place: this.#place() };
    this.begin();
    this.dirty();
    return true;
  }

  /** Whether a box is out of the picture of the last fit, or little in it, while nobody has moved the camera since. */
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

  /** Tell where the root link is [m, z up]; light and ground go with it, the camera too if it should. */
  at(x, y, z, follow) {
    const stands = [x, y, z, this.radius, follow];
    if (this.stands?.every((value, i) => value === stands[i])) return;
    this.stands = stands;
    const major = this.cell * 5;
    this.ground.position.set(Math.round(x / major) * major, Math.round(y / major) * major, 0);
    const r = this.radius;
    this.sun.target.position.set(x, y, z);
    this.sun.position.set(x + 1.6 * r, y - 1.2 * r, z + 5 * r);
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
