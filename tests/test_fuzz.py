"""A sample of each family of ``python -m tests.bench.fuzz``, which runs thousands of cases."""

import pytest

from tests.bench.fuzz.families import FAMILIES
from tests.bench.fuzz.runner import outcome

CASES = 10


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("family", sorted(FAMILIES.keys() - {"lsp"}))
def test_a_changed_file_is_read_or_refused_in_one_line(family, tmp_path):
    for seed in range(CASES):
        (tmp_path / str(seed)).mkdir()
        failure = outcome(family, seed, tmp_path / str(seed)).failure
        assert not failure, f"{family}, seed {seed}: {failure}"
