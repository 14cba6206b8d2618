"""The tables of a template besides its questions: what is written, with which words, and what has to hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from urdfkit.scaffold.templates.questions import When


@dataclass(frozen=True, slots=True)
class Layer:
    """A folder of files that goes `into` some folders of the result, if the answers are among `when`.

    With ``@question@`` in the folder's name it is the folder of that answer, of several answers each one's.
    With `append`, what a file holds goes behind what the layers before have written into the file of that name.
    What is `spare` is left out where something of that name is there already, instead of refusing all.
    In ``template.toml`` it says where in that `line`.
    """

    folder: str
    into: tuple[str, ...]
    when: When
    append: bool = False
    spare: bool = False
    line: int = 1


@dataclass(frozen=True, slots=True)
class Word:
    """A placeholder that nobody is asked for: what it says follows `by` the answer to a question, or a fact.

    By a question that takes several answers it is several words, one for each answer that has one. Where it says a
    list, a line with it comes once for each text of the list: not at all for an empty one. What begins with ``=`` is
    computed from the answers, to four digits.
    """

    name: str
    by: str
    says: Mapping[str, str | Sequence[str]]


@dataclass(frozen=True, slots=True)
class Fact:
    """What follows from answers: ``yes`` if they are among `any` of some, ``no`` otherwise. For layers and words."""

    name: str
    any: tuple[When, ...]


@dataclass(frozen=True, slots=True)
class Check:
    """A comparison that has to hold between the answers if they are among `when`, and what is wrong otherwise.

    Without a comparison these answers do not go together at all.
    """

    holds: str
    otherwise: str
    when: When


@dataclass(frozen=True, slots=True)
class Next:
    """Commands to go on with, if the answers are among `when`."""

    title: str
    commands: tuple[str, ...]
    when: When
