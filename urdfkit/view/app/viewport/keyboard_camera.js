// Keyboard control of the camera while the viewport has the focus: arrows rotate, with Shift they pan, + and - zoom.
/* global MeshCat */

const THREE = MeshCat.THREE;
const STEP = Math.PI / 24;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function steering(page) {
  const { pane, viewer } = page.viewport;
  pane.addEventListener("keydown", (event) => {
    if (page.mode !== "view" || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in ARROWS) {
      const [x, y] = ARROWS[event.key];
      if (event.shiftKey || viewer.camera.isOrthographicCamera) move(x, y);
      else turn(x, y);
    } else if (event.key === "+" || event.key === "=") zoom(1 / 1.15);
    else if (event.key === "-") zoom(1.15);
    else return;
    event.preventDefault();
    event.stopPropagation();
    page.viewport.haze();
    page.viewport.dirty();
  });
  for (const [key, does] of [["← →", "rotate the view; with Shift, pan it"], ["+ -", "zoom"]]) {
    page.shortcut({ key, does: `${does} (viewport focused)`, group: "View", run: () => false });
  }

  function turn(x, y) {
    if (page.cameras.way === "first") return page.cameras.first.turn(-x * STEP, y * STEP);
    const { camera, controls } = viewer;
    const at = new THREE.Spherical().setFromVector3(camera.position.clone().sub(controls.target));
    at.theta += x * STEP;
    at.phi = Math.max(0.02, Math.min(Math.PI * 0.97, at.phi + y * STEP));
    camera.position.copy(controls.target).add(new THREE.Vector3().setFromSpherical(at));
  }

  function move(x, y) {
    const { camera, controls } = viewer;
    const step = 0.12 * page.viewport.radius;
    const [right, up] = [new THREE.Vector3(), new THREE.Vector3()];
    camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
    const by = right.multiplyScalar(x * step).addScaledVector(up, -y * step);
    camera.position.add(by);
    controls.target.add(by);
  }

  function zoom(factor) {
    const { camera, controls } = viewer;
    if (camera.isOrthographicCamera) camera.zoom /= factor;
    else camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
  }
}
