"""Parse numbers like urdfdom."""

import re


def number(text: str) -> float | None:
    """Return `text` as a number, ignoring surrounding white space; None if it is not a number.

    Unlike `float`, rejects underscores and non-ASCII digits.
    """
    if not text.isascii() or "_" in text:
        return None
    try:
        return float(text)
    except ValueError:
        return None


def numbers(text: str) -> list[float] | None:
    """Return the numbers that `text` lists, separated by white space; None if one of them is not a number."""
    found: list[float] = []
    for word in text.split():
        value = number(word)
        if value is None:
            return None
        found.append(value)
    return found


def why_not(text: str) -> str:
    """Return the probable reason why a text is not numeric, in a few words; empty when unclear."""
    if "${" in text or "$(" in text or "{$" in text:
        return "an expression that was not evaluated"
    if re.search(r"\d,\d", text) and not re.search(r",\s", text):
        return "write a decimal point instead of the comma"
    if "," in text:
        return "separate numbers with spaces, not commas"
    if not text.strip():
        return "empty"
    if re.fullmatch(r"\s*[+-]?[\d.]+\s*[a-zA-Z°]+\s*", text):
        return "write numbers in SI units, without the unit"
    if "\u2212" in text or "\u2013" in text:
        return "a dash instead of a minus sign"
    return ""
