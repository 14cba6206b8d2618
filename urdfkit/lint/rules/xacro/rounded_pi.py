"""X112 redundant-pi-definition."""

import re
from math import pi

from urdfkit.description.xml.numbers import number
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.rule import Findings, Model, SourceRule

_EXACT, _EXPORTED = 1e-6, 1e-5
"""Largest error of an angle that is not reported [rad]: in general, and in plain URDF with meshes, a CAD export."""

_ANGLES = r"rpy(?<=\srpy)\s*=\s*(?:\"([^\"<]*)\"|'([^'<]*)')"
_DEFINITION = (
    r"<(?:xacro:)?property\b[^<>]*?\bname\s*=\s*[\"'](PI|Pi|M_PI|pi)[\"'][^<>]*?\bvalue\s*=\s*[\"']\s*([0-9.]+)\s*[\"']"
)


class RoundedPi(SourceRule):
    """An angle or property is a rounded multiple of π.

    ## What it does
    Checks ``rpy`` for rounded multiples of π, such as 3.14, 1.57 and 0.785, and checks for properties that define π. In
    plain URDF files with meshes, angles with an error of up to 0.01 mrad are accepted, because such files usually come
    from CAD programs.

    ## Why is this bad?
    1.57 rad is 0.8 mrad less than a right angle, an error of nearly one millimetre at a distance of one metre. xacro
    provides ``pi``.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:property name="PI" value="3.1415926535897931"/>
       <link name="base">
         <visual>
    -      <origin rpy="${PI/2} 0 1.57"/>
    +      <origin rpy="${pi/2} 0 ${pi/2}"/>
           <geometry><cylinder radius="0.1" length="0.2"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the rotation changes by up to 2 mrad, and the written angle may have been measured. Definitions of π are not
    changed, because other files may use them.
    """

    code = "X112"
    name = "redundant-pi-definition"
    severity = "note"
    fix = "unsafe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each rounded angle, and for each property that defines π."""
        text = document.source.text
        is_xacro = ".xacro" in document.source.file
        tolerance = _EXPORTED if not is_xacro and "<mesh" in text else _EXACT
        for match in re.finditer(_ANGLES, text):
            value = match[1] or match[2] or ""
            words = re.findall(r"\$\{[^{}]*\}|\$\([^()]*\)|[^\s]+", value)
            exact_words = [_exact(word, is_xacro, tolerance) for word in words]
            first = next((word for word, exact in zip(words, exact_words, strict=True) if exact), None)
            if first is None:
                continue
            tag = _tag_at(document, match.start())
            if tag is None or "rpy" not in tag.attributes:
                continue
            attribute = tag.attributes["rpy"]
            corrected = " ".join(exact or word for word, exact in zip(words, exact_words, strict=True))
            span = document.source.span(attribute.value_start, attribute.value_end)
            message = f"angle {first} rad is a rounded multiple of π"
            help = f'write rpy="{corrected}"'
            fix = Fix("unsafe", "Write the exact angle", (Edit(span, corrected),))
            yield self.at(model, document.source.position(tag.start), message, attribute="rpy", help=help, fix=fix)
        if ":property" not in text and "<property" not in text:
            return
        for match in re.finditer(_DEFINITION, text):
            value_of = number(match[2])
            if value_of is not None and abs(value_of - pi) < 2e-3:
                message = f"property `{match[1]}` duplicates the built-in `pi` of xacro"
                help = "replace its uses with ${pi}"
                yield self.at(model, document.source.position(match.start()), message, help=help)


def _exact(word: str, is_xacro: bool, tolerance: float) -> str | None:
    """Return the exact form of a rounded angle; None if the angle is exact or not a multiple of π."""
    value = number(word)
    if value is None or not 0.5 <= abs(value) < 100.0:
        return None
    for divisor in (1, 2, 4):
        multiple = round(value * divisor / pi)
        deviation = abs(value - multiple * pi / divisor)
        if multiple and tolerance < deviation < 2e-3 and len(word.lstrip("+-")) >= 4:
            if not is_xacro:
                return f"{multiple * pi / divisor:.10g}"
            sign, count = "-" if multiple < 0 else "", abs(multiple)
            return f"${{{sign}{f'{count}*' if count > 1 else ''}pi{f'/{divisor}' if divisor > 1 else ''}}}"
    return None


def _tag_at(document: Document, offset: int) -> Tag | None:
    start = document.source.text.rfind("<", 0, offset)
    position = document.source.position(start)
    return document.tag_at(position.line, position.column)
