"""Joint positions on the command line: words ``name=value``."""

import sys
from collections.abc import Iterable, Mapping

from urdfkit.description import Robot
from urdfkit.errors import UsageError


def joint_positions(words: Iterable[str], option: str) -> dict[str, float]:
    """Parse ``name=value`` words; one word may hold several, separated by commas.

    Args:
        words: the words.
        option: the command and its option, for messages: ``tf: --joint``.

    Raises:
        UsageError: a word has another form, a name occurs twice, or a value is not a finite number.
    """
    values: dict[str, float] = {}
    for word in (part for words_of_one in words for part in words_of_one.split(",") if part):
        name, separator, text = word.partition("=")
        if not separator or not name:
            raise UsageError(f"{option} expects name=value, got `{word}`")
        if name in values:
            raise UsageError(f"{option} {name} occurs twice")
        try:
            values[name] = float(text)
        except ValueError:
            raise UsageError(f"{option} {name}: `{text}` is not a number [rad or m]") from None
        if values[name] - values[name] != 0.0:  # NaN or infinite
            raise UsageError(f"{option} {name}: {text} is not a finite number")
    return values


def warn_of_limits(robot: Robot, positions: Mapping[str, float]) -> None:
    """Warn of positions outside the limits, of mimic joints of these joints included; the positions are used anyway."""
    from urdfkit.kinematics.joint_limits import limit_errors

    for error in limit_errors(robot, positions):
        print(f"urdfkit: warning: {error}", file=sys.stderr)
