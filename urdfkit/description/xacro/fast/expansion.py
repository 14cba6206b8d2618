"""A run of xacro of which nobody prints the outcome: on `nodes`, where what is finished is not gone through."""

from __future__ import annotations

from keyword import iskeyword

from urdfkit.description.xacro.fast.reader import can_plant, planted
from urdfkit.description.xacro.fast.templates import Maker
from urdfkit.description.xacro.recovery import RecoveringRun

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any

    from typing_extensions import Self

    from urdfkit.description.xacro.fast.incremental import Memory
    from urdfkit.description.xml.source import Source


class QuickRun(RecoveringRun):
    """One expansion that goes on after errors, on nodes of our own.

    Attributes:
        is_mixed: whether a file had to be read by minidom's builder: then what came out counts for nothing.
        memory: what is remembered of the files; None where nothing is.
    """

    HOOKS = (*RecoveringRun.HOOKS, "is_valid_name", "remove_previous_comments")

    is_mixed = False
    memory: Memory | None = None

    def take(self, xacro: ModuleType) -> dict[str, Any]:
        """Take stock of xacro, and of what is remembered."""
        lent = super().take(xacro)
        self._shelf = self.memory.shelf if self.memory is not None else None
        self._maker = Maker(self.evaluator, self._shelf)
        return lent

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

    def with_hindsight(self) -> Self | None:
        """Return a run that knows what this one found defined too late; None when there is nothing new."""
        again = super().with_hindsight()
        if again is not None:
            again.memory = self.memory
        return again

    def printed(self) -> str:
        """Return the document as stock xacro prints it: by a run that keeps what is to be printed."""
        from urdfkit.description.xacro.stock_xacro import recovered

        run = RecoveringRun(
            self.path, self.arguments, self.packages, mend_prefixes=self._mend_prefixes, texts=self.texts
        )
        return recovered(run).printed()

    # What xacro calls instead of its own functions of the same name.

    def handle_macro_call(self, node: Any, macros: Any, symbols: Any) -> Any:
        """Expand a macro call; make elements of what needs nothing but values."""
        if node.finished is not None:
            if self._shelf is not None and node.stamp[3]:
                node.finish(self._maker.finished(node.finished[0], node.stamp[3]))
            return True
        if node.pattern is not None:
            made = self._maker.element(node.pattern, symbols, node.stamp[3])
            if made is not None:
                node.finish(made)
                return True
            node.open()
        return super().handle_macro_call(node, macros, symbols)

    def eval_text(self, text: str, symbols: Any) -> Any:
        """Evaluate text; where all it needs is known, without a lexer."""
        if type(text) is str and "$" in text:
            try:
                value = self._maker.value(text, symbols)
            except Exception:  # whatever it is, it is raised again, and looked into
                value = None
            if value is not None:
                return value
        return super().eval_text(text, symbols)

    def _begin_call(self, name: str, macro: Any) -> None:
        super()._begin_call(name, macro)
        if self._shelf is not None and self.chain:
            self.chain = self._shelf.chain(self.chain[0], self.position_of(self._calling)[1])

    def is_valid_name(self, name: str) -> bool:
        """Return whether a property may be called so; plain names are not parsed as Python for it."""
        if name.isascii() and name.isidentifier() and not iskeyword(name):
            return True
        return bool(self.stock["is_valid_name"](name))

    def remove_previous_comments(self, node: Any) -> None:
        """Do nothing: there are no comments."""
