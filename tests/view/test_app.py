"""The page's own files, read as text: small modules, nothing that makes code of words."""

import os
import re
from pathlib import Path

from urdfkit.view.server.http_handlers import APP

MODULES = sorted(APP.rglob("*.js"))


def test_a_module_is_small_says_what_it_is_and_makes_no_code_of_words() -> None:
    for path in MODULES:
        text = path.read_text("utf-8")
        assert len(text.splitlines()) < 300, path
        assert text.startswith("// "), path
        for forbidden in (r"\beval\(", r"new Function", r"\binnerHTML\b", r"\bouterHTML\b", r"insertAdjacentHTML",
                          r"document\.write", r"https?://(?!www\.w3\.org/2000/svg)"):  # fmt: skip
            assert not re.search(forbidden, text), f"{path}: {forbidden}"


def test_every_import_is_there() -> None:
    for path in MODULES:
        imports = re.findall(r'import\s*(?:\{([^}]*)\}\s*from\s*)?"(\.[\w./-]+)"', path.read_text("utf-8"))
        for names, module in imports:
            other = Path(os.path.normpath(path.parent / module)).read_text("utf-8")
            for name in filter(None, (part.strip() for part in names.split(","))):
                pattern = rf"export (?:async )?(?:function\*?|class|const) {name}\b"
                assert re.search(pattern, other), f"{path}: {name} of {module}"


def test_no_style_is_written_into_the_page() -> None:
    assert not re.search(r"\sstyle=|<style|\son\w+=", (APP / "index.html").read_text("utf-8"))
