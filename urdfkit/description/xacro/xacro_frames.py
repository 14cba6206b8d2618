"""Where in the files xacro was when it failed or warned, read from the frames of its own functions.

xacro keeps no positions. But the local variables of its functions hold the DOM node and the text that are being
evaluated, and the nodes carry stamps: so nothing has to be recorded while all goes well.
"""

from __future__ import annotations

from collections.abc import Iterable
from types import FrameType

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_SKIPPED_NAMES = ("__builtins__",)


class Place:
    """What xacro was at.

    Attributes:
        node: the element; None before the first.
        attribute: the attribute being evaluated; None for text or the element as a whole.
        expression: what is between ``${`` and ``}``, if an expression was being evaluated.
        command: what is between ``$(`` and ``)``, if a substitution was being evaluated.
        property: name and table of the property whose value was being evaluated, if any.
        symbols: the innermost table of properties.
        macros: the innermost table of macros.
    """

    def __init__(self) -> None:
        self.node: Any = None
        self.attribute: str | None = None
        self.expression: str | None = None
        self.command: str | None = None
        self.property: tuple[str, Any] | None = None
        self.symbols: Any = None
        self.macros: Any = None

    def names(self) -> list[str]:
        """Return the properties in scope, innermost first."""
        return _names(self.symbols)

    def macro_names(self) -> list[str]:
        """Return the macros in scope, innermost first."""
        return _names(self.macros)


def place_of_error(error: BaseException, caught_in: FrameType | None = None) -> Place:
    """Return where xacro was when it raised `error`.

    Args:
        error: the exception, with its traceback.
        caught_in: the frame that caught it, when xacro is still running below.
    """
    frames = _frames_above(caught_in)
    seen: set[int] = set()
    cause: Any = error
    while isinstance(cause, BaseException) and id(cause) not in seen:
        seen.add(id(cause))
        traceback = cause.__traceback__
        while traceback is not None:
            frames.append(traceback.tb_frame)
            traceback = traceback.tb_next
        cause = getattr(cause, "exc", None)
    return place_of_frames(frames)


def place_of_call(frame: FrameType | None) -> Place:
    """Return where xacro is, from the frame of a function it called."""
    return place_of_frames(_frames_above(frame))


def place_of_frames(frames: Iterable[FrameType]) -> Place:
    """Return where xacro was, from its frames, outermost first."""
    place = Place()
    for frame in frames:
        if frame.f_globals.get("__name__") != "xacro":
            continue
        local = frame.f_locals
        _LOOK.get(frame.f_code.co_name, _look_at_nothing)(place, local)
    return place


def _frames_above(frame: FrameType | None) -> list[FrameType]:
    frames: list[FrameType] = []
    while frame is not None:
        frames.append(frame)
        if frame.f_code.co_name == "process_doc":
            break
        frame = frame.f_back
    return frames[::-1]


def _look_at_nothing(place: Place, local: dict[str, Any]) -> None:
    return


def _look_at_eval_all(place: Place, local: dict[str, Any]) -> None:
    node = local.get("node")
    place.macros, place.symbols = local.get("macros"), local.get("symbols")
    place.expression = place.command = place.property = None
    if node is None:
        return
    # `next` is set once the loop over the children has begun: until then it is about an attribute of `node`.
    place.attribute = None if "next" in local else local.get("name")
    place.node = node if node.nodeType == 1 else node.parentNode


def _look_at_element(place: Place, local: dict[str, Any]) -> None:
    node = local.get("node") or local.get("elt")
    if node is not None:
        place.node, place.attribute = node, None
        place.expression = place.command = place.property = None


def _look_at_default(place: Place, local: dict[str, Any]) -> None:
    macro = local.get("macro")
    if macro is not None and macro.body is not None:
        place.node, place.attribute = macro.body, "params"


def _look_at_resolve(place: Place, local: dict[str, Any]) -> None:
    place.property = (local["key"], local["self"])
    place.expression = None


def _look_at_text(place: Place, local: dict[str, Any]) -> None:
    place.symbols = local.get("symbols", place.symbols)
    if place.property is None and place.attribute is None and place.node is not None:
        text = local.get("text")
        place.attribute = next((name for name, value in place.node.attributes.items() if value == text and text), None)


def _look_at_expression(place: Place, local: dict[str, Any]) -> None:
    place.expression = local.get("s")


def _look_at_command(place: Place, local: dict[str, Any]) -> None:
    place.command = local.get("s")


_LOOK = {
    "eval_all": _look_at_eval_all,
    "handle_macro_call": _look_at_element,
    "handle_dynamic_macro_call": _look_at_element,
    "process_include": _look_at_element,
    "grab_property": _look_at_element,
    "grab_macro": _look_at_element,
    "eval_default_arg": _look_at_default,
    "_resolve_": _look_at_resolve,
    "eval_text": _look_at_text,
    "handle_expr": _look_at_expression,
    "handle_extension": _look_at_command,
}


def _names(table: Any) -> list[str]:
    """Return the keys of xacro's chain of tables up to, not including, its own global symbols."""
    found: list[str] = []
    while table is not None and hasattr(table, "parent"):
        found += [key for key in dict.keys(table) if not key.startswith("*") and key not in _SKIPPED_NAMES]
        table = table.parent
    return list(dict.fromkeys(found))
