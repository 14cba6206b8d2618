"""Frames per second of the viewer while the camera or a joint is dragged, drawn by the processor.

Run it: ``python tests/bench/bench_redraw.py [ROBOT]``. Without a robot: eight rings with 102,400 triangles.
"""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import trimesh
from playwright.sync_api import sync_playwright

from tests.cli.conftest import CHROMIUM, FLAGS, READY

if TYPE_CHECKING:
    from playwright.sync_api import Page

COUNTED = """() => {
  const { budget } = urdfkit.viewport, draw = budget.draw.bind(budget);
  window.levels = [];
  budget.draw = (render) => { draw(render); levels.push(budget.used); };
}"""
WARM, SECONDS = 4.0, 6.0


def rings(folder: Path) -> Path:
    """Write a chain of eight rings and return its file."""
    trimesh.creation.torus(0.12, 0.05, 80, 80).export(folder / "ring.stl")
    text = []
    for k in range(8):
        text.append(f'<link name="l{k}"><visual><geometry><mesh filename="ring.stl"/></geometry></visual></link>')
        if k:
            ends = f'<parent link="l{k - 1}"/><child link="l{k}"/><origin xyz="0 0.05 0.15" rpy="0.3 0.2 0"/>'
            limit = '<axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'
            text.append(f'<joint name="j{k}" type="revolute">{ends}{limit}</joint>')
    path = folder / "rings.urdf"
    path.write_text(f'<robot name="rings">{"".join(text)}</robot>')
    return path


def rate(page: Page, move: Callable[[int], None]) -> str:
    """Return frames per second, and the pixel levels of the frames, while ``move`` is called."""
    count, start = 0, time.monotonic()
    while time.monotonic() - start < WARM + SECONDS:
        if time.monotonic() - start < WARM:
            page.evaluate("window.levels.length = 0")
            since = time.monotonic()
        move(count)
        page.wait_for_timeout(15)
        count += 1
    spent = time.monotonic() - since
    levels = page.evaluate("window.levels")
    shares = ", ".join(f"level {level}: {levels.count(level)}" for level in sorted(set(levels)))
    return f"{len(levels) / spent:.1f} frames/s ({shares}; load {os.getloadavg()[0]:.1f})"


def moving(page: Page, x: float, y: float, reach: float) -> Callable[[int], None]:
    """Return what moves the mouse to and fro."""
    return lambda count: page.mouse.move(x + reach * math.sin(count / 15), y)


def measure(robot: Path) -> None:
    """Print the rates."""
    command = [sys.executable, "-m", "urdfkit", "view", str(robot), "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server, sync_playwright() as playwright:
        assert server.stdout is not None
        url = server.stdout.readline().strip()
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(url)
        page.wait_for_selector(READY)
        page.evaluate("urdfkit.scene.settled()")
        print("triangles", page.evaluate("urdfkit.viewport.viewer.renderer.info.render.triangles"))
        page.evaluate(COUNTED)
        pane = page.locator("#pane").bounding_box()
        slider = page.locator("#panel-joints input[type=range]").first.bounding_box()
        assert pane is not None
        assert slider is not None
        for name, box in (("camera", pane), ("joint", slider)):
            x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
            page.mouse.move(x, y)
            page.mouse.down()
            print(name, rate(page, moving(page, x, y, 0.3 * box["width"])))
            page.mouse.up()
        browser.close()
        server.terminate()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        measure(Path(sys.argv[1]) if len(sys.argv) > 1 else rings(Path(folder)))
