"""From opening a package to its findings in an editor, and from a save to the picture of the preview.

Run it as ``python -m tests.bench.bench_editor [SAVES] [ROBOT]...``, by default with robots of the corpus next to the
checkout where it exists, else with bundled robots. For each robot:

- A fresh ``urdfkit lsp`` that has been idle for 2.5 s opens the file: wall and CPU time until the findings are
  published.
- ``urdfkit view`` shows the file in a copy of its package, or of its repository in the corpus, in Chromium; each save
  changes the name of the robot: wall time from the save until the page has received the robot, and until the page,
  rendered by the processor, has drawn it.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

from tests.bench.bench_lsp import cpu_of, spread
from tests.cli.conftest import CHROMIUM, FLAGS, READY
from tests.lsp.conftest import connected
from tests.processes import running
from urdfkit.description.packages.related_files import package_of

ROOT = Path(__file__).parents[2]
CORPUS = (ROOT.parent / "shared" / "corpus").resolve()
NAMES = (
    "husky/husky_description/urdf/husky.urdf.xacro",
    "jackal/jackal_description/urdf/jackal.urdf.xacro",
    "turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf",
    "Universal_Robots_ROS2_Description/urdf/ur.urdf.xacro",
    "franka_description/robots/fr3/fr3.urdf.xacro",
    "linorobot2/linorobot2_description/urdf/robots/2wd.urdf.xacro",
    "turtlebot4/turtlebot4_description/urdf/standard/turtlebot4.urdf.xacro",
    "anymal_b_simple_description/urdf/anymal.urdf",
    "ros2_control_demos/example_1/description/urdf/rrbot.urdf.xacro",
    "unitree_ros/robots/a1_description/xacro/robot.xacro",
    "ros2_control_demos/example_7/description/urdf/r6bot.urdf.xacro",
)
BUNDLED = ("simpleton", "mybot", "gem_e2", "heterogeneous", "artoo", "seven_dof_arm")
IDLE = 2.5
DRAWN = """(before) => { window.drawn = new Promise((done) => {
  let received;
  const { viewer } = urdfkit.viewport;
  const draw = () => (viewer.needs_render ? requestAnimationFrame(draw) : done([received, Date.now()]));
  const look = async () => {
    if (urdfkit.scene.model === before) return setTimeout(look, 5);
    received = Date.now();
    await urdfkit.scene.settled();
    requestAnimationFrame(draw);
  };
  look();
}); }"""


def robots() -> list[Path]:
    """Return the files of the robots to measure."""
    found = [CORPUS / name for name in NAMES if (CORPUS / name).is_file()]
    return found or [next((ROOT / "robots" / name).rglob(f"{name}*.xacro")) for name in BUNDLED]


def first_finding(robot: Path) -> tuple[float, float]:
    """Return wall and CPU seconds from opening a file until its findings are published, by a fresh server."""
    folder = robot.parents[1]
    with connected(folder) as client:
        time.sleep(IDLE)
        name = str(robot.relative_to(folder))
        before, start = cpu_of(client.process.pid), time.perf_counter()
        client.open(name)
        client.published(name)
        return time.perf_counter() - start, cpu_of(client.process.pid) - before


def preview(browser: Browser, robot: Path, folder: Path, saves: int) -> list[tuple[float, float]]:
    """Return the seconds from each save of a copy of a robot until the page has received it, and has drawn it."""
    text = robot.read_text("utf-8")
    top = package_of(robot) or robot.parent
    if robot.is_relative_to(CORPUS):  # the repository, as a robot may include files of other packages
        top = CORPUS / robot.relative_to(CORPUS).parts[0]
    shutil.copytree(top, folder / top.name, copy_function=shutil.copyfile, dirs_exist_ok=True)
    shown = folder / robot.relative_to(top.parent)
    words = [sys.executable, "-m", "urdfkit", "view", str(shown), "--no-browser", "--port", "0"]
    words += ["--package-path", str(folder / top.name)]
    times = []
    with running(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        assert process.stdout is not None
        if not (address := process.stdout.readline().strip()):
            return []  # the robot needs arguments
        page = browser.new_page(viewport={"width": 640, "height": 480})
        page.goto(address)
        page.wait_for_selector(READY)
        page.evaluate("urdfkit.scene.settled()")
        time.sleep(IDLE)
        for number in range(saves):
            time.sleep(0.37)  # not a multiple of the period in which the files are checked
            page.evaluate(f"({DRAWN})(urdfkit.scene.model)")
            shown.write_text(re.sub(r"(<robot\b[^>]*\bname=\")[^\"]*", rf"\g<1>saved{number}", text, count=1))
            start = time.time()
            received, drawn = page.evaluate("window.drawn")
            times.append((received / 1e3 - start, drawn / 1e3 - start))
        page.close()
    return times


def main() -> int:
    saves = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    walls, cpus, shown = [], [], []
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for robot in [Path(name).resolve() for name in sys.argv[2:]] or robots():
            wall, cpu = first_finding(robot)
            times = preview(browser, robot, Path(folder), saves)
            walls.append(wall)
            cpus.append(cpu)
            shown += times
            print(
                f"{robot.name:26s} findings {wall * 1e3:4.0f} ms, CPU {cpu * 1e3:4.0f} ms; preview {described(times)}"
            )
        browser.close()
    print(f"findings {spread(walls)}; CPU {spread(cpus)}; preview {described(shown)}")
    return 0


def described(times: list[tuple[float, float]]) -> str:
    if not times:
        return "-"
    received, drawn = zip(*times, strict=True)
    return f"received {spread([*received])}, drawn {spread([*drawn])}"


if __name__ == "__main__":
    sys.exit(main())
