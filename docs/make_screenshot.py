#!/usr/bin/env python3
"""Make the pictures and films of the documentation with the real program: its own renderer, or its page in a browser.

Run in the root of a checkout with the test extras and Chromium: ``python docs/make_screenshot.py [NAME …]``.
Without names, all pictures of the table `PICTURES` are made.
"""

from __future__ import annotations

import io
import shlex
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from PIL import Image
from playwright.sync_api import Page, sync_playwright

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))
IMAGES = ROOT / "docs/images"
CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--no-first-run"]
PATIENCE = 580_000
"""Time for the kernels to be compiled [ms]."""
SLOWER = 0.08
"""Speed of the simulation while it is filmed, since software draws few frames per second: the film has full speed."""
FRAME = 0.2
"""Least simulated time between two frames of the film [s]."""
FILM_SIZE = (640, 384)
"""Pixels of the film."""
ROUTE = (("w", 2.0), ("a", 1.0), ("w", 2.2), ("d", 1.6), ("w", 1.4))
"""Keys that are held while the film is made, and for how long [s of simulated time]."""
LIMITS = {"picture": 120_000, "film": 400_000}
"""Maximum size of a file [byte]."""


def look(page: Page) -> None:
    """Turn Artoo's head, select it, show its numbers, the frames and the joint axes."""
    page.evaluate("urdfkit.page.setJoints({ head_joint: 0.6 })")
    page.evaluate("urdfkit.page.select({ link: 'head' })")
    page.keyboard.press("x")
    page.keyboard.press("j")
    page.locator("#open-inspect").click()
    page.locator("#robot-name").click()
    page.wait_for_timeout(1000)


def show_findings(page: Page) -> None:
    """Open the panel of findings."""
    page.evaluate("urdfkit.page.panels.open('findings')")
    page.wait_for_timeout(1500)


def drive_and_plot(page: Page) -> None:
    """Drive a curve with plots of the speeds."""
    page.evaluate("urdfkit.page.panels.close('drive')")
    for field in ("linear.x", "angular.z"):
        page.evaluate(f"urdfkit.plots.add('/simpleton/odom', 'twist.twist.{field}')")
    _drive(page, (("w", 3.0), ("a", 2.0), ("w", 2.0)))
    page.wait_for_timeout(2000)


def sense(page: Page) -> None:
    """Drive into the house with the images and scans in view."""
    page.evaluate("urdfkit.page.panels.close('drive')")
    page.evaluate("urdfkit.page.panels.open('sensors')")
    _drive(page, (("w", 1.5),))
    page.wait_for_timeout(5000)


def show_world(page: Page) -> None:
    """Show the whole world."""
    page.evaluate("urdfkit.page.panels.close('drive')")
    page.mouse.move(400, 400)
    for _ in range(4):
        page.mouse.wheel(0, 400)
        page.wait_for_timeout(200)
    page.mouse.move(600, 10)  # off the robot, whose part would be named
    page.wait_for_timeout(4000)


def _drive(page: Page, route: tuple[tuple[str, float], ...]) -> None:
    page.locator("#robot-name").click()
    until = page.evaluate("urdfkit.page.status.time")
    for key, seconds in route:
        until += seconds
        page.keyboard.down(key)
        while page.evaluate("urdfkit.page.status.time") < until:  # the page permits no `wait_for_function`
            page.wait_for_timeout(50)
        page.keyboard.up(key)


def film(page: Page) -> list[tuple[float, Image.Image]]:
    """Return time and picture of Simpleton among cylinders, with its camera image and plots of its speeds."""
    page.evaluate("urdfkit.page.panels.close('drive')")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.linear.x')")
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.angular.z')")
    page.evaluate("urdfkit.page.panels.open('sensors')")
    page.evaluate(f"urdfkit.page.connection.request('speed', {{ factor: {SLOWER} }})")
    page.locator("#robot-name").click()
    frames: list[tuple[float, Image.Image]] = []
    until = page.evaluate("urdfkit.page.status.time")
    for key, seconds in ROUTE:
        until += seconds
        page.keyboard.down(key)
        while (now := page.evaluate("urdfkit.page.status.time")) < until:
            if not frames or now >= frames[-1][0] + FRAME:
                picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
                frames.append((now, picture.resize(FILM_SIZE, Image.Resampling.LANCZOS)))
        page.keyboard.up(key)
    return [*frames, (until, frames[-1][1])]


class Picture(NamedTuple):
    """One picture or film.

    Attributes:
        command: words after ``urdfkit``.
        act: what happens on the page before the picture is taken; None for the renderer (``--image``, ``--video``).
        course: the page of the documentation whose files are written first, into the folder of the command.
        defects: text in Simpleton → text that replaces it, in the file `faulty.urdf`.
    """

    command: str
    act: Callable[[Page], object] | None = None
    course: str = ""
    defects: tuple[tuple[str, str], ...] = ()


