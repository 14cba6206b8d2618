"""An XML declaration after blank lines or comments: tinyxml2 of older simulators reads it, XML does not permit it."""

import re

from urdfkit.errors import XmlError

CAUSE = "XML or text declaration not at start of entity"
"""The error of the XML parser."""


def without_declaration(text: str, error: XmlError) -> str | None:
    """Return the text with spaces in the place of the declaration, so that all positions stay as they are.

    Args:
        text: the text of the file that was read first.
        error: why it could not be read.

    Returns:
        The text; None if the error has another cause, or the declaration comes after an element.
    """
    found = re.match(r"(?s)(?:\s|<!--.*?-->)+(<\?xml\b[^<>]*\?>)", text) if error.cause == CAUSE else None
    if found is None:
        return None
    blank = re.sub(r"[^\r\n]", " ", found[1])
    return text[: found.start(1)] + blank + text[found.end(1) :]
