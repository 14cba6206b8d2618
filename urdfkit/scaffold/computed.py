"""Answers that no template can hold: what is computed from the others."""

from __future__ import annotations

from collections.abc import Mapping


def computed(template: str, answers: Mapping[str, str]) -> dict[str, str]:
    """Return further placeholders of a template that we ship.

    Args:
        template: its name.
        answers: to its questions.

    Raises:
        UsageError: the answers do not go together.
    """
    if template == "world":
        from urdfkit.scaffold.world import contents

        return contents(answers)
    return {}
