"""Parameters of macros: the grammar of the attribute ``params``."""

import re
from collections.abc import Iterator

from urdfkit.record import record

_NAME = re.compile(r"\s*([^\s:=]+?)\s*:?=").match
_WORD = re.compile(r"[^\s'\"]+").match


@record
class MacroParameter:
    """One parameter.

    Attributes:
        name: as written, with the ``*`` or ``**`` of a block.
        has_default: whether a call may leave it out.
        is_forwarded: whether its default is the property of the same name (``:=^``).
        default: the text of its default.
    """

    name: str
    has_default: bool = False
    is_forwarded: bool = False
    default: str | None = None


def parameters(text: str) -> Iterator[MacroParameter]:
    """Yield the parameters of a macro.

    Raises:
        ValueError: only white space is left.
    """
    while text:
        found = _NAME(text)
        parsed = _default(text, found.end()) if found else None
        if found and parsed is not None:
            is_forwarded, default, text = parsed
            yield MacroParameter(found[1], True, is_forwarded, default or None)
            continue
        words = text.split(None, 1)
        if not words:
            raise ValueError("the list of parameters ends with white space")
        yield MacroParameter(words[0])
        text = words[1] if len(words) > 1 else ""


def _default(text: str, start: int) -> tuple[bool, str, str] | None:
    """Return whether a default is forwarded, its text and what follows; None if it does not end at white space."""
    first = start
    while first < len(text) and text[first].isspace():
        first += 1
    for at in range(first, start - 1, -1):
        for sign in ("^|", "^", ""):
            if text.startswith(sign, at):
                begin = at + len(sign)
                end = _end(text, begin)
                if end is not None:
                    return bool(sign), text[begin:end], text[end:].lstrip()
    return None


def _end(text: str, begin: int) -> int | None:
    for opening, closing in (("${", "}"), ("$(", ")")):
        if text.startswith(opening, begin):
            at = text.find(closing, begin)
            while at != -1:
                if _ends(text, at + 1):
                    return at + 1
                at = text.find(closing, at + 1)
    # What follows is tried as a regular expression would, but no place is tried twice.
    tried = {begin}
    open_places = [(begin, _steps(text, begin))]
    while open_places:
        at, steps = open_places[-1]
        following = next((step for step in steps if step not in tried), None)
        if following is not None:
            tried.add(following)
            open_places.append((following, _steps(text, following)))
        elif _ends(text, at):
            return at
        else:
            open_places.pop()
    return None


def _steps(text: str, at: int) -> Iterator[int]:
    """Yield where a quoted text or a word that begins at a place can end."""
    quote = text[at : at + 1]
    if quote and quote in "'\"":
        end = text.find(quote, at + 1)
        while end != -1:
            yield end + 1
            end = text.find(quote, end + 1)
    elif word := _WORD(text, at):
        yield word.end()


def _ends(text: str, at: int) -> bool:
    return at == len(text) or text[at].isspace()
