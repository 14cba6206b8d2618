"""Plots of a sweep: each metric over each parameter."""

import io
import math
import re
from pathlib import Path
from typing import Any

from urdfkit.app.sweeps.results import Sweep
from urdfkit.atomic import write_bytes


def write_plots(sweep: Sweep) -> tuple[Path, ...]:
    """Write a PNG file for each metric, with a panel for each parameter, or for the seed without parameters.

    A panel has a point for each run, and a line through the means over all other parameters and seeds, except for a
    parameter that each seed draws.

    Raises:
        ResourceError: a file cannot be written.
    """
    from matplotlib.figure import Figure

    files: list[Path] = []
    parameters = sweep.parameters or ("seed",)
    for metric in sweep.metrics:
        figure = Figure(figsize=(4.0 * len(parameters), 3.2), layout="constrained")
        panels = figure.subplots(1, len(parameters), squeeze=False, sharey=True)[0]
        for panel, name in zip(panels, parameters, strict=True):
            points = [(row[name], row[metric]) for row in sweep.rows if math.isfinite(row[metric])]
            _draw(panel, points, line=not sweep.is_drawn(name))
            panel.set_xlabel(name)
        panels[0].set_ylabel(metric)
        content = io.BytesIO()
        figure.savefig(content, format="png", dpi=150)
        file = sweep.folder / f"{_file_name(metric, files)}.png"
        write_bytes(file, content.getvalue())
        files.append(file)
    return tuple(files)


def _draw(panel: Any, points: list[tuple[Any, float]], *, line: bool) -> None:
    if any(isinstance(x, str) for x, _ in points):
        labels = list(dict.fromkeys(x for x, _ in points))
        panel.set_xticks(range(len(labels)), labels)
        points = [(labels.index(x), y) for x, y in points]
    panel.plot([x for x, _ in points], [y for _, y in points], ".", color="0.6", markersize=4)
    groups: dict[float, list[float]] = {}
    for x, y in points:
        groups.setdefault(x, []).append(y)
    if (len(groups) > 1 and all(len(group) > 1 for group in groups.values())) or len(groups) == len(points) < 50:
        ordered = sorted(groups)
        panel.plot(ordered, [math.fsum(groups[x]) / len(groups[x]) for x in ordered], "-", color="C0")
    panel.grid(visible=True, alpha=0.3)


def _file_name(metric: str, files: list[Path]) -> str:
    """Return a name of letters, digits and hyphens that no other file has."""
    name = re.sub(r"[^A-Za-z0-9_]+", "-", metric).strip("-") or "metric"
    taken = {file.stem for file in files}
    return name if name not in taken else f"{name}-{len(files)}"
