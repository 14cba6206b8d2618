"""Mutants of whole ROS packages: ``python tests/bench/package_mutants [COUNT] [SEED] [--area AREA] [--kind KIND]``.

Six workspaces without defects (two written out, four that ``urdfkit new robot`` creates; ROS 1 and ROS 2) get one
mistake each, of more than two hundred kinds in five areas. A mutant counts as found if a finding is at the changed line
(one more or less), at the start tag or key that lacks something, inside the changed element, or quotes a name of the
mistake, old or new. It is found *at the line* in the first two cases, at a macro call that holds the change, or, where
a definition was renamed or removed, at a line that uses the name. A dependency or an installed folder that is missing
has no line: there any line of the file counts. Every other finding is counted as such: the workspaces have none.

A mutant is ignored if a reader of its file sees no difference: the parsed YAML, the canonical XML, the syntax tree of
Python or the commands of CMake are equal, or, for the model, the expanded robot is. `--write FILE` writes the table and
the misses to a file.
"""

from __future__ import annotations

import argparse
import multiprocessing
import random
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3]))

from tests.bench.package_mutants import (  # noqa: F401 (modules that register kinds)
    bases,
    configuration,
    launching,
    launching_python,
    model,
    model_control,
    model_xacro,
    packaging,
    srdf,
)
from tests.bench.package_mutants.judging import Report, Verdict, judge, lint
from tests.bench.package_mutants.mutant import KINDS, Mutant, Workspace

SHARES = {"model": 200, "YAML": 130, "launch": 120, "package": 80, "SRDF": 70}
TARGETS = {"model": 0.97, "YAML": 0.92, "launch": 0.85, "package": 0.85, "SRDF": 0.95}
AT_LINE, OTHERS = 0.95, 0.1


def candidates(workspaces: list[Workspace], area: str, name: str, seed: int) -> Iterator[Mutant]:
    """Yield the mutants of a kind, in an order drawn by seed, of one workspace after another."""
    of_base: list[list[Mutant]] = []
    for workspace in workspaces:
        lot = random.Random(f"{seed} {workspace.base} {area} {name}")
        made = [replace(m, area=area, kind=name, base=workspace.base) for m in KINDS[area][name](workspace, lot)]
        lot.shuffle(made)
        if made:
            of_base.append(made)
    random.Random(f"{seed} {area} {name}").shuffle(of_base)
    while any(of_base):
        for made in of_base:
            if made:
                yield made.pop()


def verdicts(workspaces: list[Workspace], options: argparse.Namespace) -> Iterator[Verdict]:
    """Yield the judgement of each mutant: the kinds of an area in turn."""
    folders = {workspace.base: workspace.folder for workspace in workspaces}
    for area, share in SHARES.items():
        if options.area not in ("", area):
            continue
        count = round(share * options.count / sum(SHARES.values()))
        kinds = [name for name in KINDS[area] if options.kind in ("", name)]
        drawn = {name: candidates(workspaces, area, name, options.seed) for name in kinds}
        while count and drawn:
            for name in list(drawn):
                verdict = _next(drawn[name], folders)
                if verdict is None:
                    del drawn[name]
                elif count:
                    count -= 1
                    yield verdict
                if not count:
                    break


def _next(mutants: Iterator[Mutant], folders: dict[str, Path]) -> Verdict | None:
    for mutant in mutants:
        verdict = _judge(mutant, folders[mutant.base])
        if verdict.effective:
            return verdict
    return None


def _judge(mutant: Mutant, folder: Path) -> Verdict:
    """Judge a mutant in a process of its own, so that the caches of the linter are those of the clean workspace."""
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=lambda: sender.send(judge(mutant, folder)))
    process.start()
    sender.close()
    try:
        verdict: Verdict = receiver.recv()
    except EOFError:
        verdict = Verdict(mutant, others=(Report("crash", "error", "the linter raised an exception"),))
    process.join()
    return verdict


