"""A run of xacro of which nobody prints the outcome: on `nodes`, where what is finished is not gone through."""

from __future__ import annotations

import re

from urdfkit.description.planting import can_plant, planted
from urdfkit.description.recovery import RecoveringRun
from urdfkit.description.too_large import MAX_CHARACTERS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.memory import Memory
    from urdfkit.description.source import Source

_SIMPLE = (int, float, bool, str)
_EXPRESSION = re.compile(r"\$\{([^}]*)\}")


class QuickRun(RecoveringRun):
    """One expansion that goes on after errors, on nodes of our own.

    Attributes:
        is_mixed: whether a file had to be read by minidom's builder: then what came out counts for nothing.
        memory: what is remembered of the files; None where nothing is.
    """

    HOOKS = (*RecoveringRun.HOOKS, "remove_previous_comments")

    is_mixed = False
    memory: Memory | None = None

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._pieces: dict[str, list[str]] = {}

    def expand(self) -> None:
        """Expand the file as far as it goes."""
        try:
            super().expand()
        except (AttributeError, TypeError):
            if not self.is_mixed:
                raise

    def stamped(self, source: Source) -> Any:
        """Read a file into the document that xacro works on."""
        document = super().stamped(source)
        self.is_mixed = self.is_mixed or not hasattr(document.documentElement, "finished")
        return document

    def read_document(self, source: Source) -> Any:
        """Read a well-formed file."""
        if not can_plant(source):
            return super().read_document(source)
        return planted(source, self) if self.memory is None else self.memory.document(source, self)

    def with_hindsight(self) -> RecoveringRun | None:
        """Return a run that knows what this one found defined too late; None when there is nothing new."""
        again = super().with_hindsight()
        if again is None:
            return None
        quick = QuickRun(
            again.path,
            again.arguments,
            again.packages,
            mend_prefixes=self._mend_prefixes,
            hindsight=again.hindsight,
            texts=again.texts,
        )
        quick.memory = self.memory
        return quick

    def printed(self) -> str:
        """Return the document as stock xacro prints it: by a run that keeps what is to be printed."""
        from urdfkit.description.expand import recovered

        run = RecoveringRun(
            self.path, self.arguments, self.packages, mend_prefixes=self._mend_prefixes, texts=self.texts
        )
        return recovered(run).printed()

    # What xacro calls instead of its own functions of the same name.

    def handle_macro_call(self, node: Any, macros: Any, symbols: Any) -> Any:
        """Expand a macro call; leave alone what is finished."""
        return node.finished is not None or super().handle_macro_call(node, macros, symbols)

    def eval_text(self, text: str, symbols: Any) -> Any:
        """Evaluate text; where all it needs is known, without a lexer."""
        if type(text) is str and "$" in text:
            try:
                value = self._known(text, symbols)
            except Exception:  # whatever it is, it is raised again, and looked into
                value = None
            if value is not None:
                return value
        return super().eval_text(text, symbols)

    def _known(self, text: str, symbols: Any) -> Any:
        """Return the value of a text of names, numbers and their quotients; None where it is not as plain as that."""
        pieces = self._pieces.get(text)
        if pieces is None:
            pieces = self._pieces[text] = _EXPRESSION.split(text)
            if any("$" in piece for piece in pieces):
                pieces.clear()
        if len(pieces) < 2 or self.evaluator.is_exhausted:
            return None
        values: list[Any] = []
        for index, piece in enumerate(pieces):
            if index % 2:
                code = self.evaluator.compile(piece)
                if code.form != "plain" or not all(_is_known(name, symbols) for name in code.names):
                    return None
                values.append(self.evaluator.safe_eval(piece, symbols))
            elif piece:
                values.append(piece)
        value = values[0] if len(values) == 1 else "".join(map(str, values))
        if type(value) not in _SIMPLE or (type(value) is str and len(value) > MAX_CHARACTERS):
            return None
        self.evaluator.count(text)
        return value

    def remove_previous_comments(self, node: Any) -> None:
        """Do nothing: there are no comments."""


def _is_known(name: str, table: Any) -> bool:
    """Whether a property has its value already; what is not among the properties is looked for by others."""
    while hasattr(table, "parent"):
        if dict.__contains__(table, name):
            return name not in table.unevaluated and type(dict.__getitem__(table, name)) in _SIMPLE
        table = table.parent
    return dict.__contains__(table, name) and type(dict.__getitem__(table, name)) in _SIMPLE
