"""Each picture of the documentation is made by docs/make_screenshot.py, is small, and is shown with a description."""

from __future__ import annotations

import re
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("playwright")

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "docs/images").iterdir())


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = spec_from_file_location("make_screenshot", ROOT / "docs/make_screenshot.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_script_makes_each_picture(script: ModuleType) -> None:
    assert [file.name for file in FILES] == sorted(f"{name}.webp" for name in script.PICTURES)
    for picture in script.PICTURES.values():
        assert not picture.course or (ROOT / "docs" / picture.course).is_file()


def test_each_picture_is_small_and_shown_with_a_description(script: ModuleType) -> None:
    from PIL import Image

    shown: dict[Path, list[str]] = {}
    for page in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md")):
        for alt, target in re.findall(r"!\[([^\]]*)\]\(([^)\s]+)\)", page.read_text("utf-8")):
            shown.setdefault((page.parent / target).resolve(), []).append(alt)
    for file in FILES:
        with Image.open(file) as image:
            kind = "film" if image.is_animated else "picture"
        assert file.stat().st_size <= script.LIMITS[kind], file.name
        assert min(map(len, shown.get(file, [""]))) > 20, file.name
