"""Changed robot descriptions and worlds."""

from __future__ import annotations

import random
from pathlib import Path

from tests.bench import fuzz_lint
from tests.bench.fuzz import mutations
from tests.bench.fuzz.seed_files import files_read, seeds, text_of, with_changed
from tests.bench.fuzz.xml_mutations import xml


def description(folder: Path, rng: random.Random, original: Path | None = None, *, bytes_share: float = 0.2) -> Path:
    """Write a robot description in a copy of its package, in which it or a file that it reads is changed.

    Args:
        folder: receives the copy.
        rng: source of the random choices.
        original: the description; any when None.
        bytes_share: share of the cases whose bytes are changed, which mostly ends in an error of the XML reader.
    """
    original = original or rng.choice(seeds(".urdf", ".xacro"))
    changed = rng.choice(files_read(original)) if rng.random() < 0.3 else original
    if rng.random() < bytes_share:
        content = fuzz_lint.mutated(changed.read_bytes(), rng)
    elif changed.suffix in (".yaml", ".yml"):
        content = mutations.yaml(text_of(changed), rng).encode("utf-8", "replace")
    else:
        content = xml(text_of(changed), rng).encode("utf-8", "replace")
    return with_changed(folder, original, changed, content)


def world_file(folder: Path, rng: random.Random) -> tuple[Path, Path]:
    """Write a changed world; return it and the original."""
    original = rng.choice(seeds(".sdf", ".world"))
    path = folder / f"changed_{original.name}"
    path.write_text(xml(text_of(original), rng), "utf-8", "replace")
    return path, original
