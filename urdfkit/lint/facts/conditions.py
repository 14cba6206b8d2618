"""Whether a part of a description is inside of a xacro condition."""

import re


def is_conditional(text: str, pattern: str) -> bool:
    """Return whether a pattern matches inside of a xacro condition.

    Args:
        text: text of a description.
        pattern: a regular expression without groups.
    """
    depth = 0
    for at in re.finditer(rf"<(/?)xacro:(?:if|unless)\b|{pattern}", text):
        if at[1] is None:
            if depth:
                return True
        else:
            depth = max(depth - 1, 0) if at[1] else depth + 1
    return False
