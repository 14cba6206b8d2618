// The light of the world: surfaces look as in images of the simulated cameras (urdfkit/scene/rays/shading), with the same
// numbers of the lights, and colours that are multiplied as they are, without tone mapping.
/* global MeshCat */

import { SunShadow } from "./sun_shadow.js";

const THREE = MeshCat.THREE;
const CASTERS = 4; // lights with shadows: a device has 16 textures at least
const KINDS = ["directional", "point", "spot"];
const STEEPEST = 1.4; // rad: half of the angle in which a spot has shadows

const shadowOf = (kind, k) => {
  const light = `${kind}LightShadows[${k}]`;
  const values = `${kind}ShadowMap[${k}], ${light}.shadowMapSize, ${light}.shadowBias, ${light}.shadowRadius, v${kind[0].toUpperCase()}${kind.slice(1)}ShadowCoord[${k}]`;
  return kind === "point" ? `getPointShadow(${values}, ${light}.shadowCameraNear, ${light}.shadowCameraFar)` : `getShadow(${values})`;
};
const SHADOWS = KINDS.flatMap((kind) =>
  [...Array(CASTERS).keys()].map(
    (k) => `
#if defined(USE_SHADOWMAP) && NUM_${kind === "directional" ? "DIR" : kind.toUpperCase()}_LIGHT_SHADOWS > ${k}
#define SHADOW_${kind}_${k} (receiveShadow ? ${shadowOf(kind, k)} : 1.0)
#else
#define SHADOW_${kind}_${k} 1.0
#endif`,
  ),
).join("");

/** Shader of a surface. WORLD calls `shine` for each light; its numbers are part of the program. GLOSS: specular colour and exponent. */
export const WORLD = `${SHADOWS}
vec3 lightSum = vec3(0.0), highlight = vec3(0.0);
void shine(int kind, vec3 at, vec3 color, float range, vec3 fading, vec3 ahead, vec3 cone, vec3 specular, float lit, vec3 normal) {
  vec3 towards = mat3(viewMatrix) * at;
  float gain = lit;
  if (kind > 0) {
    towards = (viewMatrix * vec4(at, 1.0)).xyz + vViewPosition;
    float reach = length(towards);
    if (reach > range || reach <= 0.0) return;
    towards /= reach;
    gain /= max(fading.x + reach * (fading.y + reach * fading.z), 1e-9);
    float along = -dot(towards, mat3(viewMatrix) * ahead);
    if (kind == 2 && along <= cone.y) return;
    if (kind == 2) gain *= pow(clamp((along - cone.y) / max(cone.x - cone.y, 1e-9), 0.0, 1.0), cone.z);
  }
  float straight = dot(towards, normal);
  if (straight <= 0.0) return;
  lightSum += gain * straight * color;
  #ifdef GLOSS
    vec3 eye = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition);
    float facing = dot(normalize(towards + eye), normal);
    if (facing > 0.0) highlight += gain * pow(facing, GLOSS.a) * specular * GLOSS.rgb;
  #endif
}
void main() {
  #include <clipping_planes_fragment>
  vec4 diffuseColor = vec4(diffuse, opacity);
  #include <map_fragment>
  #include <color_fragment>
  #include <alphatest_fragment>
  #include <normal_fragment_begin>
  WORLD
  gl_FragColor = vec4(diffuseColor.rgb * lightSum + highlight + emissive, diffuseColor.a);
}`;

/** Lights as the server sends them: rows of LIGHT numbers (direct_lighting.py), `ambient` and `background`. */
export class WorldLight {
  constructor(viewer, { lights, ambient, background }) {
    this.viewer = viewer;
    this.background = new THREE.Color(...background);
    this.casters = [];
    const calls = lights.map((row) => this.#call(row));
    this.code = `lightSum = ${vector(ambient)}; ${calls.join(" ")}`;
    const objects = this.casters.flatMap(({ light }) => [light, light.target ?? []].flat());
    if (objects.length) viewer.scene.add(...objects);
  }

  dispose() {
    for (const { light } of this.casters) {
      this.viewer.scene.remove(light, ...(light.target ? [light.target] : []));
      light.dispose();
      light.shadow.dispose();
    }
  }

  // The call of `shine` for a light, whose shadow is one of three.js.
  #call(row) {
    const [kind, at, color, range, fading, casts, ahead, cone, specular] = [row[0], row.slice(1, 4), row.slice(4, 7), row[7], row.slice(8, 11), row[11], row.slice(12, 15), row.slice(15, 18), row.slice(18, 21)];
    let lit = "1.0";
    if (casts && this.casters.length < CASTERS) {
      lit = `SHADOW_${KINDS[kind]}_${this.casters.filter((other) => other.kind === kind).length}`;
      this.casters.push({ kind, ...this.#caster(kind, at, range, ahead, cone) });
    }
    return `shine(${kind}, ${upright(at)}, ${vector(color)}, ${float(range)}, ${vector(fading)}, ${upright(ahead)}, ${vector(cone)}, ${vector(specular)}, ${lit}, normal);`;
  }

  #caster(kind, at, range, ahead, cone) {
    if (kind === 0) {
      const light = new THREE.DirectionalLight();
      const shadow = new SunShadow(this.viewer, light, new THREE.Vector3(...at));
      return { light, fit: () => shadow.fit() };
    }
    const light = kind === 1 ? new THREE.PointLight() : new THREE.SpotLight();
    Object.assign(light, { castShadow: true, distance: Math.min(range, 100) });
    light.position.set(...at);
    if (kind === 2) {
      light.angle = Math.min(Math.acos(cone[1]), STEEPEST);
      light.target.position.set(...at.map((x, i) => x + ahead[i]));
    }
    light.shadow.mapSize.set(1024, 1024);
    Object.assign(light.shadow, { bias: -0.0005, normalBias: 0.005 });
    Object.assign(light.shadow.camera, { near: 0.05, far: light.distance });
    return { light, fit() {} };
  }
}

const float = (x) => (Number.isInteger(x) ? x.toFixed(1) : String(x));
const vector = (numbers) => `vec3(${numbers.map(float).join(", ")})`;
const upright = ([x, y, z]) => vector([x, z, -y]); // the world of three.js has y up

/** Light all surfaces of a scene by the world (its `code`), or by the studio (null). */
export function light(scene, code) {
  scene.traverse(({ material }) => {
    if (!material?.isMeshStandardMaterial || (material.defines.WORLD ?? null) === code) return;
    delete material.defines.WORLD;
    delete material.defines.GLOSS;
    if (code !== null) material.defines.WORLD = code;
    const { gloss } = material.userData;
    if (code !== null && gloss?.[3] > 0) material.defines.GLOSS = `vec4(${gloss.map(float).join(", ")})`;
    material.needsUpdate = true;
  });
}
