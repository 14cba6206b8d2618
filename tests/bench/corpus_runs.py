"""Real robots, and real robots with defects: does each simulate and show, and does the linter report each repair?

Run it as ``python tests/bench/corpus_runs.py [TEXT …] [--variants …] [--seconds 5] [--jobs 2] [--results FILE]``; TEXT
selects entries by a part of their path. Each case is appended to FILE when it ends; cases in FILE are not run again.
The order is at random with a fixed seed, and neighbouring cases have different variants, so that a part of a run is
a sample of the whole. It takes every entry of the corpus beside the checkout that expands to a robot,
in these variants:

- ``as-is``: without its meshes, which the corpus does not contain;
- ``meshes``: each mesh file is the pointer that a clone without Git LFS has in its place;
- ``inertials``: without any ``<inertial>``;
- ``tensors``: the largest moment of each tensor is multiplied by ten, which no distribution of mass has;
- ``plugins``: the plugins of hardware and of Gazebo have names that nobody knows.

An entry passes a simulation if the state stays finite and no collision shape is more than a centimetre below the ground
at the end. A link of a robot with a fixed base that starts below the ground may stay there, but not sink. An entry
passes the viewer if ``view --html`` exits with status 0 and the page holds its links. Each repair must have a finding
of its code at its element. Every case runs in a process with limits of time and memory.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import multiprocessing
import os
import random
import resource
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from functools import cache
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from urdfkit import Simulator, expand, lint
from urdfkit.cli import main as urdfkit
from urdfkit.description.loading import load_repaired
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import start_tag
from urdfkit.errors import UrdfkitError
from urdfkit.scene.extent import shape_bounds
from urdfkit.sim.state.quaternion import rotate

CORPUS = Path(__file__).parents[2].parent / "shared" / "corpus"
VARIANTS = ("as-is", "meshes", "inertials", "tensors", "plugins")
DEPTH = 0.01
"""Depth below the ground that a collision shape may gain in contact [m]."""
CPU_SECONDS, BYTES = 300, 6 * 10**9
POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:{}\nsize 40584\n".format("0" * 64)

CAUSES = {"I503": ("I505", "X119"), "I502": ("I505",), "E014": ("E010", "E012")}
"""Code → codes of the findings that name the cause of the same defect instead."""

Case = dict[str, Any]


def copied(folder: Path, *, pointers: bool) -> Path:
    """Copy the corpus, with the installed layout of packages that need one; with pointers in place of meshes."""
    corpus = folder / "corpus"
    shutil.copytree(CORPUS, corpus)
    if pointers:
        for mesh in json.loads((CORPUS / "meshes.json").read_text())["meshes"]:
            path = corpus / mesh["path"]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(POINTER)
    for entry in entries():
        for name in entry.get("install_layout", []):
            share = folder / "share" / name
            if share.exists():
                continue
            source = next(
                path.parent for path in corpus.glob("ros2_control_demos/*/package.xml") if name in _name(path)
            )
            share.mkdir(parents=True)
            shutil.copy(source / "package.xml", share)
            for child in (*(source / "description").iterdir(), *source.glob("bringup/*")):
                (share / child.name).symlink_to(child)
    return corpus


def _name(package: Path) -> tuple[str]:
    return ((ElementTree.parse(package).findtext("name") or "").strip(),)


def entries() -> list[dict[str, Any]]:
    """Return the entries of the corpus that expand to a robot."""
    return list(json.loads((CORPUS / "expected.json").read_text())["models"])


def with_defects(xml: str, variant: str) -> str:
    """Return a robot with the defects of a variant."""
    robot = ElementTree.fromstring(xml)
    if variant == "inertials":
        for link in robot.iter("link"):
            for inertial in link.findall("inertial"):
                link.remove(inertial)
    elif variant == "tensors":
        for inertia in robot.iter("inertia"):
            largest = max(("ixx", "iyy", "izz"), key=lambda name: float(inertia.get(name, "0")))
            inertia.set(largest, repr(10.0 * float(inertia.get(largest, "0"))))
    elif variant == "plugins":
        for plugin in robot.iter("plugin"):
            if plugin.get("filename") is not None:
                plugin.set("filename", "libunknown_driver.so")
        for plugin in robot.iterfind(".//hardware/plugin"):
            plugin.text = "unknown_driver/UnknownHardware"
    return ElementTree.tostring(robot, encoding="unicode")


def run(entry: dict[str, Any], variant: str, corpus: Path, options: argparse.Namespace) -> Case:
    """Simulate, lint and show one entry in one variant."""
    path, arguments = corpus / entry["entry"], dict(entry.get("args", {}))
    package_path = [corpus.parent / "share"] if "install_layout" in entry else []
    if variant in ("inertials", "tensors", "plugins"):
        xml = expand(path, arguments=arguments, package_path=package_path)
        path = path.with_name(f"{path.name.split('.')[0]}.{variant}.{os.getpid()}.urdf")
        path.write_text(with_defects(xml, variant))
        arguments = {}
    case: Case = {"entry": entry["entry"], "variant": variant}
    notes: list[str] = []
    started = time.process_time()
    repairs = []
    try:
        robot = load_repaired(path, arguments=arguments, package_path=package_path)
        simulator = Simulator(robot, note=notes.append)
        repairs = list(simulator.repairs)
        before = _lowest(simulator)
        case["load_s"] = round(time.process_time() - started, 2)
        simulator.run(options.seconds)
        after = _lowest(simulator)
        fixed = not simulator.kinematics.floating_base
        sunk = {name: round(z, 4) for name, z in after.items() if z < min(before[name] if fixed else 0.0, 0.0) - DEPTH}
        case["sim"] = "below the ground" if sunk else "ok"
        case["reason"] = str(sunk) if sunk else ""
        case["below"] = {name: [round(before[name], 4), round(z, 4)] for name, z in after.items() if z < -DEPTH}
        if not np.isfinite(simulator.link_poses()).all():
            case["sim"] = "not finite"
    except UrdfkitError as error:
        case["sim"], case["reason"] = "refused", str(error)
    except Exception:
        case["sim"], case["reason"] = "crashed", traceback.format_exc(limit=-3)
    case["sim_s"] = round(time.process_time() - started, 2)
    case["repairs"], case["notes"] = len(repairs), len(notes)
    if options.notes:
        case["texts"] = notes
    case["unreported"] = _unreported(repairs, path, arguments, package_path) if repairs else []
    if not options.no_view:
        case["view"] = _view(path, arguments, package_path, entry)
    return case


def _lowest(simulator: Simulator) -> dict[str, float]:
    """Return the lowest point of each link's collision shapes [m]."""
    found: dict[str, float] = {}
    poses = simulator.link_poses()
    for shape in simulator.scene.with_role("collision"):
        pose = poses[simulator.scene.body_index[shape.body]]
        placement = np.eye(4)
        placement[:3, 3] = pose[:3]
        placement[:3, :3] = np.array([rotate(pose[3:], axis) for axis in np.eye(3)]).T
        low = float(shape_bounds(shape, placement)[0, 2])
        found[shape.body] = min(low, found.get(shape.body, low))
    return found


