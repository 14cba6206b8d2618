"""Paths and trajectories of joints as CSV files: a header with joint names, then one configuration per line."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from urdfkit.errors import ResourceError
from urdfkit.linear_algebra import Array
from urdfkit.missing_files import missing_path

TIME = "time"
"""Column with the time [s]; a file without it is a path."""
DERIVATIVES = ("velocity", "acceleration")
"""Columns ``<joint>.velocity`` and ``<joint>.acceleration`` are written with trajectories and skipped when read."""


@dataclass(frozen=True)
class JointPath:
    """Configurations of some joints.

    Attributes:
        joints: names of the joints.
        positions: [rad] or [m]; shape (N, n).
        time: [s], increasing; shape (N,). None for a path without times.
    """

    joints: tuple[str, ...]
    positions: Array
    time: Array | None = None


def read_path(file: Path) -> JointPath:
    """Return the configurations in a CSV file.

    Raises:
        ResourceError: the file cannot be read, has no header with names, or a value is not a finite number; times do
            not increase.
    """
    try:
        text = file.read_text("utf-8-sig")
    except FileNotFoundError:
        raise ResourceError(missing_path(file)) from None
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise ResourceError(f"{file}: cannot be read: {reason}") from None
    rows = [(line, row) for line, row in enumerate(csv.reader(text.splitlines()), 1) if any(map(str.strip, row))]
    if not rows:
        raise ResourceError(f"{file}: the file is empty; the first line must contain the names of the joints")
    header = [word.strip() for word in rows[0][1]]
    _check_header(file, header)
    used = [i for i, name in enumerate(header) if not _is_derivative(name)]
    table = np.empty((len(rows) - 1, len(used)))
    for k, (line, row) in enumerate(rows[1:]):
        if len(row) != len(header):
            raise ResourceError(f"{file}:{line}: {len(row)} values, but the header has {len(header)} names")
        for column, i in enumerate(used):
            table[k, column] = _number(file, line, header[i], row[i])
    names = [header[i] for i in used]
    if TIME not in names:
        return JointPath(tuple(names), table)
    at = names.index(TIME)
    time = table[:, at]
    backwards = np.flatnonzero(np.diff(time) <= 0.0)
    if len(backwards):
        k = int(backwards[0]) + 1
        raise ResourceError(
            f"{file}:{rows[k + 1][0]}: time {time[k]:g} s does not increase; the line before has {time[k - 1]:g} s"
        )
    return JointPath(tuple(name for name in names if name != TIME), np.delete(table, at, axis=1), time)


def _check_header(file: Path, header: list[str]) -> None:
    for name in header:
        try:
            float(name)
        except ValueError:
            continue
        raise ResourceError(f"{file}:1: `{name}` is a number; the first line must contain the names of the joints")
    if "" in header:
        raise ResourceError(f"{file}:1: column {header.index('') + 1} has no name")
    repeated = next((name for name in header if header.count(name) > 1), None)
    if repeated is not None:
        raise ResourceError(f"{file}:1: column `{repeated}` occurs twice")
    if all(name == TIME or _is_derivative(name) for name in header):
        raise ResourceError(f"{file}:1: no column has the name of a joint")


def _is_derivative(name: str) -> bool:
    return name.rpartition(".")[2] in DERIVATIVES


def _number(file: Path, line: int, name: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise ResourceError(f"{file}:{line}: `{text.strip()}` of `{name}` is not a finite number")
    return value
