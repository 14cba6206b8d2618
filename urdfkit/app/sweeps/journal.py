"""Journal of a sweep: the outcome of each finished run, so that a sweep that was killed continues where it was."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from urdfkit.app.sweeps.scenario import RunOutcome
from urdfkit.atomic import write_text
from urdfkit.errors import UsageError

DEFINITION, RUNS = "sweep.json", "runs.jsonl"


class Journal:
    """Files in the folder of a sweep: its definition, and a line for each finished run.

    Args:
        folder: created if it does not exist.
        definition: JSON values that determine the results.
        restart: discard the runs of another or the same sweep in the folder.

    Raises:
        UsageError: the folder has another sweep.
        ResourceError: a file cannot be written.

    Attributes:
        outcomes: number of a finished run → its outcome.
    """

    def __init__(self, folder: Path, definition: Mapping[str, Any], *, restart: bool = False) -> None:
        self._file = folder / RUNS
        folder.mkdir(parents=True, exist_ok=True)
        wanted = json.loads(json.dumps(definition))
        place = folder / DEFINITION
        if restart or not place.exists():
            self._file.unlink(missing_ok=True)
            write_text(place, json.dumps(wanted, indent=1) + "\n")
        elif (stored := json.loads(place.read_text(encoding="utf-8"))) != wanted:
            names = [name for name in {**stored, **wanted} if stored.get(name) != wanted.get(name)]
            raise UsageError(
                f"{folder} has a sweep with other values of {', '.join(names)}; "
                "use --output for another folder, or --restart to discard that sweep"
            )
        self.outcomes = {outcome.number: outcome for outcome in self._read()}
        self._stream = self._file.open("a", encoding="utf-8")

    def __enter__(self) -> Journal:
        """Return itself."""
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        """Close the file."""
        self._stream.close()

    def add(self, outcome: RunOutcome) -> None:
        """Write an outcome to the disk."""
        self.outcomes[outcome.number] = outcome
        line = {"run": outcome.number, "metrics": dict(outcome.metrics), "error": outcome.error}
        self._stream.write(json.dumps(line) + "\n")
        self._stream.flush()
        os.fsync(self._stream.fileno())

    def _read(self) -> list[RunOutcome]:
        """Return the outcomes in the file; cut a last line that was not written to its end."""
        if not self._file.exists():
            return []
        content = self._file.read_bytes()
        whole = content[: content.rfind(b"\n") + 1]
        if whole != content:
            with self._file.open("r+b") as stream:
                stream.truncate(len(whole))
        lines = [json.loads(line) for line in whole.decode().splitlines()]
        return [RunOutcome(line["run"], line["metrics"], line["error"]) for line in lines]
