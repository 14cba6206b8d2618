"""What went wrong while xacro expanded a file, in a form that rules and error messages can use."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from urdfkit.description.xml.source import Expansion, Position
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Literal

    FaultKind = Literal[
        "xml",
        "encoding",
        "undefined-property",
        "undefined-macro",
        "undefined-arg",
        "undefined-block",
        "include-not-found",
        "package-not-found",
        "macro-arguments",
        "bad-expression",
        "conditional",
        "recursion",
        "misspelt-directive",
        "directive-attribute",
        "too-large",
        "too-many",
        "other",
    ]


@record
class Fault:
    """Part of a file that xacro could not expand.

    Attributes:
        kind: type of the fault.
        message: one line for the user: the problem and the nearest correct text, without the position.
        position: the start tag of the element it is written in; for ``xml`` the place the parser stopped. A fault in a
            property's value is placed at the property, not where it is used.
        expansions: the macro calls that led there, innermost first.
        attribute: the attribute it is written in; None for text, for the element as a whole, and for ``xml``.
        name: the undefined property, macro, argument or block, the package, or the file that was not found.
        candidates: names that were in scope instead.
        expression: the text between ``${`` and ``}``, where there is one.
        defined_at: where `name` is defined although too late (after its use); None where it is not.
        details: further facts by kind: ``macro-arguments`` has ``macro`` (str), ``missing`` and ``unknown`` (tuples of
            parameter names); ``include-not-found`` has ``path`` (str); ``recursion`` has ``cycle`` (tuple of names);
            ``xml`` has ``cause`` (str), the error of the XML parser;
            ``undefined-macro`` has ``meant`` (str) where the call was read as one of another macro.
    """

    kind: FaultKind
    message: str
    position: Position
    expansions: tuple[Expansion, ...] = ()
    attribute: str | None = None
    name: str | None = None
    candidates: tuple[str, ...] = ()
    expression: str | None = None
    defined_at: Position | None = None
    details: Mapping[str, Any] = MappingProxyType({})


@record
class Unprefixed:
    """A xacro directive or macro call written without ``xacro:``, which was read as if it had the prefix.

    Attributes:
        kind: ``directive`` (macro, property, include, arg, if, unless, insert_block) or ``call``.
        name: the tag as written.
        position: its start tag.
        expansions: the macro calls that led there, innermost first.
    """

    kind: Literal["directive", "call"]
    name: str
    position: Position
    expansions: tuple[Expansion, ...] = ()


@record
class Warned:
    """Warning of xacro, or a call of ``xacro.message()``, ``.warning()`` or ``.error()`` in a file."""

    message: str
    position: Position
    expansions: tuple[Expansion, ...] = ()
    level: Literal["message", "warning", "error"] = "warning"


@record
class MacroDefinition:
    """A ``<xacro:macro>`` that was read.

    Attributes:
        name: without prefix.
        position: its start tag.
        parameters: in order, blocks as ``*name`` and ``**name``.
        defaults: the parameters that may be left out.
    """

    name: str
    position: Position
    parameters: tuple[str, ...]
    defaults: frozenset[str]
