"""New robots of random sizes and masses, every drive: how far they are from what they are told.

    python tests/bench/bench_drives.py [ROBOTS [SEED]]

Straight on, on the spot, and in curves of 0.4 m/s²; the greatest of each, and what is more than 1 % off or tips, with
what it was made from. The linter has to find nothing.
"""

from __future__ import annotations

import itertools
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.scaffold.drive_search import commands, drawn, errors, made
from urdfkit.lint import lint
from urdfkit.resources import templates_dir
from urdfkit.scaffold import load_template


def main() -> int:
    """Search; return 1 if anything was off."""
    count, seed = (int(word) for word in (*sys.argv[1:], *("60", "1")[len(sys.argv) - 1 :]))
    template, bad = load_template(templates_dir() / "robot"), 0
    for drive in ("diff", "skid", "ackermann", "omni"):
        worst = [0.0, 0.0, 0.0]
        for answers in itertools.islice(drawn(template, drive, seed), count):
            with tempfile.TemporaryDirectory() as folder:
                robot = made(template, answers, Path(folder))
                found = [f"{finding.code} {finding.message}" for finding in lint([folder])]
                off = [errors(robot, v, w) for v, w in commands(answers)]
            worst = [max(pair) for pair in zip(worst, *off, strict=True)]
            if found or max(map(max, off)) > 0.01:
                bad += 1
                sizes = {key: answers[key] for key in answers if key.startswith(("base_", "wheel_", "mass"))}
                print(f"  {drive} {found[:1]} {off} {sizes}")
        print(
            f"{drive:10} {count} robots: speed {worst[0]:.2%}, rate {worst[1]:.2%}, tilt {worst[2]:.1e} rad", flush=True
        )
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
