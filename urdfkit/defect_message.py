"""Messages about defects, which keep their parts: the defect, its effect and the suggested name."""

from __future__ import annotations


class Suggestion(str):
    """End of a message, ``; did you mean `x`?``; empty if no name is suggested.

    ``message + Suggestion("x")`` is a `DefectMessage`.

    Attributes:
        meant: the suggested name; an element as ``<name>``.
        written: the name in its place; empty if unknown.
    """

    meant: str
    written: str

    def __new__(cls, meant: str | None, written: str = "", before: str = "; ") -> Suggestion:
        """Create the text, with `before` in front of the question."""
        quoted = meant if meant and meant.startswith("<") else f"`{meant}`"
        self = super().__new__(cls, f"{before}did you mean {quoted}?" if meant else "")
        self.meant, self.written = meant or "", written
        return self

    def __radd__(self, message: str) -> str:
        return DefectMessage(message, suggestion=self) if self else message


class DefectMessage(str):
    """One line that describes a defect.

    Attributes:
        defect: the description, without the parts below.
        effect: the consequence, such as ``the controller is ignored``; empty if not recorded.
        suggestion: the suggested name, after defect and effect; None if no name is suggested.
        tail: the rest of the text.
    """

    defect: str
    effect: str
    suggestion: Suggestion | None
    tail: str

    def __new__(
        cls, defect: str, effect: str = "", suggestion: Suggestion | None = None, tail: str = ""
    ) -> DefectMessage:
        """Create the text of the parts."""
        effects = f"; {effect}" if effect else ""
        self = super().__new__(cls, f"{defect}{effects}{suggestion or ''}{tail}")
        self.defect, self.effect, self.suggestion, self.tail = defect, effect, suggestion, tail
        return self

    @classmethod
    def of(cls, message: str) -> DefectMessage:
        """Return a message with its parts; a text without recorded parts is a defect."""
        return message if isinstance(message, DefectMessage) else cls(message)

    def __add__(self, more: str) -> DefectMessage:
        if not isinstance(more, Suggestion):
            return DefectMessage(self.defect, self.effect, self.suggestion, self.tail + more)
        if self.suggestion is not None or self.tail:
            return DefectMessage(str(self), suggestion=more)
        return DefectMessage(self.defect, self.effect, more or None)

    def __radd__(self, before: str) -> DefectMessage:
        return DefectMessage(before + self.defect, self.effect, self.suggestion, self.tail)

    @property
    def stem(self) -> str:
        """The text before the suggestion; all of it if no name is suggested."""
        return self.removesuffix(f"{self.suggestion}{self.tail}") if self.suggestion else str(self)

    @property
    def without_effect(self) -> DefectMessage:
        """The message without its effect."""
        return DefectMessage(self.defect, "", self.suggestion, self.tail)

    def inserted(self, text: str) -> DefectMessage:
        """Return the message with a text in front of the suggestion; at the end if no name is suggested."""
        return DefectMessage(self.stem + text, "", self.suggestion, self.tail if self.suggestion else "")

    def with_effect(self, effect: str) -> DefectMessage:
        """Return the message with an effect in front of the suggestion; at the end if no name is suggested."""
        return DefectMessage(self.stem, effect, self.suggestion, self.tail if self.suggestion else "")


def with_effect(defect: str, effect: str) -> DefectMessage:
    """Return the description of a defect and its effect, in front of a suggestion at the end of the description.

    Args:
        defect: message of an error, such as ``no joint `elbw`; did you mean `elbow`?``.
        effect: the consequence, such as ``the controller is ignored``.
    """
    return DefectMessage.of(defect).with_effect(effect)
