"""Warnings of a simulation for its user."""

from collections.abc import Callable, Iterable


class Notes:
    """Reports each warning once.

    Args:
        report: receives the text.

    Attributes:
        report: receives the text; may be replaced.
    """

    def __init__(self, report: Callable[[str], None]) -> None:
        self.report = report
        self._reported: set[str] = set()

    def __call__(self, text: str) -> None:
        """Report a warning, unless the same text was reported before."""
        if text not in self._reported:
            self._reported.add(text)
            self.report(text)

    def forget(self, texts: Iterable[str]) -> None:
        """Report these warnings again when they occur again."""
        self._reported.difference_update(texts)
