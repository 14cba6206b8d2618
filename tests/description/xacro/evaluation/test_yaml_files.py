"""YAML files that are loaded again have the same values and count the same steps."""

from __future__ import annotations

import pytest

from urdfkit.description.xacro.evaluation import yaml_files
from urdfkit.description.xacro.evaluation.yaml_files import yaml_values

TEXTS = (
    "a: {b: [1, 2.5, text], c: !degrees 180}\nd: &e [1]\nf: *e\n",
    "base: &base {x: 1}\narm: {<<: *base, y: 2}\n",
    "",
)


@pytest.mark.parametrize("text", TEXTS)
def test_values_and_steps_are_the_same_at_each_reading(text: str) -> None:
    yaml_files._kept.clear()
    found = []
    for factor in (1.0, 1.0, 2.0):
        steps: list[int] = []
        value = yaml_values(text, "f.yaml", lambda word, factor=factor: float(word) * factor, steps.append)
        found.append((value, sum(steps)))
    assert found[0] == found[1]
    assert found[2][1] == found[0][1]
    if "!degrees" in text:
        assert dict(found[2][0])["a"]["c"] == 2.0 * dict(found[0][0])["a"]["c"]
        assert text in yaml_files._kept


def test_a_change_of_a_value_does_not_change_the_next_reading() -> None:
    first = yaml_values("a: [1, 2]", "f.yaml", float, lambda _: None)
    dict(first)["a"].append(3)
    assert list(dict(yaml_values("a: [1, 2]", "f.yaml", float, lambda _: None))["a"]) == [1, 2]


def test_few_documents_are_kept() -> None:
    for number in range(100):
        yaml_values(f"a: {number}", "f.yaml", float, lambda _: None)
    assert len(yaml_files._kept) <= 16
