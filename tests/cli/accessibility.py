"""Violations of the rules of axe on a page, in both themes, with all panels open."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Page

OPEN = """() => {
  const { panels } = urdfkit.page, ids = [...panels.all.keys()];
  panels.arrange({ open: ids, pinned: ids.filter((id) => panels.all.get(id).pinned) });
  for (const each of document.querySelectorAll("details")) each.open = true;
  return ids.filter((id) => panels.all.get(id).open);
}"""


def violations(page: Page) -> dict[str, list[Any]]:
    """Open all panels, and return the violated rules with the elements, by theme; skip the test without axe."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    assert len(page.evaluate(OPEN)) >= 7
    found = {}
    for theme in ("light", "dark"):
        page.emulate_media(color_scheme=theme)
        page.wait_for_selector(f"html[data-theme={theme}]")
        response = axe.run(page).response
        found[theme] = [(rule["id"], [node["html"] for node in rule["nodes"]]) for rule in response["violations"]]
    page.emulate_media(color_scheme="light")
    return found
