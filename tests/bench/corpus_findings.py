"""Findings on real repositories: how many per repository, and a sample by seed to judge as their maintainers would.

Run it as ``python tests/bench/corpus_findings.py [--draw N --seed S] [--verdicts FILE]``. It lints each repository of
the corpus next to the checkout as ``urdfkit lint .`` would in it, with the arguments that its launch files pass, and
without the findings on meshes that exist upstream, since the corpus contains neither launch files nor meshes.

It prints errors and warnings per repository and their groups: findings of one rule with the same sentence, names and
numbers aside. The median is that of the repositories with robots that work in practice, so without the test data of
parsers. ``--draw`` prints a sample with about the same number of findings of each rule. ``--verdicts`` compares a file
with judged findings: how many of them are right, and which findings of today have none.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from urdfkit.errors import ResourceError
from urdfkit.lint import Finding
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry, find_entries
from urdfkit.lint.project.options import Options

CORPUS = Path(__file__).parents[2].parent / "shared" / "corpus"
VERDICTS = Path(__file__).with_name("corpus_verdicts.tsv")
TEST_DATA = ("sdformat", "urdfdom", "xacro")
"""Repositories of the corpus whose descriptions are tests of a parser, many of them defective on purpose."""

Found = tuple[str, Finding]
"""A repository and a finding in it."""


def findings(corpus: Path = CORPUS) -> Iterator[Found]:
    """Yield the findings in each repository of the corpus."""
    expected = json.loads((corpus / "expected.json").read_text())
    arguments = {each["entry"]: each["args"] for each in expected["models"] if each.get("args")}
    upstream = {mesh["path"].rpartition("/")[2] for mesh in json.loads((corpus / "meshes.json").read_text())["meshes"]}
    for repository in sorted(path for path in corpus.iterdir() if path.is_dir()):
        with contextlib.chdir(repository):
            try:
                entries = find_entries(["."])
            except ResourceError:  # no description
                continue
            groups: dict[str, list[Entry]] = {}
            for entry in entries:
                passed = arguments.get(f"{repository.name}/{os.path.normpath(entry.path)}", {})
                groups.setdefault(json.dumps(passed), []).append(entry)
            for passed_to, group in groups.items():
                options = Options(arguments=json.loads(passed_to), guess_target=True)
                for finding in run(group, options).findings:
                    file = finding.message.split("`")[1].rpartition("/")[2] if finding.code == "G601" else ""
                    if file not in upstream:
                        yield repository.name, finding


def sentence(finding: Finding) -> str:
    """Return the message without names and numbers."""
    return re.sub(r"`[^`]*`|-?[\d.]+(?:e-?\d+)?", "…", finding.message)


def drawn(found: list[Found], count: int, seed: int) -> list[Found]:
    """Draw findings at random, in turn one of each rule."""
    chance = random.Random(seed)
    by_code: dict[str, list[Found]] = {}
    for each in found:
        by_code.setdefault(each[1].code, []).append(each)
    for group in by_code.values():
        chance.shuffle(group)
    turns = sorted((turn, code) for code, group in by_code.items() for turn in range(len(group)))
    return [by_code[code][turn] for turn, code in turns[:count]]


def row(each: Found) -> tuple[str, ...]:
    """Return severity, code, file with its repository, line and message."""
    repository, finding = each
    message = finding.message.replace(str(CORPUS), "CORPUS")
    return finding.severity, finding.code, f"{repository}/{finding.file}", str(finding.line), message


def verdicts(path: Path) -> dict[tuple[str, ...], str]:
    """Return finding → verdict: ``right`` or ``wrong``."""
    rows = [line.split("\t") for line in path.read_text("utf-8").splitlines()[1:]]
    return {tuple(cells[:5]): cells[5] for cells in rows}


def main() -> None:
    """Print the counts, a sample, or a comparison with verdicts."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draw", type=int, metavar="N", help="print N findings drawn at random, as TSV")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verdicts", type=Path, metavar="FILE", help="compare with the verdicts in this file")
    arguments = parser.parse_args()
    found = list(findings())
    if arguments.draw:
        robots = [each for each in found if each[0] not in TEST_DATA]
        for each in drawn(robots, arguments.draw, arguments.seed):
            print("\t".join(row(each)))
        return
    groups = Counter[str]()
    for repository in sorted({name for name, _ in found}):
        own = [finding for name, finding in found if name == repository]
        severities = Counter(finding.severity for finding in own)
        serious = {(finding.code, sentence(finding)) for finding in own if finding.severity != "note"}
        groups[repository] = len(serious)
        print(
            f"{repository:50} {severities['error']:5} {severities['warning']:5} {severities['note']:5} {len(serious):4}"
        )
    robots = [count for repository, count in groups.items() if repository not in TEST_DATA]
    print(f"median of errors and warnings per repository that works, grouped: {median(robots)}")
    for (severity, code), count in sorted(Counter((each.severity, each.code) for _, each in found).items()):
        print(f"  {severity:8} {code} {count}")
    if arguments.verdicts:
        verdict_of = verdicts(arguments.verdicts)
        rows = {row(each) for each in found}
        judged = [verdict_of[each] for each in rows if each in verdict_of]
        print(f"{judged.count('right')} of {len(judged)} judged findings that are still reported are right")
        print(f"{len(verdict_of) - len(judged)} judged findings are no longer reported")


if __name__ == "__main__":
    main()
