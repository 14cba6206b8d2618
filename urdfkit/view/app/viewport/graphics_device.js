// Detects whether a graphics card or the processor draws; the processor draws without antialiasing.

/** Name of the graphics device; null if WebGL is not available. */
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

/** Create WebGL contexts without antialiasing on a processor, where it takes two thirds of the drawing time. */
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
