"""Whether a message contains a problem and a suggestion, with the consequence of the problem in between."""

from __future__ import annotations


def contains(message: str, expected: str) -> bool:
    """Return whether a message contains ``PROBLEM; did you mean SUGGESTION?``, possibly with a clause in between."""
    problem, question, suggestion = expected.partition("; did you mean")
    return problem in message and question + suggestion in message[message.index(problem) :]
