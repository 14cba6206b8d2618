"""Parsers of the values of ``sim run``'s options."""

import argparse
import re
from collections.abc import Callable
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from urdfkit.app.simulation.runs.commands import TopicMessage
from urdfkit.app.simulation.save_options import TopicFile


def number(text: str) -> float:
    """Return a finite number.

    Raises:
        argparse.ArgumentTypeError: the text is not a finite number.
    """
    value = _any_number(text)
    if not isfinite(value):
        raise argparse.ArgumentTypeError(f"`{text}` is not a finite number")
    return value


def seed(text: str) -> int:
    """Return a whole number, zero or more."""
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f"`{text}` is not a seed; it must be a whole number, zero or more")
    return value


def duration(text: str) -> float:
    """Return a finite number of seconds, zero or more."""
    value = number(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"`{text}` is negative; it must be seconds, zero or more")
    return value


def positive(text: str) -> float:
    """Return a finite number greater than zero."""
    value = number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"`{text}` must be greater than zero")
    return value


def vector(names: str, *, finite: bool = True) -> Callable[[str], tuple[float, ...]]:
    """Return a parser of comma-separated numbers.

    Args:
        names: names of the numbers, comma-separated, e.g. ``VX,VY,WZ``.
        finite: reject NaN and infinity.
    """
    count = names.count(",") + 1

    def read(text: str) -> tuple[float, ...]:
        parts = text.split(",")
        if len(parts) != count:
            raise argparse.ArgumentTypeError(f"`{text}` has {_counted(len(parts))}, expected {count}: {names}")
        return tuple(number(part) if finite else _any_number(part) for part in parts)

    return read


def _any_number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        unit = "; write it without a unit, as in the help" if re.fullmatch(r"[-+.\d]+\s*[^\W\d]+", text) else ""
        raise argparse.ArgumentTypeError(f"`{text}` is not a number{unit}") from None


def _counted(count: int) -> str:
    return f"{count} value{'s' * (count != 1)}"


class PoseOption(NamedTuple):
    """``X,Y,Z,YAW`` or ``X,Y,Z,ROLL,PITCH,YAW``; `z` is None where it is empty."""

    x: float
    y: float
    z: float | None
    roll: float
    pitch: float
    yaw: float


def pose(text: str) -> PoseOption:
    """Return the pose of ``--spawn``.

    Raises:
        argparse.ArgumentTypeError: the number of values is wrong, or a value is not a number.
    """
    parts = text.split(",")
    if len(parts) not in (4, 6):
        raise argparse.ArgumentTypeError(
            f"`{text}` has {_counted(len(parts))}, expected X,Y,Z,YAW or X,Y,Z,ROLL,PITCH,YAW (Z may be empty)"
        )
    z = number(parts[2]) if parts[2].strip() else None
    angles = [number(part) for part in parts[3:]]
    roll, pitch, yaw = angles if len(angles) == 3 else (0.0, 0.0, angles[0])
    return PoseOption(number(parts[0]), number(parts[1]), z, roll, pitch, yaw)


def targets(text: str) -> dict[str, float]:
    """Return joint → value of ``name=value,…``."""
    values = {}
    for name, value in _assignments(text):
        values[name] = number(value)
    return values


def joint_starts(text: str) -> tuple[dict[str, float], dict[str, float]]:
    """Return joint → position and joint → velocity of ``name=position[:velocity],…``."""
    positions, velocities = {}, {}
    for name, value in _assignments(text):
        position, colon, velocity = value.partition(":")
        positions[name] = number(position)
        if colon:
            velocities[name] = number(velocity)
    return positions, velocities


def _assignments(text: str) -> list[tuple[str, str]]:
    values: dict[str, str] = {}
    for word in text.split(","):
        name, equals, value = word.partition("=")
        if not equals or not name.strip():
            raise argparse.ArgumentTypeError(f"`{word}` is not NAME=VALUE")
        if name.strip() in values:
            raise argparse.ArgumentTypeError(f"`{text}` names `{name.strip()}` twice")
        values[name.strip()] = value.strip()
    return list(values.items())


_AT = re.compile(r"^(.*)@([^@\s}\]]*)$", re.DOTALL)


def topic_message(text: str) -> TopicMessage:
    """Return the parts of ``--topic-pub``; without ``@T`` the time is 0.

    Raises:
        argparse.ArgumentTypeError: topic or type is missing, or the time is invalid.
    """
    t = 0.0
    if at := _AT.match(text):
        text, t = at[1], duration(at[2])
    parts = text.split(None, 2)
    if len(parts) < 2:
        raise argparse.ArgumentTypeError(f'`{text}` is incomplete; expected "TOPIC TYPE YAML@T"')
    return TopicMessage(parts[0], parts[1], parts[2] if len(parts) == 3 else "{}", t)


def topic_file(*suffixes: str) -> Callable[[str], TopicFile]:
    """Return a parser of ``TOPIC=FILE`` or ``FILE``.

    Args:
        suffixes: accepted suffixes of the file, such as ``.png``.
    """

    def read(text: str) -> TopicFile:
        topic, equals, file = text.partition("=")
        if not equals:
            topic, file = "", text
        if Path(file).suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(f"`{text}` is not TOPIC=FILE{' or '.join(suffixes)}")
        return TopicFile(topic.strip(), Path(file))

    return read
