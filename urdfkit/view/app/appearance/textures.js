// Textures of meshes: fetched once by their content hash, in a size that the device can draw.
/* global MeshCat */

import { soft } from "../viewport/graphics_device.js";

const THREE = MeshCat.THREE;
const EDGE = soft || Math.min(screen.width, screen.height) < 500 ? 1024 : 2048; // px; the server offers 512, 1024 and 2048
const loaded = new Map(); // name → promise of a texture

/** Resolves to a texture. */
export function texture(name) {
  if (!loaded.has(name)) {
    const image = (window.urdfkitTexture ?? fetched)(name).then(made);
    image.catch(() => loaded.delete(name));
    loaded.set(name, image);
  }
  return loaded.get(name);
}

/** Forget all textures except those with these names. */
export function keepTextures(names) {
  for (const [name, image] of loaded) {
    if (names.has(name)) continue;
    loaded.delete(name);
    image.then((each) => each.dispose(), () => {});
  }
}

async function fetched(name) {
  const query = new URLSearchParams(location.search); // a page in a frame sends its token
  query.set("edge", EDGE);
  const answer = await fetch(`/texture/${name}?${query}`);
  if (!answer.ok) throw new Error(`${answer.status}`);
  return answer.blob();
}

async function made(blob) {
  // WebGL ignores flipY for image bitmaps, so the image is flipped when it is decoded.
  const image = await createImageBitmap(blob, { imageOrientation: "flipY", premultiplyAlpha: "none", colorSpaceConversion: "none" });
  const found = new THREE.Texture(image);
  Object.assign(found, { flipY: false, wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, anisotropy: soft ? 1 : 8 });
  found.needsUpdate = true;
  return found;
}
