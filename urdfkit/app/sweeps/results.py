"""Results of a sweep: a table of all runs, as CSV and Parquet, and a summary with a row for each combination."""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean
from typing import Any

from urdfkit.app.sweeps.scenario import RunOutcome
from urdfkit.app.sweeps.variations import SweepRun, Value
from urdfkit.atomic import write_bytes, write_text

CSV, PARQUET = "results.csv", "results.parquet"
LONGEST = 40
"""Largest number of rows in the summary."""


@dataclass(frozen=True)
class Sweep:
    """Results of a sweep.

    Attributes:
        parameters: names of the parameters that vary.
        metrics: names of the metrics.
        rows: a dictionary for each run: ``run``, ``seed``, the parameters, the metrics, and ``error``, which is empty
            unless the simulation failed; the metrics then are not a number.
        folder: folder with the files of the sweep.
    """

    parameters: tuple[str, ...]
    metrics: tuple[str, ...]
    rows: tuple[Mapping[str, Any], ...]
    folder: Path

    def __repr__(self) -> str:
        """Return the numbers of runs and failures, and the folder."""
        return f"<Sweep of {len(self.rows)} runs, {len(self.failed)} failed, in {self.folder}>"

    @property
    def columns(self) -> dict[str, list[Any]]:
        """Name → values of all runs, such as for ``pandas.DataFrame``."""
        return {name: [row[name] for row in self.rows] for name in self.names}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        return ("run", "seed", *self.parameters, *self.metrics, "error")

    @property
    def failed(self) -> tuple[Mapping[str, Any], ...]:
        """Rows of the runs whose simulation failed."""
        return tuple(row for row in self.rows if row["error"])

    def write(self) -> None:
        """Write the table as CSV and Parquet.

        Raises:
            ResourceError: a file cannot be written.
        """
        import pyarrow
        from pyarrow import parquet

        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.names)
        writer.writerows([row[name] for name in self.names] for row in self.rows)
        write_text(self.folder / CSV, text.getvalue())
        content = io.BytesIO()
        parquet.write_table(pyarrow.table(self.columns), content)
        write_bytes(self.folder / PARQUET, content.getvalue())

    def summary(self) -> str:
        """Return a table as text: mean of each metric, and its range if it differs between the seeds."""
        groups: dict[tuple[Value, ...], list[Mapping[str, Any]]] = {}
        fixed = [name for name in self.parameters if not self.is_drawn(name)]
        for row in self.rows:
            groups.setdefault(tuple(row[name] for name in fixed), []).append(row)
        table = [[*fixed, *self.metrics]]
        for values, rows in list(groups.items())[:LONGEST]:
            cells = [_shown(value) for value in values]
            table.append(cells + [_statistics([row[name] for row in rows]) for name in self.metrics])
        widths = [max(len(row[k]) for row in table) for k in range(len(table[0]))]
        lines = ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)) for row in table]
        if len(groups) > LONGEST:
            lines.append(f"and {len(groups) - LONGEST} more combinations, see {self.folder / CSV}")
        return "\n".join(lines)

    def is_drawn(self, name: str) -> bool:
        """Whether a parameter has another value for each seed."""
        by_seed: dict[int, Value] = {}
        if len({row[name] for row in self.rows}) == 1:
            return False
        return len({row["seed"] for row in self.rows}) > 1 and all(
            by_seed.setdefault(row["seed"], row[name]) == row[name] for row in self.rows
        )


def tabulate(
    runs: Sequence[SweepRun], outcomes: Mapping[int, RunOutcome], metrics: Mapping[str, str], folder: Path
) -> Sweep:
    """Return the results of finished runs, in the order of the runs."""
    rows: list[dict[str, Any]] = []
    for run in runs:
        outcome = outcomes[run.number]
        values = {"run": run.number, "seed": run.seed, **run.values}
        rows.append({**values, **{name: outcome.metrics[name] for name in metrics}, "error": outcome.error})
    return Sweep(tuple(runs[0].values), tuple(metrics), tuple(rows), folder)


def _shown(value: Value) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _statistics(values: Sequence[float]) -> str:
    finite = [value for value in values if math.isfinite(value)]
    if not finite:
        return "failed"
    least, most = min(finite), max(finite)
    text = f"{fmean(finite):.4g}" if least == most else f"{fmean(finite):.4g} ({least:.4g} to {most:.4g})"
    return text if len(finite) == len(values) else f"{text}, {len(values) - len(finite)} failed"
