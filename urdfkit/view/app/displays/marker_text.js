// The texts of markers: a canvas on a sprite.

/* global MeshCat */
const THREE = MeshCat.THREE;

/** A text that faces the viewer. @param item {text, size, pose} @param color of the letters, a THREE.Color */
export function textSprite(item, color) {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d");
  const font = "600 48px system-ui, sans-serif";
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(item.text).width) + 8;
  canvas.height = 60;
  const isBright = 0.3 * color.r + 0.6 * color.g + 0.1 * color.b > 0.5;
  // An outline keeps white text legible on a light ground and black text on a dark ground.
  Object.assign(pen, { font, fillStyle: `#${color.getHexString()}`, strokeStyle: isBright ? "#1b212b" : "#ffffff", lineWidth: 6, lineJoin: "round" });
  pen.strokeText(item.text, 4, 46);
  pen.fillText(item.text, 4, 46);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), transparent: true, depthTest: false }));
  sprite.scale.set((item.size * canvas.width) / 48, (item.size * canvas.height) / 48, 1);
  sprite.position.set(...item.pose.slice(0, 3));
  sprite.renderOrder = 30;
  return sprite;
}
