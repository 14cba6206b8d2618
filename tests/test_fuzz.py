"""A sample of each family of ``python -m tests.bench.fuzz``, which runs thousands of cases."""

import pytest

from tests.bench.fuzz import seed_files
from tests.bench.fuzz.families import FAMILIES, PREPARATIONS
from tests.bench.fuzz.runner import outcome

CASES = {"frames": 1}
"""Family → cases, 10 of the others."""


@pytest.fixture(autouse=True)
def own_files(monkeypatch):
    """Start from files of this project only, so that a seed is the same case on every machine."""
    monkeypatch.setattr(seed_files, "FOLDERS", seed_files.OWN)
    seed_files.seeds.cache_clear()
    yield
    seed_files.seeds.cache_clear()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_a_changed_file_is_read_or_refused_in_one_line(family, tmp_path):
    PREPARATIONS.get(family, lambda: None)()
    for seed in range(CASES.get(family, 10)):
        (tmp_path / str(seed)).mkdir()
        failure = outcome(family, seed, tmp_path / str(seed)).failure
        assert not failure, f"{family}, seed {seed}: {failure}"
