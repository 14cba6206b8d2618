"""No rule fails on the robots of all rules with one kind of value spoilt, and no message contains a missing value."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.lint import lint

ROBOTS = sorted((Path(__file__).parent / "rules").glob("*/bad*.urdf"))
NUMBER = r'"[-+.\de]+(?: [-+.\de]+)*"'
MISSING = re.compile(r"\bNone\b")
SPOILERS: dict[str, Callable[[str], str]] = {
    "zero axes": lambda text: re.sub(r'(<axis xyz=")[^"]*', r"\g<1>0 0 0", text),
    "zeros": lambda text: re.sub(NUMBER, lambda found: re.sub(r"[-+.\de]+", "0", found[0]), text),
    "words": lambda text: re.sub(NUMBER, '"wide"', text),
    "unknown values": lambda text: re.sub(NUMBER, '"${width}"', text),
    "no values": lambda text: re.sub(rf" [a-z]+={NUMBER}", "", text),
    "undefined parents": lambda text: re.sub(r'(<parent link=")', r"\g<1>no_", text),
    "no names": lambda text: re.sub(r' (name|filename|link|joint)="[^"]*"', "", text),
    "empty elements": lambda text: re.sub(r"<(origin|axis|limit|mass|inertia|box|cylinder|sphere)\b[^>]*>", "", text),
}


@pytest.mark.slow
@pytest.mark.parametrize("spoilt", SPOILERS)
def test_a_spoilt_robot_is_linted(spoilt: str, write: Callable[[str, str], Path]) -> None:
    missing = []
    for path in ROBOTS:
        text = SPOILERS[spoilt](path.read_text())
        found = lint(write("r.urdf.xacro" if "${" in text else "r.urdf", text))
        missing += [f"{path.parent.name}: {each.message}" for each in found if MISSING.search(each.message)]
    assert missing == []
