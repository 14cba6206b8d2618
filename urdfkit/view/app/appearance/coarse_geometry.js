// Coarse indices of dense meshes, for scenes that move while the processor draws: vertices in one cell are merged.
/* global MeshCat */

const THREE = MeshCat.THREE;
const DENSE = 3000; // triangles; meshes with fewer are drawn as they are
const CELLS = 24; // along the longest edge of the mesh
const indices = new WeakMap(); // geometry → {fine, coarse}

/** Draw dense meshes below an object with merged vertices, or as they are. */
export function coarsen(object, isCoarse) {
  object.traverse(({ geometry, material }) => {
    if (!(geometry?.index?.count > 3 * DENSE || indices.has(geometry))) return;
    if (!indices.has(geometry)) {
      if (!isCoarse || material.wireframe) return;
      indices.set(geometry, { fine: geometry.index, coarse: new THREE.BufferAttribute(merged(geometry), 1) });
    }
    geometry.setIndex(indices.get(geometry)[isCoarse ? "coarse" : "fine"]);
  });
}

// Vertices of one cell are merged if they face the same octant and their colours and texture coordinates are close.
function merged({ attributes, index }) {
  const { position, normal, color, uv } = attributes;
  const box = new THREE.Box3().setFromBufferAttribute(position);
  const size = box.getSize(new THREE.Vector3());
  const cell = Math.max(size.x, size.y, size.z) / CELLS || 1;
  const first = new Map();
  const of = new Uint32Array(position.count);
  for (let i = 0; i < position.count; i++) {
    let key = 0;
    for (const [value, low] of [[position.getX(i), box.min.x], [position.getY(i), box.min.y], [position.getZ(i), box.min.z]]) {
      key = key * (CELLS + 1) + Math.floor((value - low) / cell);
    }
    if (normal) key = key * 8 + 4 * (normal.getX(i) < 0) + 2 * (normal.getY(i) < 0) + (normal.getZ(i) < 0);
    if (uv) key = (key * 64 + (Math.floor(uv.getX(i) * 16) & 63)) * 64 + (Math.floor(uv.getY(i) * 16) & 63);
    if (color) for (let k = 0; k < 3; k++) key = key * 4 + (color.array[color.itemSize * i + k] >> 6);
    if (!first.has(key)) first.set(key, i);
    of[i] = first.get(key);
  }
  const found = new Uint32Array(index.count);
  let count = 0;
  for (let t = 0; t < index.count; t += 3) {
    const [a, b, c] = [of[index.getX(t)], of[index.getX(t + 1)], of[index.getX(t + 2)]];
    if (a === b || b === c || a === c) continue;
    found[count++] = a;
    found[count++] = b;
    found[count++] = c;
  }
  return found.slice(0, count);
}
