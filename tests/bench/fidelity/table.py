"""The table of docs/fidelity.md, as text."""

from __future__ import annotations

import datetime
import math
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fidelity.row import Row

PAGE = Path(__file__).parents[3] / "docs" / "fidelity.md"
PEERS = ("MuJoCo", "PyBullet", "Drake")
"""Names of the engines that are compared, in the order of the columns."""
BEGIN, END = "<!-- table: made by `make fidelity` -->", "<!-- end of table -->"


@dataclass(frozen=True)
class Result:
    """The errors of a row: ours at 1 and at 5 ms, and of each peer by setting; empty if it does not support the row."""

    row: Row
    ours: float
    coarse: float
    peers: Mapping[str, Mapping[str, float]]

    @property
    def best_peer(self) -> tuple[str, float]:
        """Name and error of the best peer at its best."""
        peers = {name: min(errors.values()) for name, errors in self.peers.items() if errors}
        name = min(peers, key=lambda each: peers[each])
        return name, peers[name]

    @property
    def verdict(self) -> str:
        """How ours stands next to the best peer."""
        best = self.best_peer[1]
        if max(self.ours, best) <= self.row.negligible:
            return "equal"
        return "better" if self.ours <= best else "**worse**"


def number(value: float, unit: str) -> str:
    """Return an error for people: two digits; what is round-off as zero."""
    if math.isinf(value):
        return "breaks down"
    if value < 1e-12:
        return "< 1e-12" + (f" {unit}" if unit else "")
    if not unit and value >= 1e-4:
        return f"{100 * value:.2g} %"
    text = f"{value:.1e}" if value < 1e-3 or value >= 1e3 else f"{value:.2g}"
    return f"{text} {unit}".strip()


def _peer(errors: Mapping[str, float], unit: str) -> tuple[str, str]:
    """Return the error at the default, and the best with the name of its setting."""
    if not errors:
        return "–", "–"
    name = min(errors, key=lambda each: errors[each])
    best = number(errors[name], unit)
    default = number(errors["default"], unit) if "default" in errors else "–"
    return default, best if name == "default" else f"{best} ({name})"


def table(sections: Sequence[tuple[str, Sequence[Result]]]) -> str:
    """Return all rows in Markdown, with versions and date."""
    from importlib.metadata import version

    names = ("urdfkit", "mujoco", "pybullet", "drake", "numba")
    versions = ", ".join(f"{name} {version(name)}" for name in names)
    date = datetime.datetime.now(tz=datetime.timezone.utc).date().isoformat()
    lines = [f"Measured on {date} with {versions}, Python {platform.python_version()}.", ""]
    results = [result for _, part in sections for result in part]
    counts = {word: sum(result.verdict == word for result in results) for word in ("better", "equal", "**worse**")}
    lines.append(
        f"Compared with the best peer, urdfkit is better in {counts['better']} of {len(results)} rows, equal in "
        f"{counts['equal']} and worse in {counts['**worse**']}."
    )
    for title, part in sections:
        lines += ["", f"### {title}", ""]
        lines.append(
            "| quantity | closed form | urdfkit, 1 ms | urdfkit, 5 ms | MuJoCo, default | MuJoCo, best "
            "| PyBullet, default | PyBullet, best | Drake, default | Drake, best | best peer | urdfkit is |"
        )
        lines.append("|" + "---|" * 12)
        for result in part:
            row = result.row
            cells = (
                row.name.replace("|", "\\|"),
                row.form,
                number(result.ours, row.unit),
                number(result.coarse, row.unit),
                *(cell for name in PEERS for cell in _peer(result.peers.get(name, {}), row.unit)),
                result.best_peer[0],
                result.verdict,
            )
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def put_table(text: str) -> None:
    """Put the table between the marks of the page."""
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    PAGE.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")
