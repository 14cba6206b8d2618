// The 3-D view: meshcat's viewer with our own light, ground, camera and theme.
/* global MeshCat */

const THREE = MeshCat.THREE;
const THEMES = {
  light: { sky: 0xeef1f5, major: 0xaab4c2, minor: 0xd3dae3, shadow: 0.22, hemisphere: 0.78 },
  dark: { sky: 0x161b23, major: 0x49566a, minor: 0x2a3340, shadow: 0.45, hemisphere: 0.7 },
};
const FOV = 42;

export class Stage {
  constructor(pane) {
    this.pane = pane;
    this.viewer = new MeshCat.Viewer(pane);
    this.viewer.gui.domElement.remove();
    this.viewer.set_3d_pane_size = () => this.resize(); // meshcat's own takes the window's height
    this.viewer.delete_path(["Lights"]); // they end ten metres from the origin
    this.viewer.delete_path(["Grid"]);
    this.viewer.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.radius = 0.5;
    this.followed = null;
    this.#light();
    this.#ground();
    this.viewer.camera.fov = FOV;
    this.viewer.controls.enableDamping = false;
    this.viewer.controls.maxPolarAngle = Math.PI * 0.98;
    this.viewer.controls.addEventListener("change", () => this.#haze());
    this.visible("Axes", false);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.theme(dark.matches));
    this.theme(dark.matches);
    new ResizeObserver(() => this.resize()).observe(pane);
    this.resize();
  }

  dirty() {
    this.viewer.set_dirty();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.pane;
    if (!width || !height) return;
    this.viewer.camera.aspect = width / height;
    this.viewer.camera.updateProjectionMatrix();
    this.viewer.renderer.setSize(width, height);
    this.dirty();
  }

  theme(dark) {
    const theme = THEMES[dark ? "dark" : "light"];
    const scene = this.viewer.scene;
    scene.background = new THREE.Color(theme.sky);
    scene.fog = new THREE.Fog(theme.sky, 1, 10);
    this.hemisphere.intensity = theme.hemisphere;
    this.shade.material.opacity = theme.shadow;
    this.major.material.color.set(theme.major);
    this.minor.material.color.set(theme.minor);
    this.#haze();
    this.dirty();
  }

  visible(name, shown) {
    if (name === "Grid") this.major.visible = this.minor.visible = shown;
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
    this.shade = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), new THREE.ShadowMaterial({ opacity: 0.25, fog: false }));
    this.shade.receiveShadow = true;
    this.shade.position.z = -0.001;
    this.ground.add(this.shade);
    this.#grid(1);
  }

  // Squares of `cell` metres, every fifth line stronger.
  #grid(cell) {
    if (cell === this.cell) return;
    const colours = this.cell ? [this.major.material.color, this.minor.material.color] : [0x888888, 0xbbbbbb];
    const shown = this.cell ? this.major.visible : true;
    for (const old of [this.major, this.minor]) {
      if (old) this.ground.remove(old), old.geometry.dispose(), old.material.dispose();
    }
    this.cell = cell;
    const lines = (step, count, colour, z) => {
      const points = [];
      const half = (step * count) / 2;
      for (let i = 0; i <= count; i++) {
        const at = i * step - half;
        points.push(-half, at, z, half, at, z, at, -half, z, at, half, z);
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
      const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: colour }));
      grid.visible = shown;
      this.ground.add(grid);
      return grid;
    };
    this.minor = lines(cell, 250, colours[1], -0.0004);
    this.major = lines(cell * 5, 50, colours[0], 0);
  }

  // Lines fade with distance, so that the ground has no end and no flicker.
  #haze() {
    const distance = this.viewer.camera.position.distanceTo(this.viewer.controls.target);
    this.viewer.scene.fog.near = distance * 1.6;
    this.viewer.scene.fog.far = Math.min(distance * 6 + 4 * this.cell, this.cell * 100);
  }

  /** Look at the robot from a good distance. `direction` points from it to the camera, z up. */
  fit(robot, direction, zoom = 1) {
    robot.updateWorldMatrix(true, true);
    const box = new THREE.Box3().setFromObject(robot);
    if (box.isEmpty()) return false;
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const radius = (this.radius = Math.max(sphere.radius, 0.02));
    this.#grid(radius < 1.2 ? 0.2 : radius < 6 ? 1 : 5);
    const { camera, controls } = this.viewer;
    const narrow = Math.min(1, camera.aspect);
    const distance = (radius / Math.sin((FOV * Math.PI) / 360) / narrow) * 1.12 * zoom;
    const [x, y, z] = direction;
    const towards = new THREE.Vector3(x, z, -y).normalize();
    controls.target.copy(sphere.center);
    camera.position.copy(sphere.center).addScaledVector(towards, distance);
    camera.near = radius / 50;
    camera.far = Math.max(200, radius * 200);
    controls.minDistance = radius / 10;
    controls.maxDistance = radius * 60;
    const reach = radius * 2.2;
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.01, far: radius * 12 });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.#haze();
    controls.update();
    this.dirty();
    return true;
  }

  /** Tell where the root link is [m, z up]; light and ground go with it, the camera too if it should. */
  at(x, y, z, follow) {
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
