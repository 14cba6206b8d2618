"""Random xacro files expand as with stock xacro; tests/bench/fuzz_xacro.py runs many more."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from tests.description.xacro.evaluation.random_files import Grammar, write_files
from tests.description.xacro.evaluation.stock import difference
from urdfkit.description.packages.resolver import Packages

_ADDRESS = re.compile("0x[0-9a-f]{6}").search
_STEPS = 14
_OF_URDF = {"j": "joint", "l": "limit", "x": "mass", "o": "mesh", "d": "box", "k": "axis", "q": "parent", "s": "sensor"}


def compare(seed: int, folder: Path, found: Counter[str]) -> str:
    """Grow a file, part by part; keep what stock xacro expands. Return the first difference with its file.

    Args:
        seed: of the grammar.
        folder: the working folder, with the files of `write_files`.
        found: counts how many files stock xacro expands, and how many it refuses.
    """
    grammar, kept = Grammar(seed), ""
    path = Path("t.xacro")
    packages = Packages(near=folder / path)
    for step in range(_STEPS):
        added = grammar.node() if step else grammar.head()
        text = grammar.document(kept, added)
        if seed % 2:  # elements of URDF, which are copied without a visit
            text = re.sub(r"(</?)(\w+)(?=[\s/>])", lambda found: found[1] + _OF_URDF.get(found[2], found[2]), text)
        path.write_text(text)
        different, stock = difference(path, {}, packages)
        found["refused" if stock.text is None else "expanded"] += 1
        if stock.text is not None and _ADDRESS(stock.text):
            return ""  # the address of an object
        if different and "RecursionError" not in different:
            return f"seed {seed}: {different}\n{text}"
        if stock.text is None and not step:
            return ""
        kept += added if stock.text is not None else ""
    return ""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::SyntaxWarning", "ignore::DeprecationWarning")
def test_random_files_expand_as_with_stock_xacro(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_files(tmp_path)
    found: Counter[str] = Counter()
    differences = [different for seed in range(120) if (different := compare(seed, tmp_path, found))]
    assert differences == []
    assert found["expanded"] > 400
    assert found["refused"] > 400
