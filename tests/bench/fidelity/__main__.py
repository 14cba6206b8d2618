"""Make the table of docs/fidelity.md: closed forms, ours, MuJoCo, PyBullet and Drake.

    python tests/bench/fidelity [--write] [--only WORD]

Prints the table; with ``--write`` puts it into docs/fidelity.md, between its two marks. Each peer is run at each of its
settings, and the best of them counts.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from types import ModuleType

sys.path.insert(0, str(Path(__file__).parents[1]))

from fidelity import ours, peer_bullet, peer_drake, peer_mujoco
from fidelity.row import Row, UnsupportedError
from fidelity.rows import SECTIONS
from fidelity.scene import Run
from fidelity.table import PAGE, Result, put_table, table

PEERS = {"MuJoCo": peer_mujoco, "PyBullet": peer_bullet, "Drake": peer_drake}
"""Name → engine that is compared."""


def measured(row: Row, run: Run) -> float:
    """Return the error of an engine; infinite where it breaks down."""
    try:
        error = row.error(run)
    except UnsupportedError:
        return math.nan
    except Exception as failure:
        print(f"{row.name}: {failure}", file=sys.stderr)
        return math.inf
    return error if math.isfinite(error) else math.inf


def errors(row: Row, peer: ModuleType) -> dict[str, float]:
    """Return setting → error of a peer, without the settings that do not have what the row needs."""
    found = {name: measured(row, peer.runner(0.001, name)) for name in peer.SETTINGS}
    return {name: error for name, error in found.items() if not math.isnan(error)}


def result(row: Row) -> Result:
    """Run a row on every engine."""
    print(row.name, file=sys.stderr, flush=True)
    peers = {name: errors(row, peer) for name, peer in PEERS.items() if name != "PyBullet" or row.bullet}
    return Result(row, measured(row, ours.runner(0.001)), measured(row, ours.runner(0.005)), peers)


def main() -> int:
    """Measure, print and perhaps write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--write", action="store_true", help="put the table into docs/fidelity.md")
    parser.add_argument("--only", default="", metavar="WORD", help="rows whose name has it")
    options = parser.parse_args()
    if options.write and options.only:
        parser.error("--write wants all rows")
    chosen = [(title, [row for row in rows if options.only in row.name]) for title, rows in SECTIONS]
    text = table([(title, [result(row) for row in rows]) for title, rows in chosen if rows])
    print(text)
    if options.write:
        put_table(text)
        print(f"wrote {PAGE}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
