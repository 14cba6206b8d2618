"""Markup: write SDF line by line, with numbers that survive a round trip."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from urdfkit.description.sdf.shapes import Kept, escaped
from urdfkit.description.urdf.robot import Pose
from urdfkit.description.xml.element import Element
from urdfkit.errors import DescriptionError

_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def figure(value: float) -> str:
    """Return the shortest text of a number that parses to the same value."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


class Markup:
    """Lines of XML, indented by two spaces."""

    def __init__(self) -> None:
        self._lines = ['<?xml version="1.0"?>']
        self._depth = 0

    def text(self) -> str:
        """Return the document.

        Raises:
            DescriptionError: the document has a character that XML does not allow.
        """
        whole = "\n".join(self._lines) + "\n"
        if (found := _ILLEGAL.search(whole)) is not None:
            raise DescriptionError(f"the character {found[0]!r} cannot be written in XML")
        return whole

    @contextmanager
    def inside(self, tag: str, **attributes: str) -> Iterator[None]:
        """Write an element around the content of the ``with`` block; empty attributes are omitted."""
        words = [tag, *(f'{name}="{escaped(value, quoted=True)}"' for name, value in attributes.items() if value)]
        self._line(f"<{' '.join(words)}>")
        start = len(self._lines)
        self._depth += 1
        yield
        self._depth -= 1
        if len(self._lines) == start:
            self._lines[-1] = self._lines[-1][:-1] + "/>"
        else:
            self._line(f"</{tag}>")

    @contextmanager
    def some(self, tag: str) -> Iterator[None]:
        """Write an element around the content of the ``with`` block, unless it is empty."""
        start = len(self._lines)
        with self.inside(tag):
            yield
        if len(self._lines) == start + 1:
            self._lines.pop()

    def put(self, tag: str, text: str) -> None:
        """Write an element with text."""
        self._line(f"<{tag}>{escaped(text)}</{tag}>")

    def numbers(self, tag: str, values: Sequence[float], default: Sequence[float] | None = None) -> None:
        """Write numbers, unless they are the default."""
        if default is None or tuple(values) != tuple(default):
            self.put(tag, " ".join(map(figure, values)))

    def number(self, tag: str, value: float, default: float | None = None) -> None:
        """Write a number, unless it is the default."""
        self.numbers(tag, (value,), None if default is None else (default,))

    def truth(self, tag: str, value: bool, default: bool | None = None) -> None:
        """Write true or false, unless it is the default."""
        if value != default:
            self.put(tag, "true" if value else "false")

    def pose(self, pose: Pose) -> None:
        """Write a pose, unless it is the identity."""
        self.numbers("pose", (*pose.xyz, *pose.rpy), (0.0,) * 6)

    def keep(self, kept: Sequence[Kept]) -> None:
        """Write preserved elements unchanged."""
        for each in kept:
            self._element(each.element)

    def _element(self, element: Element) -> None:
        words = [element.tag]
        words += [f'{name}="{escaped(value, quoted=True)}"' for name, value in element.attributes.items()]
        text = escaped(element.text)
        if not element.children:
            self._line(f"<{' '.join(words)}>{text}</{element.tag}>" if text else f"<{' '.join(words)}/>")
            return
        self._line(f"<{' '.join(words)}>{text}")
        self._depth += 1
        for child in element.children:
            self._element(child)
        self._depth -= 1
        self._line(f"</{element.tag}>")

    def _line(self, text: str) -> None:
        self._lines.append("  " * self._depth + text)
