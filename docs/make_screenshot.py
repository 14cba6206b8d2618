#!/usr/bin/env python3
"""Make the README's picture: drive Simpleton in a real browser and photograph it.

Run in a checkout with the test extras and Chromium: ``python docs/make_screenshot.py``.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

PICTURE = Path(__file__).parent / "images" / "simpleton.png"
CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--no-first-run"]
ARC = 2.5
"""How far to drive before the picture is taken [s]."""


def main() -> int:
    """Take the picture."""
    command = [sys.executable, "-m", "urdfkit", "sim", "teleop", "simpleton", "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as simulation, sync_playwright() as playwright:
        try:
            address = simulation.stdout.readline().strip() if simulation.stdout else ""
            if not address:
                return 1
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            page = browser.new_page(viewport={"width": 1200, "height": 720}, device_scale_factor=1.5)
            page.goto(address)
            page.wait_for_selector("body[data-ready=true]", timeout=180_000)
            page.wait_for_selector("#progress", state="hidden", timeout=180_000)
            page.locator("#keys summary").click()
            page.locator("#robot-name").click()  # the keys belong to the page again
            page.keyboard.down("w")
            page.keyboard.down("a")
            time.sleep(ARC)
            PICTURE.parent.mkdir(exist_ok=True)
            page.screenshot(path=PICTURE)
            browser.close()
        finally:
            simulation.send_signal(signal.SIGINT)
    print(PICTURE)
    return 0


if __name__ == "__main__":
    sys.exit(main())
