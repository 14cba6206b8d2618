"""The linter: report defects of URDF and xacro files at their source position, and fix many of them.

Data flow: `engine` expands each entry file with error recovery (`urdfkit.description.xacro.expand`) and runs the rules,
layer by layer: `SourceRule` on the text of each file, `FaultRule` on xacro errors, `RobotRule` on the expanded robot.
It drops suppressed findings and merges findings that several expansions of one macro have in common. `fixes` edits the
source text, `report` prints the findings.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.lint.engine.run import lint as lint
    from urdfkit.lint.finding import Finding as Finding
    from urdfkit.lint.rules import RULES as RULES

_MODULES = {"Finding": "finding", "RULES": "rules", "lint": "engine.run"}

__all__ = ["RULES", "Finding", "lint"]


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
