"""Workspaces in which one launch, YAML, SRDF, build or description file is changed."""

from __future__ import annotations

import atexit
import random
import shutil
import tempfile
from functools import cache
from pathlib import Path

from tests.bench import fuzz_lint
from tests.bench.fuzz import mutations
from tests.bench.fuzz.seed_files import FOLDERS, MAX_BYTES, text_of
from tests.bench.fuzz.xml_mutations import xml
from tests.bench.package_mutants import bases

_XML = (".launch", ".launch.xml", ".srdf", ".srdf.xacro", "package.xml")
_BUILD = ("CMakeLists.txt", "setup.py", "setup.cfg")
_READ = (*_XML, *_BUILD, ".launch.py", ".yaml", ".yml", ".cpp", ".hpp")
_MAX_FILES = 400
"""Largest number of files of a workspace that is copied."""


@cache
def workspaces() -> list[Path]:
    """Return folders of packages: the workspaces of the package mutants, and the repositories of the corpus."""
    top = Path(tempfile.mkdtemp(prefix="fuzz_workspaces_"))
    atexit.register(shutil.rmtree, top, ignore_errors=True)
    for name in bases.NAMES:
        (top / name).mkdir()
        bases.write(name, top / name)
    corpus = FOLDERS[-1]
    repositories = sorted(folder for folder in corpus.iterdir() if folder.is_dir()) if corpus.is_dir() else []
    return [*(top / name for name in bases.NAMES), *(each for each in repositories if _files(each))]


@cache
def _files(folder: Path) -> list[Path]:
    """Return the files that the readers of packages read; none of a large workspace or one without packages."""
    every = [path for path in folder.rglob("*") if path.is_file()]
    if len(every) > _MAX_FILES or not any(path.name == "package.xml" for path in every):
        return []
    return sorted(path for path in every if path.name.endswith(_READ) and 0 < path.stat().st_size < MAX_BYTES)


def workspace(folder: Path, rng: random.Random) -> Path:
    """Write a copy of a workspace in which one or two files are changed."""
    original = rng.choice(workspaces())
    place = folder / original.name
    shutil.copytree(original, place)
    for changed in rng.choices(_files(original), k=rng.choice((1, 1, 1, 2))):
        path = place / changed.relative_to(original)
        path.write_bytes(_changed(path, rng))
    return place


def _changed(path: Path, rng: random.Random) -> bytes:
    if rng.random() < 0.1:
        return fuzz_lint.mutated(path.read_bytes(), rng)
    text = text_of(path)
    if path.name.endswith(_XML):
        text = xml(text, rng)
    elif path.name.endswith((".py", ".cfg")):
        text = mutations.python(text, rng)
    elif path.suffix in (".yaml", ".yml"):
        text = mutations.yaml(text, rng)
    elif rng.random() < 0.5:
        text = mutations.lines_of_yaml(text, rng)
    else:
        return mutations.words(text.encode(), rng)
    return text.encode("utf-8", "replace")