def _unreported(repairs: list[Any], path: Path, arguments: dict[str, str], package_path: list[Path]) -> list[str]:
    """Return the repairs without a finding of their code at their start tag."""
    missing: list[Any] = repairs
    # Robots without any mass describe kinematics only, unless they are linted for a simulator.
    for target in (None, "gz", "urdfkit"):
        findings = lint(path, arguments=arguments, package_path=package_path, target=target)
        missing = [repair for repair in missing if not any(_reports(finding, repair) for finding in findings)]
        if not missing:
            break
    return [f"{repair.code} {repair}" for repair in missing]


def _reports(finding: Any, repair: Any) -> bool:
    """Return whether a finding is about the defect of a repair: a code at the element, or at one of its attributes."""
    place = repair.position
    if place is None or Path(finding.span.file).resolve() != Path(place.file).resolve():
        return False
    if repair.code is not None and finding.code not in (repair.code, *CAUSES.get(repair.code, ())):
        return False
    tag = start_tag(_source(place.file), place)
    last = place.line if tag is None else tag.span.end_line
    return bool(place.line <= finding.span.line <= last)


@cache
def _source(file: str) -> Source:
    return Source(file, Path(file).read_text())


def _view(path: Path, arguments: dict[str, str], package_path: list[Path], entry: dict[str, Any]) -> str:
    """Show a robot in a page; return `ok`, or the reason why it is not shown."""
    page = path.with_name(f"{path.name}.{os.getpid()}.html")
    words = ["view", str(path), *(f"{name}:={value}" for name, value in arguments.items()), "--html", str(page), "-q"]
    output = io.StringIO()
    try:
        with contextlib.redirect_stderr(output), contextlib.redirect_stdout(output):
            status = urdfkit([*words, *(word for folder in package_path for word in ("--package-path", str(folder)))])
        if status != 0:
            return f"status {status}: {output.getvalue().strip().splitlines()[-1]}"
        text = page.read_text()
        links = [link.name for link in load_repaired(path, arguments=arguments, package_path=package_path).links]
        missing = [link for link in links if json.dumps(link)[1:-1] not in text]
        return f"not on the page: {missing}" if missing else "ok"
    except Exception:
        return traceback.format_exc(limit=-3)
    finally:
        page.unlink(missing_ok=True)


def _work(out: Connection, entry: dict[str, Any], variant: str, corpus: Path, options: argparse.Namespace) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    try:
        out.send(run(entry, variant, corpus, options))
    except BaseException:
        case = {"entry": entry["entry"], "variant": variant, "sim": "crashed", "reason": traceback.format_exc(limit=-3)}
        out.send(case)


