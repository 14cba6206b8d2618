// Points on a surface are seen in front of it.

const PART = 0.01; // of the distance

/** Give points the depth of places that are nearer to the camera by a small part of the distance. */
export function inFront(material) {
  const nearer = `if (projectionMatrix[2][3] < 0.0) {
    vec4 ahead = projectionMatrix * vec4(${1 - PART} * mvPosition.xyz, 1.0);
    gl_Position.z = ahead.z / ahead.w * gl_Position.w;
  }`;
  material.onBeforeCompile = (shader) => (shader.vertexShader = shader.vertexShader.replace("#include <project_vertex>", `#include <project_vertex>\n${nearer}`));
  material.customProgramCacheKey = () => "in front";
  return material;
}
