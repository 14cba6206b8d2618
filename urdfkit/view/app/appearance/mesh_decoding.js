// Decodes meshes of the server (content/mesh_encoding.py) into geometries, one per texture and gloss.
/* global MeshCat */

const THREE = MeshCat.THREE;

/** Return the parts of a packed mesh: [{geometry, texture: name or null, clear, gloss}], with `triangles` and `simplifiedFrom`. */
export function decoded(buffer) {
  const size = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
  const attributes = new Map();
  let index = null;
  let of = null; // row of the next stream that each vertex has
  let at = 4 + size;
  for (const stream of header.streams) {
    const content = new Uint8Array(buffer, at, stream.width * stream.rows * stream.bytes);
    at += content.length;
    const isIndex = stream.name === "index" || stream.name === "of";
    const table = planes(content, stream, !isIndex);
    if (stream.name === "index") index = indices(table);
    else if (isIndex) of = indices(table);
    else {
      attributes.set(stream.name, attribute(stream, of ? chosen(table, stream.width, of) : table));
      of = null;
    }
  }
  const parts = header.parts.map(({ first, count, texture, clear, gloss }) => {
    const geometry = new THREE.BufferGeometry();
    for (const [name, values] of attributes) geometry.setAttribute(name, values);
    const part = header.parts.length > 1 ? index.slice(3 * first, 3 * (first + count)) : index;
    geometry.setIndex(new THREE.BufferAttribute(part, 1));
    if (header.parts.length > 1) bound(geometry);
    return { geometry, texture, clear, gloss };
  });
  return Object.assign(parts, { triangles: header.triangles, simplifiedFrom: header.simplified_from });
}

// Byte planes, column by column; differences between rows are summed.
function planes(content, { width, rows, bytes }, isDelta) {
  const table = new Int32Array(width * rows);
  for (let column = 0; column < width; column++) {
    let sum = 0;
    for (let row = 0; row < rows; row++) {
      let value = 0;
      for (let k = bytes - 1; k >= 0; k--) value = (value << 8) | content[(column * bytes + k) * rows + row];
      if (isDelta) value = sum += (value >>> 1) ^ -(value & 1);
      table[row * width + column] = value;
    }
  }
  return table;
}

function indices(codes) {
  const found = new Uint32Array(codes.length);
  let mark = 0;
  codes.forEach((code, i) => {
    found[i] = mark - code;
    if (code === 0) mark += 1;
  });
  return found;
}

function chosen(table, width, rows) {
  const found = new Int32Array(width * rows.length);
  rows.forEach((row, i) => {
    for (let k = 0; k < width; k++) found[width * i + k] = table[width * row + k];
  });
  return found;
}

function attribute({ name, width, step, low }, table) {
  if (name === "color") return new THREE.BufferAttribute(Uint8Array.from(table), width, true);
  if (name === "normal") return new THREE.BufferAttribute(normals(table, step), 3);
  const values = new Float32Array(table.length);
  for (let i = 0; i < values.length; i++) values[i] = table[i] * step + (low ? low[i % width] : 0);
  return new THREE.BufferAttribute(values, width);
}

// Unit vectors from octahedral coordinates.
function normals(table, step) {
  const found = new Float32Array((table.length / 2) * 3);
  for (let i = 0; i < table.length / 2; i++) {
    let x = table[2 * i] * step - 1;
    let y = table[2 * i + 1] * step - 1;
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x >= 0 ? 1 : -1), (1 - Math.abs(x)) * (y >= 0 ? 1 : -1)];
    const length = Math.hypot(x, y, z);
    found.set([x / length, y / length, z / length], 3 * i);
  }
  return found;
}

// The box of the vertices that a part uses, not of all vertices of the mesh.
function bound(geometry) {
  const { position } = geometry.attributes;
  const box = (geometry.boundingBox = new THREE.Box3());
  const point = new THREE.Vector3();
  for (const i of geometry.index.array) box.expandByPoint(point.fromBufferAttribute(position, i));
  geometry.boundingSphere = box.getBoundingSphere(new THREE.Sphere());
}
