// How surfaces look: materials are lit in linear colours and mapped to the screen without burnt-out highlights.
/* global MeshCat */

import { WORLD } from "./world_light.js";

const THREE = MeshCat.THREE;

// The colours of a robot are sRGB and the page has no colour management, because lines and labels use plain colours.
// So the shader of the surfaces converts: to linear before the light, and back after it. In between, "neutral" tone
// mapping keeps colours up to 0.8 as they are and compresses brighter ones (Khronos PBR Neutral).
const TO_LINEAR = `
  #include <color_fragment>
  diffuseColor.rgb = pow(diffuseColor.rgb, vec3(2.2));`;

// Reflections of a studio: a bright ceiling, walls, a dark floor, and a softbox. They give black parts their shape.
const REFLECTIONS = `{
  vec3 eye = normalize(vViewPosition);
  vec3 up = viewMatrix[1].xyz;
  vec3 mirrored = reflect(-eye, normal);
  float height = dot(mirrored, up);
  float blur = 0.15 + 0.85 * roughnessFactor;
  float radiance = mix(0.18, 0.85, smoothstep(-blur, blur, height));
  vec3 softbox = normalize(mat3(viewMatrix) * vec3(-0.35, 0.8, 0.5));
  radiance += 1.1 * (1.0 - roughnessFactor) * smoothstep(1.0 - 0.6 * blur, 1.0, dot(mirrored, softbox));
  float grazing = pow(1.0 - clamp(dot(normal, eye), 0.0, 1.0), 5.0);
  gl_FragColor.rgb += radiance * (0.02 + max(0.02, 0.6 * (1.0 - roughnessFactor)) * grazing);
}`;

const TO_SCREEN = `{
  const float start = 0.76;
  float peak = max(gl_FragColor.r, max(gl_FragColor.g, gl_FragColor.b));
  if (peak > start) {
    float rest = 1.0 - start;
    float mapped = 1.0 - rest * rest / (peak + rest - start);
    gl_FragColor.rgb *= mapped / peak;
    float share = 1.0 - 1.0 / (0.15 * (peak - mapped) + 1.0);
    gl_FragColor.rgb = mix(gl_FragColor.rgb, vec3(mapped), share);
  }
  gl_FragColor.rgb = pow(gl_FragColor.rgb, vec3(1.0 / 2.2));
}`;

// The lights are points, whose reflections on smooth surfaces are brighter than the screen: they are limited to 0.15.
const HIGHLIGHT = `
  totalSpecular /= 1.0 + max(totalSpecular.r, max(totalSpecular.g, totalSpecular.b)) / 0.15;
  vec3 outgoingLight =`;

// While something moves and the processor draws, surfaces have the same colours and lights without reflections. That takes
// a fifth of the time. Squares and roots stand for powers of 2.2 and 1 / 2.2; 0.014 for the reflections of dark parts.
const QUICK = `
void main() {
  #include <clipping_planes_fragment>
  vec4 diffuseColor = vec4(diffuse, opacity);
  #include <map_fragment>
  #include <color_fragment>
  #include <alphatest_fragment>
  #include <normal_fragment_begin>
  vec3 light = ambientLightColor;
  #if NUM_HEMI_LIGHTS > 0
    light += mix(hemisphereLights[0].groundColor, hemisphereLights[0].skyColor, 0.5 * dot(normal, hemisphereLights[0].direction) + 0.5);
  #endif
  #if NUM_DIR_LIGHTS > 0
    for (int i = 0; i < NUM_DIR_LIGHTS; i++) light += max(dot(normal, directionalLights[i].direction), 0.0) * directionalLights[i].color;
  #endif
  vec3 seen = sqrt(diffuseColor.rgb * diffuseColor.rgb * light * RECIPROCAL_PI + 0.014);
  gl_FragColor = vec4(min(seen, 0.88 + 0.1 * seen) + emissive, diffuseColor.a);
}`;

const shader = THREE.ShaderLib.physical; // of MeshStandardMaterial too
const [head, main] = shader.fragmentShader.split("void main() {");
const full = `void main() {${main}`
  .replace("#include <color_fragment>", TO_LINEAR)
  .replace("vec3 outgoingLight =", HIGHLIGHT)
  .replace("#include <tonemapping_fragment>", REFLECTIONS + TO_SCREEN);
shader.fragmentShader = `${head}
#if defined(WORLD)
${WORLD}
#elif defined(QUICK)
${QUICK}
#else
${full}
#endif`;

/** Draw all surfaces of a scene without reflections, or with them. The programs of both are kept. */
export function quicken(scene, isQuick) {
  const done = new Set();
  scene.traverse(({ material }) => {
    if (!material?.isMeshStandardMaterial || done.has(material) || "QUICK" in material.defines === isQuick) return;
    done.add(material);
    if (isQuick) material.defines.QUICK = "";
    else delete material.defines.QUICK;
    material.needsUpdate = true;
  });
}

export const SUN = new THREE.Vector3(0.3, -0.22, 1).normalize(); // its direction, z up

/** The lights, in the axes of the robot: sky and floor, a sun with shadows, and a weak light from the other side. */
export function studio() {
  const sky = new THREE.HemisphereLight(0xffffff, 0xffffff, 1);
  sky.position.set(0, 0, 1);
  sky.color.setScalar(0.52);
  sky.groundColor.setScalar(0.4);
  const fill = new THREE.DirectionalLight(0xffffff, 0.22);
  fill.position.set(-3, -4, 2);
  const sun = new THREE.DirectionalLight(0xffffff, 0.45);
  return { sky, fill, sun };
}
