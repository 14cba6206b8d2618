// Points and lines on a surface are seen in front of it.

/** Give points or lines the depth of places that are nearer to the camera by a small part of the distance. */
export function inFront(material, part = 0.01) {
  const nearer = `if (projectionMatrix[2][3] < 0.0) {
    vec4 ahead = projectionMatrix * vec4(${1 - part} * mvPosition.xyz, 1.0);
    gl_Position.z = ahead.z / ahead.w * gl_Position.w;
  }`;
  material.onBeforeCompile = (shader) => (shader.vertexShader = shader.vertexShader.replace("#include <project_vertex>", `#include <project_vertex>\n${nearer}`));
  material.customProgramCacheKey = () => `in front ${part}`;
  return material;
}
