"""Tables of a template other than questions: layers, words, facts, checks and next steps."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from urdfkit.scaffold.templates.questions import When


@dataclass(frozen=True, slots=True)
class Layer:
    """A folder of files that is copied `into` folders of the output if the answers match `when`.

    A folder name may contain ``@question@``; a question with several answers gives one folder for each.
    With `append`, files are appended to the files of the same name from earlier layers.
    With `spare`, files and folders that exist at the top of the output are skipped instead of reported as an error.
    `line` is the line of the layer in ``template.toml``.
    """

    folder: str
    into: tuple[str, ...]
    when: When
    append: bool = False
    spare: bool = False
    line: int = 1


@dataclass(frozen=True, slots=True)
class Word:
    """A placeholder without a question: `values` gives its text for each answer to the question or fact `by`.

    If the question `by` has several answers, the word has one value for each answer that is in `values`. If a value
    is a list, lines with the placeholder are repeated for each text of the list. A value that begins with ``=`` is
    computed from the answers and rounded to four digits.
    """

    name: str
    by: str
    values: Mapping[str, str | Sequence[str]]


@dataclass(frozen=True, slots=True)
class Fact:
    """A named condition for layers and words: ``yes`` if the answers match one of `any`, otherwise ``no``."""

    name: str
    any: tuple[When, ...]


@dataclass(frozen=True, slots=True)
class Check:
    """A comparison that must hold if the answers match `when`, and the error message otherwise.

    Without a comparison, answers that match `when` are errors. The message names the options of the questions `named`.
    """

    holds: str
    otherwise: str
    when: When
    named: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Next:
    """Commands to run next, printed if the answers match `when`."""

    title: str
    commands: tuple[str, ...]
    when: When
