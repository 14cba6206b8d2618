// Placeholders: hatched boxes in place of shapes that cannot be shown.
/* global MeshCat */

const THREE = MeshCat.THREE;
const TILE = 32; // pixels
const TILES = 5; // along the longest edge
const DARK = 0x5c3a00;
let stripes = null;

/** A tile with a diagonal stripe, which continues in the next tile. */
function hatch() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = TILE;
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#f1d9a8";
  pen.fillRect(0, 0, TILE, TILE);
  pen.strokeStyle = "#e08700";
  pen.lineWidth = 0.3 * TILE;
  for (const shift of [-TILE, 0, TILE]) {
    pen.beginPath();
    pen.moveTo(shift - TILE, 2 * TILE);
    pen.lineTo(shift + 2 * TILE, -TILE);
    pen.stroke();
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  return texture;
}

/** A hatched box. @param size edges along x, y and z [m]; @param opacity 0..1 */
export function placeholder({ size, opacity }) {
  stripes ??= hatch();
  const geometry = new THREE.BoxGeometry(...size);
  const [x, y, z] = size;
  const faces = [[z, y], [z, y], [x, z], [x, z], [x, y], [x, y]]; // width and height in the order of BoxGeometry
  const tile = Math.max(...size) / TILES;
  const uv = geometry.getAttribute("uv");
  for (let i = 0; i < uv.count; i++) {
    const [width, height] = faces[Math.floor(i / 4)];
    uv.setXY(i, (uv.getX(i) * width) / tile, (uv.getY(i) * height) / tile);
  }
  const box = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ map: stripes, opacity, transparent: opacity < 1, depthWrite: opacity === 1 }));
  const edges = new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({ color: DARK }));
  edges.raycast = () => {}; // only faces are picked
  box.add(edges);
  return box;
}
