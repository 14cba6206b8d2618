// The shadow of the sun covers everything that casts one, so that no shadow is cut off, however far a robot drives.
/* global MeshCat */

import { soft } from "../viewport/graphics_device.js";

const THREE = MeshCat.THREE;
const LARGEST = 60; // [m]; shadows of larger scenes end there

export class SunShadow {
  /** `towards`: direction of the sun, z up. */
  constructor(viewer, sun, towards) {
    Object.assign(this, { viewer, sun, towards });
    sun.castShadow = true;
    const edge = soft ? 1024 : 4096;
    sun.shadow.mapSize.set(edge, edge);
    sun.shadow.radius = soft ? 2 : 4;
    viewer.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  }

  /** Fit the shadow to the shapes. */
  fit() {
    const { sun } = this;
    const box = new THREE.Box3();
    const robot = this.viewer.scene_tree.find(["robot"]).object;
    robot.updateWorldMatrix(true, true);
    robot.traverseVisible((object) => {
      if (object.isMesh && object.castShadow) box.union(shadowed(object));
    });
    if (box.isEmpty()) return;
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const radius = Math.min(Math.max(sphere.radius, 0.05), LARGEST);
    const { x, y, z } = sphere.center;
    sun.target.position.set(x, -z, y); // the world of three.js has y up
    sun.position.copy(sun.target.position).addScaledVector(this.towards, 2 * radius);
    Object.assign(sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.5 * radius, far: 8 * radius });
    sun.shadow.camera.updateProjectionMatrix();
    const texel = (2 * radius) / sun.shadow.mapSize.x;
    sun.shadow.bias = -0.0002;
    sun.shadow.normalBias = 1.5 * texel;
  }
}

function shadowed(mesh) {
  if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
  return mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrixWorld);
}
