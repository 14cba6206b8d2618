"""``urdfkit lint FILE`` beside ``xacro FILE | check_urdf``: whole processes, in turns, on the same file.

Run it as ``python tests/bench/bench_lint.py [FILE] [RUNS]``; check_urdf is in Debian's liburdfdom-tools.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent


def main() -> int:
    file = sys.argv[1] if len(sys.argv) > 1 else str(HERE / "ten_links.urdf.xacro")
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    bin_folder = Path(sys.executable).parent
    check_urdf = shutil.which("check_urdf") or "/usr/bin/check_urdf"
    if not Path(check_urdf).is_file():
        print("check_urdf is not installed: apt install liburdfdom-tools", file=sys.stderr)
        return 2
    ours = [str(bin_folder / "urdfkit"), "lint", file]
    theirs = f"'{bin_folder}/xacro' '{file}' | '{check_urdf}' /dev/stdin"
    assert subprocess.run(ours, capture_output=True, check=False).returncode == 0, "the file is expected to be clean"
    assert b"Successfully Parsed" in subprocess.run(theirs, shell=True, capture_output=True, check=True).stdout
    timings: dict[str, list[tuple[float, float]]] = {"ours": [], "theirs": []}
    for _ in range(runs):
        timings["ours"].append(measured(ours))
        timings["theirs"].append(measured(["sh", "-c", theirs]))
    for index, kind in enumerate(("wall", "cpu")):
        own, other = (statistics.median(pair[index] for pair in timings[who]) for who in ("ours", "theirs"))
        times = f"urdfkit lint {own * 1e3:6.1f} ms   xacro | check_urdf {other * 1e3:6.1f} ms"
        print(f"{kind:4s}  {times}   ratio {own / other:.2f}")
    return 0


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
