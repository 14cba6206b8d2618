"""Names that misspell another name, unlike names of other parts, sides or axes."""

import re

from urdfkit.lint.facts.ros_packages import is_slip

_WORD = r"[A-Z]?[a-z]+|[A-Z]+|\d+"
_ENDINGS = "drsxyz"
"""Letters at the end of a word that give another word, such as `enabled` and `charger`."""


def is_misspelt(name: str, other: str) -> bool:
    """Return whether a name differs from another by a slip in a word, and not in a letter that enumerates parts.

    `zone_a` and `zone_b`, `posx` and `posy`, `FL` and `FR`, `lgripper` and `rgripper` are different names.
    """
    if abs(len(name) - len(other)) > 4 or not name.isascii() or not other.isascii() or not is_slip(name, other):
        return False
    words, others = re.findall(_WORD, name), re.findall(_WORD, other)
    unlike = [(a, b) for a, b in zip(words, others, strict=False) if a != b]
    if len(words) != len(others) or len(unlike) != 1 or unlike[0][0].lower() == unlike[0][1].lower():
        return True
    ((word, right),) = unlike
    start = next((at for at, (a, b) in enumerate(zip(word, right, strict=False)) if a != b), min(len(word), len(right)))
    shorter = min(len(word), len(right))
    if sorted(word) == sorted(right):
        return shorter > 2 and word[start + 2 :] == right[start + 2 :]
    if len(word) == len(right):
        return shorter > 4 and 0 < start < shorter - 1
    longer = max(word, right, key=len)
    is_doubled = start > 0 and longer[start - 1 : start] == longer[start : start + 1]
    return (shorter > 1 and is_doubled) or (shorter > 3 and (start < shorter or longer[-1] not in _ENDINGS))
