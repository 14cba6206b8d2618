"""Classification of a description by its text, before it is parsed: robot, macro library, fragment or broken file.

Every description of a package is classified by patterns; only the robots among them are expanded.
"""

import re

# Compiled on first use; linting one named file needs none of the last four.
_FIRST = r"<([A-Za-z_][\w:.-]*)"
ROOT = r"<(robot)\b((?:\"[^\"]*\"|'[^']*'|[^>\"'])*)>|<[A-Za-z_]"
NAMED = r"(?<![\w:])name\s*="
_MACRO = r"(?s)<(?:xacro:)?macro\b.*?</(?:xacro:)?macro\s*>"
_CONTENT = r"<(?:link|joint|xacro:(?!macro|property|arg)\w)"


def is_robot(text: str) -> bool:
    """Return whether the first element of a text is a ``<robot>``."""
    root = re.search(ROOT, text)
    return root is not None and root[1] is not None


def begins_with_robot(text: str) -> bool:
    """Return whether a text begins with a named <robot>; a quick test before the patterns."""
    start = text.lstrip("\ufeff \t\r\n")
    if start.startswith("<?xml"):
        start = start.partition("?>")[2].lstrip()
    tag, end, _ = start.partition(">")
    is_closed = bool(end) and tag.count('"') % 2 == 0 and tag.count("'") % 2 == 0
    return is_closed and tag.startswith("<robot ") and ' name="' in tag


def is_broken(text: str) -> bool:
    """Return whether a file is a broken robot: empty, truncated, or with a misspelt or missing root element."""
    first = re.search(_FIRST, text)
    if first is None or is_nearly_robot(first[1]):
        return True
    return not is_robot(text) if first[1] == "robot" else "</robot>" in text and "<robot" not in text


def is_nearly_robot(tag: str) -> bool:
    """Return whether the name of a root element is a misspelt ``robot``."""
    from difflib import SequenceMatcher

    return tag != "robot" and SequenceMatcher(None, tag.lower(), "robot").ratio() >= 0.75


def is_well_formed(text: str) -> bool:
    """Return whether a text is well-formed XML."""
    from xml.parsers import expat

    try:
        expat.ParserCreate().Parse(text, True)
    except (expat.ExpatError, UnicodeEncodeError):
        return False
    return True


def is_library_text(text: str) -> bool:
    """Return whether a text has no content outside of macros."""
    return not re.search(_CONTENT, re.sub(_MACRO, "", text))


def may_be_library(text: str) -> bool:
    """Return whether a text may define only macros; a quick test before the patterns."""
    _, end, rest = text.rpartition("macro>")
    return bool(end) and not any(tag in rest for tag in ("<link", "<joint", "<xacro:"))


def is_fragment(text: str) -> bool:
    """Return whether the text uses links or materials outside of macros that it does not define."""
    content = re.sub(_MACRO, "", text)
    links = set(re.findall(r"<(?:parent|child)\s+link\s*=\s*[\"']([^\"'$]*)[\"']", content))
    materials = re.findall(r"<material\s+name\s*=\s*[\"']([^\"'$]*)[\"']\s*(/?)", content)
    colours = {name for name, is_empty in materials if not is_empty}
    return not links <= set(re.findall(r"<link\s+name\s*=\s*[\"']([^\"']*)", content)) or any(
        is_empty and name not in colours for name, is_empty in materials
    )