def cases(options: argparse.Namespace) -> list[Case]:
    """Run all selected cases, each in a process of its own."""
    Simulator("simpleton", note=lambda _: None).run(0.01)  # The children share the loaded modules and kernels.
    lint("simpleton")
    fork = multiprocessing.get_context("fork")
    results = saved(options.results)
    with tempfile.TemporaryDirectory() as whole, tempfile.TemporaryDirectory() as pointers:
        plain = copied(Path(whole), pointers=False)
        broken = copied(Path(pointers), pointers=True) if "meshes" in options.variants else plain
        done = {(case["entry"], case["variant"]) for case in results}
        waiting = [
            (entry, variant, broken if variant == "meshes" else plain)
            for entry, variant in in_order(options.text, options.variants)
            if (entry["entry"], variant) not in done
        ]
        running: dict[Connection, tuple[Any, dict[str, Any], str]] = {}
        while waiting or running:
            while waiting and len(running) < options.jobs:
                entry, variant, corpus = waiting.pop(0)
                receiving, sending = fork.Pipe(duplex=False)
                process = fork.Process(target=_work, args=(sending, entry, variant, corpus, options))
                process.start()
                sending.close()
                running[receiving] = process, entry, variant
            for ready in wait(list(running)):
                process, entry, variant = running.pop(ready)  # type: ignore[index]
                try:
                    case = ready.recv()  # type: ignore[union-attr]
                except EOFError:
                    process.join()
                    reason = f"ended with {process.exitcode}"
                    case = {"entry": entry["entry"], "variant": variant, "sim": "crashed", "reason": reason}
                process.join()
                results.append(case)
                show(case)
                if options.results is not None:
                    with options.results.open("a") as file:
                        file.write(json.dumps(case) + "\n")
    return results


def saved(file: Path | None) -> list[Case]:
    """Return the cases of a file of results."""
    if file is None or not file.exists():
        return []
    return [json.loads(line) for line in file.read_text().splitlines()]


def in_order(texts: list[str], variants: list[str]) -> list[tuple[dict[str, Any], str]]:
    """Return the selected cases: all entries at random, each in the next variant, and again for the other variants."""
    selected = [entry for entry in entries() if not texts or any(text in entry["entry"] for text in texts)]
    random.Random(19).shuffle(selected)
    return [
        (entry, variants[(number + turn) % len(variants)])
        for turn in range(len(variants))
        for number, entry in enumerate(selected)
    ]


def show(case: Case) -> None:
    """Print a case that does not pass."""
    head = f"{case['variant']:9s} {case['entry']}"
    if case["sim"] != "ok":
        print(f"{head}: {case['sim']}: {case['reason']}", flush=True)
    if case.get("view", "ok") != "ok":
        print(f"{head}: view: {case['view']}", flush=True)
    for line in case.get("unreported", []):
        print(f"{head}: no finding: {line}", flush=True)


def summary(results: list[Case]) -> None:
    """Print the share of entries that pass, by variant."""
    print(
        f"{'variant':10s} {'entries':>7s} {'simulated':>10s} {'shown':>7s} {'repairs':>8s} {'unreported':>10s}  other"
    )
    for variant in VARIANTS:
        own = [case for case in results if case["variant"] == variant]
        if not own:
            continue
        outcomes = Counter(case["sim"] for case in own)
        shown = sum(case.get("view") == "ok" for case in own)
        repairs = sum(case.get("repairs", 0) for case in own)
        unreported = sum(len(case.get("unreported", [])) for case in own)
        rest = ", ".join(f"{n} {name}" for name, n in outcomes.items() if name != "ok")
        simulated, viewed = 100.0 * outcomes["ok"] / len(own), 100.0 * shown / len(own)
        print(f"{variant:10s} {len(own):7d} {simulated:8.1f} % {viewed:5.1f} % {repairs:8d} {unreported:10d}  {rest}")


def main() -> int:
    """Run what the command line selects."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("text", nargs="*", metavar="TEXT", help="part of the path of an entry (default: all)")
    parser.add_argument("--variants", nargs="+", choices=VARIANTS, default=VARIANTS)
    parser.add_argument("--seconds", type=float, default=5.0, help="simulated time [s] (default: 5)")
    parser.add_argument("--jobs", type=int, default=2, help="processes (default: 2)")
    parser.add_argument("--no-view", action="store_true", help="do not run `view --html`")
    parser.add_argument("--notes", action="store_true", help="keep the warnings in the results")
    parser.add_argument("--results", type=Path, metavar="FILE", help="append each case to a file of JSON lines")
    options = parser.parse_args()
    results = cases(options)
    summary(results)
    passed = all(case["sim"] == "ok" and not case["unreported"] and case.get("view", "ok") == "ok" for case in results)
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