DEFECTS = (('type="continuous"', 'type="continous"'),)
BENT = "--joint shoulder_pitch_joint=0.5 --joint elbow_pitch_joint=0.9"
OFFICE = "turtlebot_gazebo/worlds/turtleoffice.world"
RENDERED = "--size 640,400 --image"
PICTURES = {
    "driving": Picture("sim teleop simpleton --world cylinders", film),
    "viewing": Picture("view artoo", look),
    "findings": Picture("view faulty.urdf", show_findings, defects=DEFECTS),
    "plots": Picture("sim teleop simpleton --world cylinders", drive_and_plot),
    "sensors": Picture("sim teleop diff_wheeled_robot_with_laser --world house", sense),
    "office": Picture(f"sim teleop simpleton --world {OFFICE}", show_world, "tutorials/world_package.md"),
    "town": Picture("sim teleop artoo --renderer ray --world town.sdf", show_world, "tutorials/town.md"),
    "simpleton": Picture(f"view simpleton.urdf.xacro {RENDERED}", None, "tutorials/simpleton.md"),
    "mybot": Picture(f"view mybot.urdf.xacro {RENDERED}", None, "tutorials/mybot.md"),
    "scanner": Picture(f"view rover.urdf.xacro {RENDERED}", None, "tutorials/scanner.md"),
    "car": Picture(f"view car.urdf.xacro {RENDERED}", None, "tutorials/car.md"),
    "pendulum": Picture(f"view rrbot_description --joint joint2=0.6 {RENDERED}", None, "tutorials/pendulum.md"),
    "arm": Picture(f"view arm7_description {BENT} {RENDERED}", None, "tutorials/arm.md"),
    "gripper": Picture(f"view picker_description {RENDERED}", None, "tutorials/gripper.md"),
    "holonomic": Picture(f"view platform.urdf.xacro {RENDERED}", None, "tutorials/holonomic.md"),
    "scout": Picture(f"view ws/src/scout_description {RENDERED}", None, "tutorials/new_robot.md"),
    "artoo": Picture("view artoo.urdf.xacro --seconds 4 --video", None, "tutorials/artoo.md"),
    "joints": Picture("view seven_dof_arm --motion joints --video"),
}  # fmt: skip
"""Name of the file in docs/images, without .webp → how it is made."""


def take(name: str, folder: Path) -> Path:
    """Make one picture in an empty folder.

    Raises:
        RuntimeError: the file is too large.
    """
    from tests.docs.course import prepare

    picture, file = PICTURES[name], IMAGES / f"{name}.webp"
    IMAGES.mkdir(exist_ok=True)
    if picture.course:
        prepare((ROOT / "docs" / picture.course).read_text("utf-8"), folder)
    program = [sys.executable, "-m", "urdfkit"]
    if picture.defects:
        text = subprocess.run([*program, "expand", "simpleton"], capture_output=True, text=True, check=True).stdout
        for old, new in picture.defects:
            text = text.replace(old, new, 1)
        (folder / "faulty.urdf").write_text(text)
    if not picture.course and not picture.defects:
        folder = ROOT  # pages show the paths of bundled robots relative to it
    command = [*program, *shlex.split(picture.command)]
    if picture.act is None:
        subprocess.run([*command, str(file)], cwd=folder, check=True)
    else:
        _of_page([*command, "--port", "0", "--no-browser"], folder, picture.act, file)
    with Image.open(file) as image:
        kind = "film" if getattr(image, "is_animated", False) else "picture"
    if file.stat().st_size > LIMITS[kind]:
        raise RuntimeError(f"{file} has {file.stat().st_size} bytes; the limits are {LIMITS}")
    return file


def _of_page(command: list[str], folder: Path, act: Callable[[Page], object], file: Path) -> None:
    with (
        subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True) as process,
        sync_playwright() as playwright,
    ):
        try:
            address = process.stdout.readline().strip() if process.stdout else ""
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            scale = 1.0 if act is film else 1.5
            page = browser.new_page(viewport={"width": 1200, "height": 720}, device_scale_factor=scale)
            page.goto(address)
            page.wait_for_selector("body[data-ready=true]", timeout=PATIENCE)
            page.wait_for_selector("#progress", state="hidden", timeout=PATIENCE)
            frames = act(page)
            if isinstance(frames, list):
                times, pictures = zip(*frames, strict=True)
                length = [round(1000 * (after - before)) for before, after in pairwise(times)]
                options = {"save_all": True, "append_images": pictures[1:-1], "duration": length, "loop": 0}
                pictures[0].save(file, quality=40, method=4, **options)
            else:
                Image.open(io.BytesIO(page.screenshot())).convert("RGB").save(file, quality=80, method=6)
            browser.close()
        finally:
            process.send_signal(signal.SIGINT)


if __name__ == "__main__":
    for each in sys.argv[1:] or PICTURES:
        with tempfile.TemporaryDirectory() as temporary:
            print(take(each, Path(temporary).resolve()))
