// Lines of a width in metres: a rectangle for each segment that faces the camera and is at least one pixel wide.
/* global MeshCat */

const THREE = MeshCat.THREE;
const LIFT = 0.003; // part of the distance by which lines are in front of a map, in addition to their width

const PROJECT = `
  vec4 first = modelViewMatrix * vec4(start, 1.0), second = modelViewMatrix * vec4(end, 1.0);
  vec4 mvPosition = mix(first, second, position.x);
  bool perspective = projectionMatrix[2][3] < 0.0;
  vec3 viewRay = perspective ? mvPosition.xyz : vec3(0.0, 0.0, -1.0);
  vec3 along = normalize(second.xyz - first.xyz + vec3(1e-9, 0.0, 0.0));
  float pixel = (perspective ? max(0.0, -mvPosition.z) : 1.0) * 2.0 / (projectionMatrix[1][1] * pixels);
  float reach = 0.5 * max(width, pixel);
  mvPosition.xyz += reach * (normalize(cross(viewRay, along) + vec3(0.0, 1e-9, 0.0)) * position.y + along * (2.0 * position.x - 1.0));
  gl_Position = projectionMatrix * mvPosition;
  if (perspective) {
    vec4 ahead = projectionMatrix * vec4(mvPosition.xyz * (1.0 - ${LIFT}) - normalize(mvPosition.xyz) * 2.0 * reach, 1.0);
    gl_Position.z = ahead.z / ahead.w * gl_Position.w;
  }`;

/**
 * @param points x, y, z of each point
 * @param step points from the start of a segment to that of the next: 1 for a line, 2 for separate segments
 * @param colors [r, g, b] of each point, or nothing
 */
export function ribbons(points, step, colors, material, width) {
  const count = Math.max(0, Math.floor((points.length / 3 + step - 2) / step));
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const ends = new THREE.InstancedInterleavedBuffer(new Float32Array(points), 3 * step, 1);
  for (const [name, offset] of [["start", 0], ["end", 3]]) geometry.setAttribute(name, new THREE.InterleavedBufferAttribute(ends, 3, offset));
  if (colors) geometry.setAttribute("color", new THREE.InstancedBufferAttribute(new Float32Array(count * 3).map((_, k) => colors[step * Math.floor(k / 3)][k % 3]), 3));
  geometry.instanceCount = count;
  const uniforms = { width: { value: width }, pixels: { value: 1 } };
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = `attribute vec3 start, end;\nuniform float width, pixels;\n${shader.vertexShader.replace("#include <project_vertex>", PROJECT)}`;
  };
  material.customProgramCacheKey = () => "ribbons";
  material.side = THREE.DoubleSide;
  const mesh = new THREE.Mesh(geometry, material);
  const size = new THREE.Vector2();
  mesh.onBeforeRender = (renderer) => (uniforms.pixels.value = renderer.getDrawingBufferSize(size).y);
  mesh.raycast = (caster, hits) => hit(mesh, ends.array, 3 * step, count, width / 2, caster, hits);
  mesh.frustumCulled = false;
  return mesh;
}

function hit(mesh, flat, stride, count, radius, { ray }, hits) {
  const [from, to, point] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  for (let i = 0; i < count; i += 1) {
    from.fromArray(flat, i * stride).applyMatrix4(mesh.matrixWorld);
    to.fromArray(flat, i * stride + 3).applyMatrix4(mesh.matrixWorld);
    if (ray.distanceSqToSegment(from, to, point) <= radius * radius) hits.push({ distance: ray.origin.distanceTo(point), point: point.clone(), object: mesh });
  }
}
