"""A baseline: the findings that are known and not to be reported again, in a file that is kept with the sources.

A finding is known by file, code and message, not by its line: what is added above it does not make it new.
"""

from __future__ import annotations

from collections import Counter

from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from urdfkit.lint.finding import Finding

    Key = tuple[str, str, str]

_FORM = 1


def read(path: Path) -> Counter[Key]:
    """Return how often each finding is known.

    Raises:
        ResourceError: the file cannot be read, or is no baseline.
    """
    import json

    try:
        written = json.loads(path.read_text("utf-8"))
        if written["baseline"] != _FORM:
            raise ResourceError(
                f"{path} is a baseline of a later urdfkit (form {written['baseline']}, known is {_FORM})"
            )
        rows = [(str(row["file"]), str(row["code"]), str(row["message"])) for row in written["findings"]]
        counts = [int(row.get("count", 1)) for row in written["findings"]]
    except OSError as error:
        raise ResourceError(f"cannot read the baseline {path}: {error.strerror}; --write-baseline makes one") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ResourceError(f"{path} is no baseline; --write-baseline makes one") from error
    known: Counter[Key] = Counter()
    for row, count in zip(rows, counts, strict=True):
        known[row] += count
    return known


def write(path: Path, findings: Iterable[Finding]) -> int:
    """Write the findings as known, notes left out, and return how many there are.

    Raises:
        ResourceError: it cannot be written.
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
        f'{{"baseline": {_FORM}, "findings": [\n{lines}\n]}}\n'
        if rows
        else f'{{"baseline": {_FORM}, "findings": []}}\n',
    )
    return sum(counts.values())


def unknown(findings: Iterable[Finding], known: Counter[Key]) -> tuple[list[Finding], int, int]:
    """Return the findings that are not known, how many were, and how many known ones are there no more."""
    left = known.copy()
    new: list[Finding] = []
    for finding in findings:
        key = _key(finding)
        if left[key] > 0:
            left[key] -= 1
        else:
            new.append(finding)
    gone = sum(count for count in left.values() if count > 0)
    return new, known.total() - gone, gone


def _key(finding: Finding) -> Key:
    return finding.file, finding.code, finding.message
