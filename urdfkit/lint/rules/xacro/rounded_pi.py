"""X112 redundant-pi-definition."""

from __future__ import annotations

import re
from math import pi

from urdfkit.description.numbers import number
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import SourceRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.syntax import Document, Tag

_ANGLES = r"rpy(?<=\srpy)\s*=\s*(?:\"([^\"<]*)\"|'([^'<]*)')"
_DEFINITION = (
    r"<(?:xacro:)?property\b[^<>]*?\bname\s*=\s*[\"'](PI|Pi|M_PI|pi)[\"'][^<>]*?\bvalue\s*=\s*[\"']\s*([0-9.]+)\s*[\"']"
)


class RoundedPi(SourceRule):
    """π is written with few digits.

    ## What it does
    Looks in ``rpy`` for 3.14, 1.57, 0.785 and their like, and for properties that define π.

    ## Why is this bad?
    1.57 is 0.8 mrad short of a right angle: a metre farther on that is nearly a millimetre. xacro has ``pi``.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="PI" value="3.1415926535897931"/>
      <link name="base">
        <visual>
          <origin rpy="${PI/2} 0 1.57"/>
          <geometry><cylinder radius="0.1" length="0.2"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual>
          <origin rpy="${pi/2} 0 ${pi/2}"/>
          <geometry><cylinder radius="0.1" length="0.2"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Safe: the part turns by less than a thousandth. Definitions are left, as they are used elsewhere.
    """

    code = "X112"
    name = "redundant-pi-definition"
    severity = "info"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield a finding for each rounded angle, and for each property that is π."""
        text = document.source.text
        for at in re.finditer(_ANGLES, text):
            value = at[1] or at[2] or ""
            words = re.findall(r"\$\{[^{}]*\}|\$\([^()]*\)|[^\s]+", value)
            exact = [_exact(word, ".xacro" in document.source.file) for word in words]
            first = next((word for word, better in zip(words, exact, strict=True) if better), None)
            if first is None:
                continue
            tag = _tag_at(document, at.start())
            if tag is None or "rpy" not in tag.attributes:
                continue
            written = tag.attributes["rpy"]
            right = " ".join(better or word for word, better in zip(words, exact, strict=True))
            span = document.source.span(written.value_start, written.value_end)
            yield self.at(
                model,
                document.source.position(tag.start),
                f"{first} is a multiple of π with few digits",
                attribute="rpy",
                help=f'write rpy="{right}"',
                fix=Fix("safe", "Write all digits", (Edit(span, right),)),
            )
        if ":property" not in text and "<property" not in text:
            return
        for at in re.finditer(_DEFINITION, text):
            value_of = number(at[2])
            if value_of is not None and abs(value_of - pi) < 2e-3:
                yield self.at(
                    model,
                    document.source.position(at.start()),
                    f"`{at[1]}` defines π, which xacro has as `pi`",
                    help="write ${pi} where it is used",
                )


def _exact(word: str, is_xacro: bool) -> str | None:
    """Return a better way to write an angle; None where it is as good as exact, or no part of π."""
    value = number(word)
    if value is None or not 0.5 <= abs(value) < 100.0:
        return None
    for divisor in (1, 2, 4):
        turns = round(value * divisor / pi)
        off = abs(value - turns * pi / divisor)
        if turns and 1e-6 < off < 2e-3 and len(word.lstrip("+-")) >= 4:
            if not is_xacro:
                return f"{turns * pi / divisor:.10g}"
            sign, count = "-" if turns < 0 else "", abs(turns)
            return f"${{{sign}{f'{count}*' if count > 1 else ''}pi{f'/{divisor}' if divisor > 1 else ''}}}"
    return None


def _tag_at(document: Document, offset: int) -> Tag | None:
    start = document.source.text.rfind("<", 0, offset)
    position = document.source.position(start)
    return document.tag_at(position.line, position.column)
