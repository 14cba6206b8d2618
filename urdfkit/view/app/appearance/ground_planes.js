// Planes of the world, such as its ground: in the studio they fade with distance, in the light of the world they do not.
/* global MeshCat */

const THREE = MeshCat.THREE;

export class GroundPlanes {
  /** @param reach uniform: the distance [m] at which planes have faded */
  constructor(viewer, reach) {
    this.viewer = viewer;
    this.reach = reach;
    this.share = { value: 1 }; // opacity of near parts in the studio
    this.group = new THREE.Group();
    viewer.scene.add(this.group);
    this.hasWorldLight = false;
  }

  get some() {
    return this.group.visible && this.group.children.length > 0;
  }

  /** Replace the planes. @param planes [{pose (4 × 4, by rows), size [m], color (0..1, with opacity)}] */
  use(planes) {
    for (const { geometry, material, userData } of this.group.children) {
      geometry.dispose();
      for (const each of [material, userData.other]) each.dispose();
    }
    this.group.clear();
    for (const { pose, size, color } of planes) {
      const mesh = new THREE.Mesh(new THREE.PlaneGeometry(...size), this.#studio(color));
      // Below the shadows and the grid, which are at the same height.
      Object.assign(mesh, { renderOrder: -2, receiveShadow: true, matrixAutoUpdate: false });
      mesh.userData.other = new THREE.MeshStandardMaterial({ color: new THREE.Color(...color), opacity: color[3], transparent: true, depthWrite: false });
      mesh.matrix.fromArray(pose).transpose();
      this.group.add(mesh);
    }
    if (this.hasWorldLight) this.#exchange();
  }

  /** Light the planes by the lights of the world, or by the studio. */
  light(isWorld) {
    if (isWorld !== this.hasWorldLight) this.#exchange();
    this.hasWorldLight = isWorld;
  }

  #exchange() {
    for (const mesh of this.group.children) [mesh.material, mesh.userData.other] = [mesh.userData.other, mesh.material];
  }

  #studio([r, g, b, a]) {
    return new THREE.ShaderMaterial({
      transparent: true,
      depthWrite: false,
      uniforms: { color: { value: new THREE.Vector4(r, g, b, a) }, reach: this.reach, share: this.share },
      vertexShader: `
        varying vec3 seen;
        void main() {
          vec4 view = modelViewMatrix * vec4(position, 1.0);
          seen = view.xyz;
          gl_Position = projectionMatrix * view;
        }`,
      fragmentShader: `
        uniform vec4 color;
        uniform float reach, share;
        varying vec3 seen;
        void main() {
          gl_FragColor = vec4(color.rgb, color.a * share * (1.0 - smoothstep(0.3 * reach, reach, length(seen))));
        }`,
    });
  }
}

export function groundPlanes(page) {
  const { viewport } = page;
  page.on("planes", ({ planes }) => {
    viewport.planes.use(planes);
    document.getElementById("show-ground").closest("label").hidden = planes.length === 0;
    viewport.shadows(viewport.budget.used === 0);
    viewport.dirty();
  });
}
