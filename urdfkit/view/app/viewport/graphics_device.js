// What draws: a graphics card, or the processor in its place, which is spared what costs it most.

/** The name of what draws; null where nothing can. */
function named() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return null;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return name;
}

export const drawnBy = named();

/** Whether the processor draws. */
export const soft = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(drawnBy ?? "");

/** Make what makes a WebGL context. Smooth edges take a processor two thirds of the time of a picture: it goes without. */
export function sparing(make) {
  if (!soft) return make();
  const { prototype } = HTMLCanvasElement;
  const original = prototype.getContext;
  prototype.getContext = function (kind, options) {
    return original.call(this, kind, { ...options, antialias: false });
  };
  try {
    return make();
  } finally {
    prototype.getContext = original;
  }
}
