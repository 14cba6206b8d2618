"""Read untrusted XML safely into `Element`.

Document types that declare entities or name external files are rejected, because they can expand without bound or read
other files. File size and nesting depth are bounded.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Mapping
from itertools import islice
from pathlib import Path
from xml.parsers import expat

from urdfkit.description.lfs_pointer import LFS
from urdfkit.description.xml.element import MAX_DEPTH, Element
from urdfkit.description.xml.source import Origin, Position, Source, absolute, content_of
from urdfkit.errors import ResourceError, XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, NoReturn

MAX_BYTES = 64 * 2**20
"""Maximum size of a description [bytes]."""

_MESHES = (".stl", ".dae", ".obj", ".gltf", ".glb", ".ply")

MAX_MADE_DEPTH = 400
"""Maximum nesting depth of expanded elements; Python's recursion limit is 1,000."""

MAX_VALUE = 100_000
"""Maximum length of an attribute value [characters]; real descriptions have a few hundred."""

MAX_ATTRIBUTES = 1_000
"""Maximum number of attributes of an element; real descriptions have fewer than 20."""

MAX_TAGS = 100_000
"""Maximum number of tags and comments of a description; a robot with 1,200 links has 30,000."""

_TAG_NAME = r"</?\s*([^\s<>/]*)"


def read_source(path: Path, *, shown_as: str | None = None, texts: Mapping[str, str] | None = None) -> Source:
    """Read a file of bounded size.

    Args:
        path: the file.
        shown_as: name of the file in messages.
        texts: absolute path → content to use instead of the file on disk.

    Raises:
        ResourceError: the file cannot be read or is too large.
    """
    shown = shown_as or str(path)
    if texts and (text := texts.get(str(absolute(path)))) is not None:
        return Source(shown, text, getattr(text, "flaw", None))
    try:
        content = content_of(path, MAX_BYTES + 1)
    except OSError as error:
        raise ResourceError(f"cannot read {shown}: {error.strerror or error}") from error
    if len(content) > MAX_BYTES:
        raise ResourceError(f"{shown} is larger than {MAX_BYTES // 2**20} MiB, the limit for a robot description")
    return Source.decode(shown, content)


def shown_path(path: str | Path) -> str:
    """Return the name of a file in messages: relative to the working folder when inside it."""
    whole, here = str(absolute(path)), str(Path.cwd())
    return whole[len(here) + 1 :] if whole.startswith(here + os.sep) else whole


def document_of(source: Source) -> Element:
    """Read a file without xacro expansion. Prefixes need not be declared.

    Args:
        source: the text.

    Raises:
        XmlError: the file is not well-formed, declares entities, or exceeds a limit.
    """
    file = source.file
    starts: list[tuple[str, dict[str, str], Origin]] = []
    families: list[list[Element]] = [[]]
    texts: list[list[str]] = [[]]
    parser = expat.ParserCreate()
    parser.buffer_text = True
    is_large = len(source.text) > MAX_VALUE

    def start(tag: str, attributes: dict[str, str]) -> None:
        if is_large:
            refuse_excess(source, parser, tag, attributes.values())
        line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
        starts.append((tag, attributes, Origin(Position(file, line, column))))
        families.append([])
        texts.append([])
        if len(starts) > MAX_DEPTH:
            too_deep(source, parser)

    def end(_: str) -> None:
        tag, attributes, origin = starts.pop()
        element = Element(tag, attributes, families.pop(), "".join(texts.pop()).strip(), origin)
        families[-1].append(element)

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = lambda data: texts[-1].append(data)
    parser.EntityDeclHandler = lambda name, *_: refuse_entity(source, parser, name)
    parser.StartDoctypeDeclHandler = lambda _, system, public, __: check_doctype(source, parser, system, public)
    parse_with(parser, source, lambda: [(tag, origin.position) for tag, _, origin in starts])
    return families[0][0]


def parse_with(parser: Any, source: Source, open_tags: Callable[[], list[tuple[str, Position]]]) -> None:
    """Parse a text; `open_tags` returns tag and place of the open elements, outermost first.

    Raises:
        XmlError: the text is not well-formed, or has too many tags.
    """
    if not source.text.strip():
        raise XmlError("the file is empty", position=Position(source.file, 1, 1))
    if (tags := source.text.count("<")) > MAX_TAGS:
        message = (
            f"the file has {tags} tags and comments, and those from here on exceed the limit of {MAX_TAGS}; "
            "no option raises the limit: split the file"
        )
        first = next(islice(re.finditer("<", source.text), MAX_TAGS, None))
        raise XmlError(message, position=source.position(first.start()))
    try:
        parser.Parse(source.text, True)
    except expat.ExpatError as error:
        position = Position(source.file, error.lineno, error.offset + 1)
        cause = expat.ErrorString(error.code) or "not well-formed"
        message, place = _explain(cause, source, position, open_tags())
        raise XmlError(message, position=place, cause=cause) from None
    except UnicodeEncodeError as error:
        raise XmlError("the text contains an unpaired surrogate", position=source.position(error.start)) from None


def _count(tag: str, source: Source) -> int:
    """Return the number of start tags, or with a slash of end tags, of a name."""
    return len(re.findall(rf"<{re.escape(tag)}(?![\w:.-])", source.text))


