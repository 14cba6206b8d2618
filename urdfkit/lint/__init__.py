"""The linter: find, and partly mend, the defects of a URDF or xacro at the place a person wrote them.

From start to finish: `engine` expands each entry file with recovery (`urdfkit.description.xacro.expand`) and asks the
rules, layer by layer: `SourceRule` on the text of each file, `FaultRule` on what xacro could not expand, `RobotRule` on
the robot that came out. It drops what a comment suppresses and makes one finding of what several expansions of a macro
have in common; `fixes` edits the source text, and `report` prints.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.lint.engine.run import lint as lint
    from urdfkit.lint.finding import Finding as Finding
    from urdfkit.lint.rules import RULES as RULES

_HOME = {"Finding": "finding", "RULES": "rules", "lint": "engine.run"}

__all__ = ["RULES", "Finding", "lint"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
