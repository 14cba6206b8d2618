// Motions that a link loses in a singular configuration: arrows along a translation, a ring with arrows about a rotation.
/* global MeshCat */

const THREE = MeshCat.THREE;
const COLOUR = 0xd6249f;
const LEAST = 0.1; // part of a motion, relative to its largest, that is shown; as in urdfkit/kinematics/jacobian_analysis.py

export class LostMotions extends THREE.Group {
  constructor() {
    super();
    this.visible = false;
    this.paint = new THREE.MeshBasicMaterial({ color: COLOUR, opacity: 0.9, transparent: true, depthTest: false });
  }

  /** Show motions: {direction: linear and angular part in the axes of the root link}; `root` is the turn of that link. */
  show(motions, root) {
    for (const child of [...this.children]) {
      this.remove(child);
      child.geometry.dispose();
    }
    for (const { direction } of motions) {
      const largest = Math.max(...direction.map(Math.abs));
      const [linear, angular] = [direction.slice(0, 3), direction.slice(3)].map((part) => new THREE.Vector3(...part));
      if (linear.length() > LEAST * largest) this.#arrows(linear.applyQuaternion(root).normalize());
      if (angular.length() > LEAST * largest) this.#ring(angular.applyQuaternion(root).normalize());
    }
    this.visible = this.children.length > 0;
  }

  #arrows(along) {
    for (const sign of [1, -1]) {
      const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().multiplyScalar(sign));
      this.#add(new THREE.CylinderGeometry(0.035, 0.035, 1.3, 10).translate(0, 0.65, 0), turn);
      this.#add(new THREE.ConeGeometry(0.11, 0.3, 16).translate(0, 1.45, 0), turn);
    }
  }

  #ring(about) {
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), about);
    this.#add(new THREE.TorusGeometry(0.95, 0.035, 8, 48, 1.6 * Math.PI), turn);
    const end = [Math.cos(1.6 * Math.PI), Math.sin(1.6 * Math.PI)].map((x) => 0.95 * x);
    this.#add(new THREE.ConeGeometry(0.11, 0.3, 16).rotateZ(1.6 * Math.PI).translate(...end, 0), turn);
  }

  #add(geometry, turn) {
    const mesh = new THREE.Mesh(geometry, this.paint);
    mesh.renderOrder = 39;
    mesh.quaternion.copy(turn);
    mesh.raycast = () => {}; // the handle is behind it
    this.add(mesh);
  }
}
