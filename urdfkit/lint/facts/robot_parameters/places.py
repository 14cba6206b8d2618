"""Lists of coordinates in the parameters of nodes that do not fit the list of names in the same section."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator
from math import inf

from urdfkit.description.urdf.robot import Vector
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, number_of
from urdfkit.lint.facts.robot_parameters.groups import groups_of_nodes, tokens
from urdfkit.lint.model.model import Model

_COORDINATE = r"(?:^|_)([xy])(?:_|$)"
_NAMES = r"(?:names|joints|wheels|modules|legs|corners|links|frames|prefixes)$"
_EXACT = 0.005
"""Accepted deviation of a coordinate [m]."""


_MOST_WORDS = 10


def wrong_places(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the coordinates that belong to another name of the list, or to none while most others fit."""
    places: dict[tuple[str, ...], list[Vector]] = {}
    for source, group in groups_of_nodes(model):
        lists = [(key, value) for key, value in group.entries if re.search(_NAMES, key.text) and len(value.items) > 1]
        for key, value in group.entries if lists else ():
            axis = re.search(_COORDINATE, key.text)
            fitting = [(_first(name.text), names) for name, names in lists if len(names.items) == len(value.items)]
            fitting = [each for each in fitting if each[0] == _first(key.text)] or fitting
            if axis is None or len(fitting) != 1:
                continue
            names, places = fitting[0][1].texts(), places or _places(model)
            wrong = _wrong_coordinate(places, "xy".index(axis[1]), names, value.items)
            if wrong is not None:
                yield source, value.items[wrong[0]], f"`{key.text}` is {wrong[1]}"


def _wrong_coordinate(
    all_places: dict[tuple[str, ...], list[Vector]], axis: int, names: list[str], values: tuple[Node, ...]
) -> tuple[int, str] | None:
    """Return the index of the first coordinate that does not fit its name, and the message; None if all fit."""
    numbers = [number for value in values if (number := number_of(value)) is not None]
    places = [[place[axis] for place in all_places.get(tokens(name), ())] for name in names]
    if len(numbers) != len(values) or len(names) != len(values) or not all(places):
        return None
    fits = [_is_in(number, place) for number, place in zip(numbers, places, strict=True)]
    is_other_order = _are_in(numbers, [each for place in places for each in place])
    if all(fits) or not (is_other_order or 2 * sum(fits) > len(fits)):
        return None
    at = fits.index(False)
    actual = min(places[at], key=lambda place: abs(place - numbers[at]))
    return at, f"{numbers[at]:g} m for `{names[at]}`, which is at {'xy'[axis]} = {actual:.4g} m"


def _first(key: str) -> str:
    """Return the first word of a key in the singular."""
    return key.partition("_")[0].removesuffix("s")


def _are_in(numbers: list[float], places: list[float]) -> bool:
    """Return whether there is a place near each number."""
    ordered = [-inf, *sorted(places), inf]
    return all(
        min(number - ordered[at - 1], ordered[at] - number) <= _EXACT
        for number in numbers
        for at in (bisect_left(ordered, number),)
    )


def _is_in(number: float, places: list[float]) -> bool:
    return any(abs(number - place) <= _EXACT for place in places)


def _places(model: Model) -> dict[tuple[str, ...], list[Vector]]:
    """Return the places of links by each sequence of words in the name of the link or of its joint [m]."""
    joints = {joint.child: joint.name for joint in model.robot.joints}
    places: dict[tuple[str, ...], list[Vector]] = {}
    for link, frame in model.frames.items():
        names = [tokens(name)[:_MOST_WORDS] for name in (link, joints.get(link)) if name]
        runs = {name[at:end] for name in names for at in range(len(name)) for end in range(at + 1, 1 + len(name))}
        for run in runs:
            places.setdefault(run, []).append(frame.translation)
    return places
