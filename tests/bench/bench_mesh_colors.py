"""Colours and textures of real robots on the page, per mesh file, compared with three.js's own loaders, without light.

Run it: ``python tests/bench/bench_mesh_colors.py [--pictures FOLDER] [ROBOT …]``. The robots are those of pybullet_data
and rtbdata, whose OBJ and COLLADA files have materials or textures. The page shows a part, then the same file as
three.js's OBJLoader, MTLLoader or ColladaLoader reads it, from four sides.
"""

from __future__ import annotations

import argparse
import base64
import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import sync_playwright

from tests.cli.conftest import CHROMIUM, FLAGS, READY
from urdfkit.description import load
from urdfkit.description.packages.resolver import Packages
from urdfkit.scene.scene_table import scene_of

ROBOTS = (
    *(f"pybullet_data/{name}.urdf" for name in (
        "a1/a1", "aliengo/aliengo", "laikago/laikago", "quadruped/minitaur", "husky/husky", "racecar/racecar",
        "franka_panda/panda", "kuka_iiwa/model", "mini_cheetah/mini_cheetah",
    )),
    *(f"rtbdata/xacro/kuka_description/{name}.urdf" for name in (
        "kuka_kr16/urdf/kr16_2", "kuka_kr210/urdf/kr210l150", "kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820",
    )),
)  # fmt: skip
PICTURES = {".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg"}
COMPARE = """async ({ path, data, format, mtl, resources, scale }) => {
  const { viewport, scene } = urdfkit, { viewer } = viewport, { renderer } = viewer, T = MeshCat.THREE;
  const node = viewer.scene_tree.find(path.split("/")).object;
  const ours = node.children.find((child) => child.name === "<object>") ?? node.children[0];
  // Without light; a material of three.js keeps its colour, texture and sides.
  const bare = (object) => object.traverse((mesh) => {
    if (!mesh.isMesh) return;
    const plain = ({ color, map, vertexColors }) => {
      return new T.MeshBasicMaterial({ color, map, vertexColors, side: T.DoubleSide });
    };
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(plain) : plain(mesh.material);
  });
  const space = new T.Scene(), target = new T.WebGLRenderTarget(256, 256);
  const pixels = new Uint8Array(4 * 256 * 256), camera = new T.OrthographicCamera(-1, 1, 1, -1, 0.01, 4);
  const shots = (object) => {
    const holder = new T.Group();
    holder.add(object);
    space.add(holder);
    holder.updateMatrixWorld(true);
    const box = new T.Box3().setFromObject(holder), radius = box.getBoundingSphere(new T.Sphere()).radius;
    const middle = box.getCenter(new T.Vector3()), found = [];
    for (const way of [[1, 1, 0.7], [-1, 1, 0.7], [-1, -1, -0.7], [1, -1, 0.4]]) {
      Object.assign(camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0, far: 6 * radius });
      camera.up.set(0, 0, 1);
      camera.position.copy(middle).addScaledVector(new T.Vector3(...way).normalize(), 3 * radius);
      camera.lookAt(middle);
      camera.updateProjectionMatrix();
      renderer.setRenderTarget(target);
      renderer.setClearColor(0, 0);
      renderer.clear();
      renderer.render(space, camera);
      renderer.readRenderTargetPixels(target, 0, 0, 256, 256, pixels);
      found.push(btoa(pixels.reduce((text, byte) => text + String.fromCharCode(byte), "")));
    }
    renderer.setRenderTarget(null);
    space.remove(holder);
    return found;
  };
  const parts = ours.clone();
  parts.position.set(0, 0, 0);
  parts.quaternion.identity();
  bare(parts);
  const seen = shots(parts);
  const object = { metadata: { version: 4.5, type: "Object" }, geometries: [], materials: [],
    object: { uuid: "reference", type: "_meshfile_object", format, data, mtl_library: mtl, resources } };
  viewer.set_object_from_json(["reference"], object);
  const loaded = viewer.scene_tree.find(["reference"]).object;
  const maps = () => {
    const found = [];
    loaded.traverse((mesh) => found.push(...[mesh.material ?? []].flat().flatMap(({ map }) => map ?? [])));
    return found;
  };
  for (let tries = 0; tries < 100 && maps().some(({ image }) => !image?.complete && !image?.width); tries++) {
    await new Promise((done) => setTimeout(done, 50));
  }
  const textures = maps().length;
  const reference = new T.Group();
  loaded.children.slice().forEach((child) => reference.add(child));
  reference.traverse((mesh) => mesh.position.set(0, 0, 0));
  reference.scale.set(...scale);
  bare(reference);
  const wanted = shots(reference);
  viewer.delete_path(["reference"]);
  return { seen, wanted, textures };
}"""