def _explain(text: str, source: Source, position: Position, opened: list[tuple[str, Position]]) -> tuple[str, Position]:
    """Return the reason of an error and the place to correct: the tag or quote that is not closed, if there is one."""
    tag, start = opened[-1] if opened else (None, position)
    offset = source.offset(position.line, position.column)
    if text == "mismatched tag" and tag:
        found = re.match(_TAG_NAME, source.text[max(source.text.rfind("<", 0, offset + 1), 0) :])
        end = found[1] if found else ""
        is_misspelt = end and _count(tag, source) == 1 and _count(end, source) > 0 == _count(f"/{tag}", source)
        if (is_misspelt or any(outer == end for outer, _ in opened[:-1])) and source.text.startswith(
            f"<{tag}", source.offset(start.line, start.column)
        ):
            return f"mismatched tag: `<{tag}>` is not closed before `</{end}>` on line {position.line}", start
        return f"mismatched tag: `<{tag}>` on line {start.line} is not closed before `</{end}>`", position
    if text == "not well-formed (invalid token)" and source.text[offset : offset + 1] == "<":
        missing = _unclosed(source, offset)
        if missing is not None:
            return missing
        advice = ", or write `&lt;`" if tag else ""
        return f"unexpected `<`: a quote or `>` is missing before it{advice}", position
    return _reason(text, source, position, tag, start.line), position


def _unclosed(source: Source, offset: int) -> tuple[str, Position] | None:
    """Return the error of a `<` inside of a tag and the place of the missing character; None on the same line."""
    text = source.text
    start, quote, opened = max(text.rfind("<", 0, offset), 0), "", 0
    for match in re.finditer(r"[\"']", text[start:offset]):
        if not quote:
            quote, opened = match[0], start + match.start()
        elif quote == match[0]:
            quote = ""
    at = opened if quote else len(text[:offset].rstrip()) - 1
    place, line = source.position(max(at, 0)), source.position(offset).line
    if place.line == line:
        return None
    missing = f"the quote {quote} is not closed" if quote else "`>` is missing"
    return f"{missing} before the `<` on line {line}", place


def _reason(text: str, source: Source, position: Position, tag: str | None, line: int) -> str:
    offset = source.offset(position.line, position.column)
    unclosed = f"`<{tag}>` on line {line} is not closed" if tag else ""
    if source.file.lower().endswith(_MESHES):
        return "this is a mesh: use the URDF that names it"
    if source.text.startswith(LFS.decode()):
        return "this is a Git LFS pointer, not the file itself: run `git lfs pull`"
    if text == "no element found":
        return f"the file ends too early: {unclosed}" if tag else "this is not XML: there is no element"
    if text == "unclosed token":
        return f"a tag, comment or quote is opened here and never closed{'; ' + unclosed if tag else ''}"
    if text == "unbound prefix":
        found = re.match(_TAG_NAME, source.text[max(source.text.rfind("<", 0, offset + 1), 0) :])
        prefix = found[1].split(":")[0] if found and ":" in found[1] else "xacro"
        uri = "http://www.ros.org/wiki/xacro" if prefix == "xacro" else "…"
        return f'unbound prefix: `{prefix}:` needs xmlns:{prefix}="{uri}" on the root element of this file'
    if text == "syntax error" and tag is None:
        return "this is not XML: it does not start with `<`"
    if text == "junk after document element":
        return "there is content after the end of the root element"
    if text == "XML or text declaration not at start of entity":
        return "`<?xml …?>` must be at the very start of the file"
    if text == "undefined entity":
        return "undefined entity: write `&amp;` for an ampersand"
    if text == "duplicate attribute":
        return "duplicate attribute: the same name twice in one tag"
    if text == "not well-formed (invalid token)":
        near = source.text[offset : offset + 1]
        if near == "&":
            return "unescaped `&`: write `&amp;`"
        return f"not well-formed near {source.text[offset : offset + 12].splitlines()[0]!r}" if near.strip() else text
    return text


def _here(source: Source, parser: Any) -> Position:
    return Position(source.file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)


def too_deep(source: Source, parser: Any) -> NoReturn:
    """Reject elements that are nested too deeply.

    Raises:
        XmlError: always.
    """
    raise XmlError(f"elements are nested deeper than {MAX_DEPTH}", position=_here(source, parser))


def check_depth(depth: int, position: Position) -> None:
    """Reject expanded elements that are nested too deeply, because later passes are recursive.

    Raises:
        XmlError: `depth` reaches `MAX_MADE_DEPTH`.
    """
    if depth >= MAX_MADE_DEPTH:
        message = f"here, macros and blocks nest elements deeper than {MAX_MADE_DEPTH}"
        raise XmlError(message, position=position)


def refuse_excess(source: Source, parser: Any, tag: str, values: Collection[str]) -> None:
    """Reject an element with too many attributes or too long attribute values.

    Raises:
        XmlError: the element exceeds a limit.
    """
    if len(values) > MAX_ATTRIBUTES:
        message = f"<{tag}> has {len(values)} attributes; at most {MAX_ATTRIBUTES} are read"
        raise XmlError(message, position=_here(source, parser))
    longest = max(map(len, values), default=0)
    if longest > MAX_VALUE:
        message = f"an attribute of <{tag}> has {longest} characters; at most {MAX_VALUE} are read"
        raise XmlError(message, position=_here(source, parser))


def refuse_entity(source: Source, parser: Any, name: str) -> NoReturn:
    """Reject a document that declares an entity.

    Raises:
        XmlError: always.
    """
    raise XmlError(
        f"declares the entity `{name}`: entity declarations are rejected, because they can grow without bound or read "
        "files",
        position=_here(source, parser),
    )


def check_doctype(source: Source, parser: Any, system: str | None, public: str | None) -> None:
    """Reject an external document type.

    Raises:
        XmlError: the document type is external.
    """
    if system or public:
        message = f"the document type names `{system or public}`: external entities are rejected"
        raise XmlError(message, position=_here(source, parser))
