"""Every xacro file expands as with stock xacro: same bytes, files and warnings, or an error with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.description.xacro.evaluation.stock import difference
from tests.description.xacro.origins import misplaced
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand
from urdfkit.errors import UrdfkitError

ROOT = Path(__file__).parents[4]
SHARED = ROOT.parent / "shared"
FOLDERS = [ROOT / "robots", ROOT / "templates", ROOT / "tests", SHARED / "corpus", SHARED / "seed_cases"]

HOSTILE = ("too-large", "include-cycle")
"""Folders of files on which stock xacro does not end."""


@pytest.mark.slow
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
        try:
            differences += misplaced(expand(path, packages=packages, run_xacro=True))
        except UrdfkitError as error:
            if error.position is None:
                differences.append(f"{path}: no position: {error}")
    assert differences == []
    assert len(paths) > 15
