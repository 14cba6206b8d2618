"""The page compared with a camera sensor of the same pose and field of view: colours per link of bundled robots.

Run it: ``python -m tests.bench.bench_page_camera [--pictures FOLDER] [ROBOT …]``. The camera has the lights of the
world, as in Gazebo; the page has those of a studio, or by choice those of the world. A row gives the mean absolute
difference of red, green and blue on the pixels of a link [% of 255]: of the materials, if both have an ambient light of
1 and nothing else, and of what is seen with either light of the page. Of five robots, the materials differ by 0.0 %,
with the light of the studio 5 to 19 %, and with that of the world 0.1 to 0.3 %.
"""

from __future__ import annotations

import argparse
import base64
import io
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import sync_playwright

from tests.cli.conftest import CHROMIUM, FLAGS, READY
from urdfkit.app.pictures.camera_placement import placement
from urdfkit.linear_algebra import Array
from urdfkit.scene import Scene
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.extent import shape_bounds
from urdfkit.scene.lights import Lighting, lighting_of
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.sim import Simulator

ROBOTS = ("simpleton", "artoo", "gem_e2", "heterogeneous", "seven_dof_arm")
WIDTH, HEIGHT, FIELD = 480, 360, 1.0
VIEWS = ((30.0, 20.0), (150.0, 20.0), (270.0, 35.0))
"""Azimuth and elevation [degrees]."""
COLUMNS = ("materials", "studio", "world")
LEAST = 50
"""Pixels of a link that has a row."""
POSES = """(links) => links.map((link) => {
  const { position, quaternion } = urdfkit.scene.byLink.get(link);
  return [...position.toArray(), ...quaternion.toArray()];
})"""
SHOT = """([at, ahead, field, width, height, isLit, light]) => {
  const { viewport } = urdfkit, { viewer } = viewport, T = MeshCat.THREE;
  const world = (point) => viewer.scene.localToWorld(new T.Vector3(...point));
  urdfkit.page.following = false;
  viewport.visible("Grid", false);
  viewer.camera.fov = field;
  viewer.camera.position.copy(world(at));
  viewer.controls.target.copy(world(ahead));
  viewer.controls.update();
  urdfkit.page.light.choose(light);
  const lit = new Map();
  if (!isLit) viewer.scene.traverse((object) => {
    if (!object.isMesh || !object.material.isMeshStandardMaterial) return;
    lit.set(object, object.material);
    const { color, map, vertexColors, side, transparent, opacity, alphaTest, emissive } = object.material;
    object.material = new T.MeshBasicMaterial({ color, map, vertexColors, side, transparent, opacity, alphaTest });
    object.material.color = color.clone().add(emissive);
  });
  viewport.draw(width, height);
  const data = viewer.renderer.domElement.toDataURL("image/png");
  for (const [object, material] of lit) object.material = material;
  viewport.dirty();
  return data;
}"""


def camera_picture(
    simulator: Simulator, poses: Array, frame: Array, lens: Lens, lighting: Lighting
) -> tuple[Array, NDArray[np.int64], list[str]]:
    """Return the camera's colours, the shape of each pixel, -1 for none, and the links of the shapes."""
    scene = Scene(simulator.scene.bodies, simulator.scene.with_role("visual"))
    table = RayTable(scene, scene.shapes)
    renderer = RayRenderer(table, lighting)
    table.place(poses)
    seen = renderer.take(lens, frame, samples=8)
    return seen.rgb.astype(float), seen.shapes, [shape.body for shape in table.shapes]


def measure(
    page: Any, robot: str, pictures: Path | None = None, *, world: str = "empty"
) -> list[tuple[str, int, float, float, float]]:
    """Return link, pixels, and the differences [%]: of the materials, with the studio's and with the world's light.

    The page shows a paused simulation of the robot. The last row is the whole robot.
    """
    simulator = Simulator(robot, world=world)
    poses = np.array(page.evaluate(POSES, list(simulator.scene.bodies)))
    matrices = pose_matrices(poses)
    lens = Lens(WIDTH, HEIGHT, FIELD)
    points = []
    for shape in simulator.scene.with_role("visual"):
        box = shape_bounds(shape, matrices[simulator.scene.body_index[shape.body]])
        points += [np.where(np.array([k & 1, k & 2, k & 4]) > 0, box[1], box[0]) for k in range(8)]
    field = float(np.degrees(2 * np.arctan(np.tan(FIELD / 2) * HEIGHT / WIDTH)))
    bright, own = Lighting(ambient=(1.0, 1.0, 1.0)), lighting_of(simulator.world.description)
    shots = [("materials", bright, "studio"), ("studio", own, "studio"), ("world", own, "world")]
    found: dict[str, list[list[Array]]] = {}
    for k, view in enumerate(VIEWS):
        frame = placement(np.array(points), lens, *view, 1.0)
        at, ahead = frame[:3, 3], frame[:3, 3] + frame[:3, 0]
        errors = []
        for shot, lighting, light in shots:
            ours, shapes, links = camera_picture(simulator, poses, frame, lens, lighting)
            lit = shot != "materials"
            data = page.evaluate(SHOT, [list(at), list(ahead), field, WIDTH, HEIGHT, lit, light])
            theirs = np.asarray(Image.open(io.BytesIO(base64.b64decode(data.partition(",")[2]))).convert("RGB"), float)
            if pictures:
                both = Image.fromarray(np.hstack([theirs, ours]).astype(np.uint8))
                both.save(pictures / f"{Path(robot).stem}-{k}-{shot}.png")
            errors.append(np.abs(theirs - ours).mean(axis=-1) / 2.55)
        inner = shapes >= 0  # without the pixels at edges, which are mixtures
        for axis in (0, 1):
            for step in (-1, 1):
                inner &= np.roll(shapes, step, axis) == shapes
        for link in (*sorted(set(links)), "robot"):
            mask = inner & np.isin(shapes, [i for i, each in enumerate(links) if link in (each, "robot")])
            found.setdefault(link, []).append([error[mask] for error in errors])
    rows = []
    for link, parts in sorted(found.items(), key=lambda item: item[0] == "robot"):
        differences = [np.concatenate(each) for each in zip(*parts, strict=True)]
        if len(differences[0]) >= LEAST:
            materials, studio, world = (float(each.mean()) for each in differences)
            rows.append((link, len(differences[0]), materials, studio, world))
    return rows


def main() -> None:
    """Print a table for each robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*", default=ROBOTS)
    parser.add_argument("--pictures", type=Path, help="folder for pictures, the page at the left")
    arguments = parser.parse_args()
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as runtime:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for robot in arguments.robots:
            command = [sys.executable, "-m", "urdfkit", "sim", "teleop", robot, "--port", "0", "--no-browser", "-q"]
            environment = os.environ | {"XDG_RUNTIME_DIR": runtime}
            with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as served:
                assert served.stdout
                page = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
                page.goto(served.stdout.readline().strip())
                page.wait_for_selector(READY)
                page.evaluate("urdfkit.page.send('control', { action: 'pause' })")
                page.wait_for_timeout(500)
                for link, count, *parts in measure(page, robot, arguments.pictures):
                    shares = "  ".join(f"{name} {part:5.1f} %" for name, part in zip(COLUMNS, parts, strict=True))
                    print(f"{robot:16} {link:28} {count:7} px  {shares}", flush=True)
                page.close()
                served.send_signal(signal.SIGINT)
        browser.close()


if __name__ == "__main__":
    main()
