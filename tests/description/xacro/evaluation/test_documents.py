"""Every xacro file expands as with stock xacro: same bytes, files and warnings, or an error at the same place."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.description.xacro.evaluation.stock import difference
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.description.xacro.expand import expand
from urdfkit.description.xml.element import Element
from urdfkit.errors import UrdfkitError

ROOT = Path(__file__).parents[4]
SHARED = ROOT.parent / "shared"
FOLDERS = [ROOT / "robots", ROOT / "templates", ROOT / "tests", SHARED / "corpus", SHARED / "seed_cases"]

HOSTILE = ("too-large", "include-cycle")
"""Folders of files on which stock xacro does not end; the tracing has limits."""


def described(element: Element) -> list[Any]:
    """Return an element with all below it as plain values, with their origins."""
    children = [described(child) for child in element.children]
    return [element.tag, element.attributes, element.text, element.origin, children]


def traced(path: Path, packages: Packages) -> tuple[list[Any] | None, str | None]:
    """Return the elements that the tracing of stock xacro makes, or the place of its error."""
    try:
        expanded = expand(path, packages=packages, run_xacro=True)
    except UrdfkitError as error:
        return None, str(error.position)
    assert expanded.root is not None
    return described(expanded.root), None


def evaluated(path: Path, packages: Packages) -> tuple[list[Any] | None, str | None]:
    """Return the elements that the evaluator makes, or the place of its error."""
    try:
        expanded = Evaluator(str(path), {}, packages).expand()
    except UrdfkitError as error:
        return None, str(error.position)
    assert expanded.root is not None
    return described(expanded.root), None


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_every_file_expands_as_with_stock_xacro(folder: Path) -> None:
    if not folder.is_dir():
        pytest.skip("no corpus next to the checkout")
    paths = [path for path in sorted(folder.rglob("*.xacro")) if path.is_file()]
    differences = []
    for path in paths:
        packages = Packages(near=path)
        found = "" if path.parent.name in HOSTILE else difference(path, {}, packages)[0]
        if found:
            differences.append(f"{path}: {found[:300]}")
        if traced(path, packages) != evaluated(path, packages):
            differences.append(f"{path}: other elements, origins or place")
    assert differences == []
    assert len(paths) > 15
