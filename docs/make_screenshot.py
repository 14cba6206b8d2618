#!/usr/bin/env python3
"""Make the film of the README and the pictures of the documentation, in a real browser.

Run in a checkout with the test extras and Chromium: ``python docs/make_screenshot.py [driving|viewing]``.
"""

from __future__ import annotations

import io
import signal
import subprocess
import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

IMAGES = Path(__file__).parent / "images"
CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--no-first-run"]
PATIENCE = 580_000
"""Time for the kernels to be compiled [ms]."""
SLOWER = 0.08
"""Speed of the simulation while it is filmed, since software draws few frames per second: the film has full speed."""
FRAME = 0.1
"""Least simulated time between two frames of the film [s]."""
FILM_SIZE = (800, 480)
"""Pixels of the film."""
ROUTE = (("w", 2.0), ("a", 1.0), ("w", 2.2), ("d", 1.6), ("w", 1.4))
"""Keys that are held while the film is made, and for how long [s of simulated time]."""


def look(page: Page) -> None:
    """Turn Artoo's head, select it, show its numbers, the frames and the joint axes."""
    page.wait_for_selector("#progress", state="hidden")
    page.evaluate("urdfkit.page.setJoints({ head_joint: 0.6 })")
    page.evaluate("urdfkit.page.select({ link: 'head' })")
    page.keyboard.press("x")
    page.keyboard.press("j")
    page.locator("#open-inspect").click()
    page.locator("#robot-name").click()
    page.wait_for_timeout(1000)


def film(page: Page) -> None:
    """Write a film of Simpleton that drives among cylinders, with its camera image and plots of its speeds."""
    page.wait_for_selector("#progress", state="hidden", timeout=PATIENCE)
    page.evaluate("urdfkit.page.panels.close('drive')")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.linear.x')")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.angular.z')")
    page.evaluate("urdfkit.page.panels.open('sensors')")
    page.evaluate(f"urdfkit.page.connection.request('speed', {{ factor: {SLOWER} }})")
    page.locator("#robot-name").click()
    frames: list[Image.Image] = []
    times: list[float] = []
    until = page.evaluate("urdfkit.page.status.time")
    for key, seconds in ROUTE:
        until += seconds
        page.keyboard.down(key)
        while (now := page.evaluate("urdfkit.page.status.time")) < until:
            if not times or now >= times[-1] + FRAME:
                times.append(now)
                picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
                frames.append(picture.resize(FILM_SIZE, Image.Resampling.LANCZOS))
        page.keyboard.up(key)
    IMAGES.mkdir(exist_ok=True)
    length = [round(1000 * (after - before)) for before, after in pairwise([*times, until])]
    frames[0].save(
        IMAGES / "driving.webp", save_all=True, append_images=frames[1:], duration=length, loop=0, quality=60, method=6
    )


PICTURES: dict[str, tuple[list[str], Callable[[Page], None]]] = {
    "driving": (["sim", "teleop", "simpleton", "--world", "cylinders"], film),
    "viewing": (["view", "artoo"], look),
}


def take(name: str) -> bool:
    """Take one picture; return whether there is one now."""
    words, act = PICTURES[name]
    command = [sys.executable, "-m", "urdfkit", *words, "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process, sync_playwright() as playwright:
        try:
            address = process.stdout.readline().strip() if process.stdout else ""
            if not address:
                return False
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            scale = 1.0 if act is film else 1.5
            page = browser.new_page(viewport={"width": 1200, "height": 720}, device_scale_factor=scale)
            page.goto(address)
            page.wait_for_selector("body[data-ready=true]", timeout=PATIENCE)
            act(page)
            IMAGES.mkdir(exist_ok=True)
            if act is not film:
                page.screenshot(path=IMAGES / f"{name}.png")
            browser.close()
        finally:
            process.send_signal(signal.SIGINT)
    print(*IMAGES.glob(f"{name}.*"))
    return True


if __name__ == "__main__":
    sys.exit(not all(take(name) for name in sys.argv[1:] or PICTURES))
