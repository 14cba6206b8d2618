"""Formats: ``str.format`` and f-strings over plain values, without access to attributes or items."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from string import Formatter

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.value_size import check_widths, steps_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


class Formats(Formatter):
    """Formats values as ``str.format`` does; a field names a position or an argument, never an attribute or an item.

    Args:
        budget: counts the steps.
    """

    def __init__(self, budget: Budget) -> None:
        self._budget = budget

    def get_field(self, field_name: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """Return the value of a field.

        Raises:
            ValueError: the field names an attribute or item.
        """
        if "." in field_name or "[" in field_name:
            raise ValueError(f"the format field `{{{field_name}}}` reads an attribute or item, which is not supported")
        return super().get_field(field_name, args, kwargs)

    def convert_field(self, value: Any, conversion: Any) -> Any:
        """Return a value, or its text if there is a conversion.

        Raises:
            TooLarge: the text would be too long.
        """
        self._budget.check_text(steps_of(value))
        return super().convert_field(value, conversion)

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return the text of a value.

        Raises:
            TooLarge: it is too long.
        """
        check_widths(format_spec)
        return str(self._budget.checked(format(value, format_spec)))
