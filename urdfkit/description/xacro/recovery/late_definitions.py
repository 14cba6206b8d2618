"""Definitions that come after their first use, as earlier passes over a file found them."""

from typing import Any

from urdfkit.description.xacro.evaluation.macros import Macro
from urdfkit.description.xml.source import Position


class LateDefinitions:
    """What earlier passes found defined after its use.

    Attributes:
        properties: name → value and place of the definition.
        macros: name → macro.
    """

    def __init__(self) -> None:
        self.properties: dict[str, tuple[Any, Position | None]] = {}
        self.macros: dict[str, Macro] = {}
