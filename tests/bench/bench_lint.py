"""``urdfkit lint FILE`` next to ``xacro FILE | check_urdf``: whole processes, in turns, on the same file.

Run it as ``python tests/bench/bench_lint.py [FILE] [RUNS]``, or with ``--sizes [RUNS]`` on ten chains of 4 to 1,200
links; check_urdf is in Debian's liburdfdom-tools.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1]))

from tests.bench.bench_lsp import robot  # noqa: E402

SIZES = (4, 10, 20, 50, 100, 200, 400, 600, 900, 1200)
"""Links of the ten chains that ``--sizes`` measures."""


def main() -> int:
    sizes = "--sizes" in sys.argv
    words = [word for word in sys.argv[1:] if word != "--sizes"]
    check_urdf = shutil.which("check_urdf") or "/usr/bin/check_urdf"
    if not Path(check_urdf).is_file():
        print("check_urdf is not installed: apt install liburdfdom-tools", file=sys.stderr)
        return 2
    if not sizes:
        file = words[0] if words else str(HERE / "ten_links.urdf.xacro")
        compared(file, int(words[1]) if len(words) > 1 else 40, check_urdf)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        for links in SIZES:
            path = Path(folder) / f"chain_{links}.urdf.xacro"
            path.write_text(robot(links, "1.0", form="macro"))
            print(f"{links} links")
            compared(str(path), int(words[0]) if words else 10, check_urdf)
    return 0


def compared(file: str, runs: int, check_urdf: str) -> None:
    """Run both on a file in turns, ours without and with what it remembers, and print medians and ratios."""
    bin_folder = Path(sys.executable).parent
    ours = [str(bin_folder / "urdfkit"), "lint", "--quiet", file]
    theirs = f"'{bin_folder}/xacro' '{file}' | '{check_urdf}' /dev/stdin"
    assert subprocess.run(ours, capture_output=True, check=False).returncode == 0, "the file is expected to be clean"
    assert b"Successfully Parsed" in subprocess.run(theirs, shell=True, capture_output=True, check=True).stdout
    commands = {"anew": [*ours, "--no-cache"], "again": ours, "theirs": ["sh", "-c", theirs]}
    timings: dict[str, list[tuple[float, float]]] = {who: [] for who in commands}
    for _ in range(runs):
        for who, command in commands.items():
            timings[who].append(measured(command))
    for index, kind in enumerate(("wall", "cpu")):
        anew, again, other = (statistics.median(pair[index] for pair in timings[who]) for who in commands)
        times = (
            f"urdfkit lint {anew * 1e3:7.1f} ms, again {again * 1e3:6.1f} ms   xacro | check_urdf {other * 1e3:7.1f} ms"
        )
        print(f"{kind:4s}  {times}   ratio {anew / other:.2f}, again {again / other:.2f}")


def measured(command: list[str]) -> tuple[float, float]:
    """Run a command; return wall seconds and CPU seconds of it and its children."""
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": ""}
    cpu, wall = cpu_of_children(), time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, env=environment)
    return time.perf_counter() - wall, cpu_of_children() - cpu


def cpu_of_children() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


if __name__ == "__main__":
    sys.exit(main())
