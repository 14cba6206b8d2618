// The grid on the ground: one plane whose shader draws the lines.
/* global MeshCat */

const THREE = MeshCat.THREE;

// Squares of `cell` metres, every fifth line stronger; lines one pixel wide however far away, fading with distance.
export function gridMaterial() {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    extensions: { derivatives: true },
    uniforms: {
      cell: { value: 1 },
      reach: { value: 10 },
      major: { value: new THREE.Color() },
      minor: { value: new THREE.Color() },
    },
    vertexShader: `
      varying vec2 at;
      varying vec3 seen;
      void main() {
        at = position.xy;
        vec4 view = modelViewMatrix * vec4(position, 1.0);
        seen = view.xyz;
        gl_Position = projectionMatrix * view;
      }`,
    fragmentShader: `
      uniform float cell, reach;
      uniform vec3 major, minor;
      varying vec2 at;
      varying vec3 seen;
      float lines(vec2 p) {
        vec2 width = fwidth(p);
        vec2 off = abs(fract(p - 0.5) - 0.5) / width;
        float line = 1.0 - min(min(off.x, off.y), 1.0);
        return line * (1.0 - smoothstep(0.15, 0.45, max(width.x, width.y)));
      }
      void main() {
        float strong = lines(at / (5.0 * cell));
        float weak = lines(at / cell);
        float near = 1.0 - smoothstep(0.3 * reach, reach, length(seen));
        gl_FragColor = vec4(mix(minor, major, strong), max(strong, weak) * near);
      }`,
  });
}
