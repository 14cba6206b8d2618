"""The table of features of the page: the tests that a row names use a browser."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
TESTS = ROOT / "tests/cli"


def rows() -> list[tuple[str, str]]:
    """Return feature and tests of each row whose cell of urdfkit is not "no"; "same" repeats the tests above."""
    found, tests = [], ""
    features = (ROOT / "docs/page.md").read_text(encoding="utf-8").partition("\n## Scenes, compared\n")[0]
    for line in features.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("| ") or line.startswith("| |"):
            continue
        tests = tests if cells[-1] == "same" else cells[-1]
        if not cells[1].startswith("no"):
            found.append((cells[0], tests))
        else:
            assert not cells[-1], f"{cells[0]}: a feature that is absent names a test"
    return found


def test_every_feature_of_the_page_has_a_browser_test() -> None:
    for feature, tests in rows():
        files = [TESTS / name for name in re.findall(r"`(test_\w+\.py)`", tests)]
        assert files, f"{feature}: no test is named"
        texts = [file.read_text(encoding="utf-8") for file in files]
        assert any("mark.browser" in text for text in texts), f"{feature}: none of {tests} uses a browser"


def test_the_table_has_the_features_of_all_parts() -> None:
    assert len(rows()) > 45
