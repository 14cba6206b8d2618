"""What a run found."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any


@dataclass
class Found:
    """What a run found.

    Attributes:
        robot: its name.
        simulated: how long it went [s].
        factor: simulated seconds per CPU second.
        travelled: what the root link covered [m].
        deepest: deepest contact at a look [m].
        fastest: fastest body at a look [m/s].
        touched: seconds at whose end the robot touched something else than the ground.
        returned: how often it was put back because it lay on its side or had left.
        growth: memory since the second minute [B]; None for a shorter run.
        digest: of every second's state of the first minute.
        wrong: what did not hold → how often.
        first: what did not hold → the first time, in words.
    """

    robot: str
    simulated: float = 0.0
    factor: float = 0.0
    travelled: float = 0.0
    deepest: float = 0.0
    fastest: float = 0.0
    touched: int = 0
    returned: int = 0
    growth: int | None = None
    digest: str = ""
    wrong: dict[str, int] = field(default_factory=dict)
    first: dict[str, str] = field(default_factory=dict)

    def fault(self, kind: str, t: float, text: str) -> None:
        """Take down that something did not hold."""
        self.wrong[kind] = self.wrong.get(kind, 0) + 1
        self.first.setdefault(kind, f"t = {t:.2f} s: {text}")


def line(result: dict[str, Any]) -> str:
    """Return a result for people."""
    if "simulated" not in result:
        return f"{result['robot']}: crashed"
    growth = "" if result["growth"] is None else f", memory {result['growth'] / 2**20:+.1f} MiB"
    text = (
        f"{result['robot']}: {result['simulated'] / 60:.1f} min, {result['factor']:.1f} x real time, "
        f"{result['travelled']:.0f} m, touched {result['touched']} s, deepest {1000 * result['deepest']:.2f} mm, "
        f"fastest body {result['fastest']:.1f} m/s, put back {result['returned']}{growth}"
    )
    for kind, count in result["wrong"].items():
        text += f"\n    {kind}: {count} times, first at {result['first'][kind]}"
    return text
