"""Baseline: a file next to the sources with accepted findings, which are not reported again.

File, code and message identify a finding, not its line: text inserted above a finding does not make it new.
"""

from __future__ import annotations

from collections import Counter

from urdfkit.errors import ResourceError
from urdfkit.missing_files import missing_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from urdfkit.lint.finding import Finding

    Key = tuple[str, str, str]

_FORMAT = 1


def read(path: Path) -> Counter[Key]:
    """Return how often the baseline contains each finding.

    Raises:
        ResourceError: the file cannot be read or is not a baseline.
    """
    import json

    try:
        written = json.loads(path.read_text("utf-8"))
        if written["baseline"] != _FORMAT:
            raise ResourceError(
                f"{path} was written by a later version of urdfkit "
                f"(format {written['baseline']}, this version supports {_FORMAT})"
            )
        rows = [(str(row["file"]), str(row["code"]), str(row["message"])) for row in written["findings"]]
        counts = [int(row.get("count", 1)) for row in written["findings"]]
    except FileNotFoundError as error:
        raise ResourceError(f"--baseline: {missing_path(path)}; create one with --write-baseline") from error
    except OSError as error:
        raise ResourceError(
            f"cannot read the baseline {path}: {error.strerror}; create one with --write-baseline"
        ) from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ResourceError(f"{path} is not a baseline file; create one with --write-baseline") from error
    baseline: Counter[Key] = Counter()
    for row, count in zip(rows, counts, strict=True):
        baseline[row] += count
    return baseline


def write(path: Path, findings: Iterable[Finding]) -> int:
    """Write the findings to a baseline file, without notes, and return their number.

    Raises:
        ResourceError: the file cannot be written.
    """
    import json

    from urdfkit.atomic import write_text

    counts = Counter(map(_key, (finding for finding in findings if finding.severity != "note")))
    rows = [
        {"file": file, "code": code, "message": message, **({"count": count} if count > 1 else {})}
        for (file, code, message), count in sorted(counts.items())
    ]
    lines = ",\n".join(f"  {json.dumps(row, ensure_ascii=False)}" for row in rows)
    write_text(
        path,
        f'{{"baseline": {_FORMAT}, "findings": [\n{lines}\n]}}\n'
        if rows
        else f'{{"baseline": {_FORMAT}, "findings": []}}\n',
    )
    return sum(counts.values())


def unknown(findings: Iterable[Finding], baseline: Counter[Key]) -> tuple[list[Finding], int, int]:
    """Return the findings that are not in the baseline, and the numbers of matched and of stale baseline entries."""
    left = baseline.copy()
    new: list[Finding] = []
    for finding in findings:
        key = _key(finding)
        if left[key] > 0:
            left[key] -= 1
        else:
            new.append(finding)
    gone = sum(count for count in left.values() if count > 0)
    return new, baseline.total() - gone, gone


def _key(finding: Finding) -> Key:
    return finding.file, finding.code, finding.message
