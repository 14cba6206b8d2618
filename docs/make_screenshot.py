#!/usr/bin/env python3
"""Make the pictures of the README and of the page on viewing, in a real browser.

Run in a checkout with the test extras and Chromium: ``python docs/make_screenshot.py [simpleton|viewing]``.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

IMAGES = Path(__file__).parent / "images"
CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--no-first-run"]
DRIVE = 1.6
"""How long to drive before the picture is taken [s]."""


def drive(page: Page) -> None:
    """Drive Simpleton among cylinders, with the forces at its wheels, its camera image, and plots of its speeds."""
    page.wait_for_selector("#progress", state="hidden", timeout=180_000)
    page.evaluate("urdfkit.page.panels.close('drive')")
    page.evaluate("document.getElementById('show-contacts').click()")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.linear.x')")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.angular.z')")
    page.evaluate("urdfkit.page.panels.open('sensors')")
    page.locator("#robot-name").click()  # the keys belong to the page again
    page.keyboard.down("w")
    time.sleep(DRIVE)
    page.keyboard.up("w")
    page.keyboard.down("d")
    time.sleep(DRIVE / 4)


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


PICTURES: dict[str, tuple[list[str], Callable[[Page], None]]] = {
    "simpleton": (["sim", "teleop", "simpleton", "--world", "cylinders"], drive),
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
            page = browser.new_page(viewport={"width": 1200, "height": 720}, device_scale_factor=1.5)
            page.goto(address)
            page.wait_for_selector("body[data-ready=true]", timeout=180_000)
            act(page)
            IMAGES.mkdir(exist_ok=True)
            page.screenshot(path=IMAGES / f"{name}.png")
            browser.close()
        finally:
            process.send_signal(signal.SIGINT)
    print(IMAGES / f"{name}.png")
    return True


if __name__ == "__main__":
    sys.exit(not all(take(name) for name in sys.argv[1:] or PICTURES))