def _miss(verdict: Verdict) -> str:
    mutant = verdict.mutant
    old, new = (" ".join(text.split())[:90] for text in (verdict.before, mutant.text))
    change = f"{old!r} -> {new!r}" if mutant.action == "edit" else f"{mutant.action} {new[:60]}"
    return f"{mutant.area}/{mutant.kind} {mutant.base}/{mutant.file}:{verdict.line} {change}"


def table(done: list[Verdict]) -> Iterator[str]:
    """Yield the lines of the report."""
    yield "area     mutants  found  target  at line  notes only  other findings per mutant"
    for area, target in TARGETS.items():
        rows = [verdict for verdict in done if verdict.mutant.area == area]
        if not rows:
            continue
        found = [verdict for verdict in rows if verdict.found]
        line = sum(verdict.at_line for verdict in found) / max(1, len(found))
        notes = sum(all(report.severity == "note" for report in verdict.found) for verdict in found)
        others = sum(len(verdict.others) for verdict in rows) / len(rows)
        share = len(found) / len(rows)
        yield f"{area:8s} {len(rows):7d} {share:6.1%} {target:7.0%} {line:8.1%} {notes:11d} {others:12.2f}"
    yield ""
    for area in TARGETS:
        total, hit = Counter[str](), Counter[str]()
        for verdict in done:
            if verdict.mutant.area == area:
                total[verdict.mutant.kind] += 1
                hit[verdict.mutant.kind] += bool(verdict.found)
        for name in sorted(total, key=lambda name: (hit[name] / total[name], name)):
            yield f"{area:8s} {name:36s} {hit[name]:3d} of {total[name]:3d}"
    groups: dict[str, list[str]] = defaultdict(list)
    for verdict in done:
        codes = " ".join(sorted({report.code for report in verdict.others}))
        if not verdict.found:
            groups["missed"].append(f"{_miss(verdict)}  [{codes}]")
        elif not verdict.at_line:
            places = sorted({f"{report.code} {report.file}:{report.first}" for report in verdict.found})
            groups["not at the line"].append(f"{_miss(verdict)}  [{', '.join(places)}]")
        if verdict.found and verdict.others:
            lines = [f"\n    {r.code} {r.file}:{r.first} {r.message}" for r in verdict.others]
            groups["other findings"].append(_miss(verdict) + "".join(lines))
    for title, lines in groups.items():
        yield f"\n{title}: {len(lines)}"
        yield from lines


def main() -> int:
    """Draw, lint and judge; exit with status 1 below a target."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", nargs="?", type=int, default=600)
    parser.add_argument("seed", nargs="?", type=int, default=20)
    parser.add_argument("--area", default="", choices=["", *SHARES])
    parser.add_argument("--kind", default="")
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        workspaces = []
        for name in bases.NAMES:
            folder = Path(temporary).resolve() / name
            folder.mkdir()
            bases.write(name, folder)
            workspaces.append(Workspace(name, folder))
            for report in lint(folder):
                print(f"{name}: {report.code} {report.file}:{report.first} {report.message}", file=sys.stderr)
                return 2
        written = options.write.resolve() if options.write is not None else None
        done = list(verdicts(workspaces, options))
    seconds = time.monotonic() - began
    lines = [
        *table(done),
        f"\n{len(done)} mutants of {sum(map(len, KINDS.values()))} kinds, seed {options.seed}, {seconds:.0f} s",
    ]
    print("\n".join(lines))
    if written is not None:
        written.write_text("\n".join(lines) + "\n", "utf-8")
    return 0 if _reached(done) else 1


def _reached(done: list[Verdict]) -> bool:
    reached = True
    for area, target in TARGETS.items():
        rows = [verdict for verdict in done if verdict.mutant.area == area]
        found = [verdict for verdict in rows if verdict.found]
        others = sum(len(verdict.others) for verdict in rows)
        exact = sum(verdict.at_line for verdict in found)
        reached &= len(found) >= target * len(rows) and exact >= AT_LINE * len(found) and others <= OTHERS * len(rows)
    return reached


if __name__ == "__main__":
    sys.exit(main())