def files(robot: Path) -> list[dict[str, Any]]:
    """Return what the page needs of each mesh file with materials, once per file."""
    model = load(robot)
    found, counts = {}, {}
    packages = model.packages or Packages()
    for shape in scene_of(model).shapes:
        where = f"robot/links/{shape.body}/{shape.role}"
        number = counts[where] = counts.get(where, -1) + 1
        name = getattr(shape.geometry, "uri", None)
        if shape.role != "visual" or name is None or shape.mesh is None:
            continue
        path = packages.resolve(str(name), robot)
        if path.suffix.lower() not in (".obj", ".dae") or path in found:
            continue
        text = path.read_text(errors="replace")
        library = [
            path.parent / line.split(None, 1)[1].strip() for line in text.splitlines() if line.startswith("mtllib")
        ]
        mtl = library[0].read_text(errors="replace") if library and library[0].exists() else ""
        if path.suffix.lower() == ".obj" and not mtl:
            continue
        resources = {}
        for each in path.parent.iterdir():
            if each.suffix.lower() in PICTURES:
                url = f"data:{PICTURES[each.suffix.lower()]};base64,{base64.b64encode(each.read_bytes()).decode()}"
                resources[each.name] = url
        scale = [float(x) for x in getattr(shape.geometry, "scale", None) or (1, 1, 1)]
        found[path] = {
            "path": f"{where}/{number}", "data": text, "format": path.suffix[1:].lower(), "mtl": mtl,
            "resources": resources, "scale": scale,
        }  # fmt: skip
    return [{"file": path, **values} for path, values in found.items()]


def image(text: str) -> np.ndarray:
    """Return the pixels of a picture of the page; shape (256, 256, 4), 0..255."""
    return np.frombuffer(base64.b64decode(text), np.uint8).reshape(256, 256, 4)[::-1].astype(float)


def compare(page: Any, entry: dict[str, Any], pictures: Path | None) -> dict[str, Any]:
    """Return the differences of one file: of the mean colour, and of the pixels that both show, as shares of 255."""
    answer = page.evaluate(COMPARE, {key: value for key, value in entry.items() if key != "file"})
    ours, theirs = (np.concatenate([image(each) for each in answer[key]], axis=1) for key in ("seen", "wanted"))
    if pictures is not None:
        from PIL import Image

        both = np.concatenate([ours, theirs]).astype(np.uint8)
        both[both[..., 3] == 0] = 255
        name = f"{entry['file'].parent.parent.name}-{entry['file'].stem}.png"
        Image.fromarray(np.ascontiguousarray(both[..., :3])).save(pictures / name)
    seen = (ours[..., 3] > 0) & (theirs[..., 3] > 0)
    either = (ours[..., 3] > 0) | (theirs[..., 3] > 0)
    mean = [each[each[..., 3] > 0][:, :3].mean(axis=0) for each in (ours, theirs)]
    return {
        "file": entry["file"].name,
        "mean": float(np.abs(mean[0] - mean[1]).mean() / 255) if seen.any() else 1.0,
        "pixels": float(np.abs(ours - theirs)[seen][:, :3].mean() / 255) if seen.any() else 1.0,
        "same_outline": float(seen.sum() / max(either.sum(), 1)),
        "textures": answer["textures"],
    }


def data(package: str) -> Path:
    """Return the folder of a Python package."""
    found = importlib.util.find_spec(package.split("/")[0])
    assert found is not None
    assert found.origin is not None
    return Path(found.origin).parent.parent / package


def main() -> None:
    """Print one line per file, and the worst of each robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*")
    parser.add_argument("--pictures", type=Path)
    chosen = parser.parse_args()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for robot in [Path(each) for each in chosen.robots] or [data(each) for each in ROBOTS]:
            command = [sys.executable, "-m", "urdfkit", "view", str(robot), "--port", "0", "--no-browser"]
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as server:
                assert server.stdout is not None
                page = browser.new_page()
                page.goto(server.stdout.readline().strip())
                page.wait_for_selector(READY, timeout=180_000)
                page.evaluate("urdfkit.scene.settled()")
                rows = [compare(page, entry, chosen.pictures) for entry in files(robot)]
                page.close()
                server.terminate()
            for row in rows:
                print(f"  {row['file']:28} mean {100 * row['mean']:5.2f} %  pixels {100 * row['pixels']:5.2f} %  "
                      f"same outline {100 * row['same_outline']:5.1f} %  textures {row['textures']}")  # fmt: skip
            worst = max((row["mean"] for row in rows), default=0.0)
            print(f"{robot.stem}: {len(rows)} files, worst mean {100 * worst:.2f} %", flush=True)
        browser.close()


if __name__ == "__main__":
    main()
