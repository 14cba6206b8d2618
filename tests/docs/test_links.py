"""Links between pages lead to files and headings that exist, numbered lists count from one, and each page of the user
guide opens with an example.
"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")), *sorted(ROOT.glob("robots/*/README.md"))]
GUIDE = [page for page in PAGES if page.parent == ROOT / "docs" and page.stem not in ("architecture", "conventions")]


def anchors(text: str) -> set[str]:
    """Return the anchors of the headings, as GitHub computes them."""
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken(page: Path, text: str) -> list[str]:
    """Return the relative links of a page without a target."""
    found = []
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if link.startswith(("http:", "https:")):
            continue
        if not target.exists() or (anchor and anchor not in anchors(target.read_text(encoding="utf-8"))):
            found.append(link)
    return found


def miscounted(text: str) -> list[str]:
    """Return the items of numbered lists that do not follow their predecessors: wrapped sentences with a number."""
    found, last = [], dict[int, int]()
    for line in re.sub(r"^ *```.*?^ *```$", "", text, flags=re.MULTILINE | re.DOTALL).splitlines():
        if item := re.match(r"( *)(\d+)\. ", line):
            indent, number = len(item[1]), int(item[2])
            if number not in (1, last.get(indent, 0) + 1):
                found.append(line)
            last[indent] = number
    return found


def test_numbered_lists_count_from_one() -> None:
    assert {page: items for page in PAGES if (items := miscounted(page.read_text(encoding="utf-8")))} == {}


def test_a_sentence_that_became_an_item_is_found() -> None:
    text = "1. one\n2. two\n\n1. one\n\n- at 100 Hz in ROS\n  2. Between updates\n"
    assert miscounted(text) == ["  2. Between updates"]


def test_links_have_targets() -> None:
    assert {page: links for page in PAGES if (links := broken(page, page.read_text(encoding="utf-8")))} == {}


def test_a_broken_link_is_found() -> None:
    text = "[a](missing.md) [b](physics.md#no-such-heading) [c](physics.md#friction) [d](#here)\n# Here\n"
    assert broken(ROOT / "docs/linting.md", text) == ["missing.md", "physics.md#no-such-heading", "#here"]


def test_a_page_opens_with_an_example() -> None:
    for page in GUIDE:
        introduction = page.read_text(encoding="utf-8").partition("\n## ")[0]
        assert re.search(r"^```\w+\n(\$ )?(urdfkit|python|from|import) ", introduction, re.MULTILINE), page
