"""Which elements without prefix are meant as directives of xacro, and which belong to another format."""

from __future__ import annotations

import pytest

from urdfkit.description.xacro.recovery.missing_prefix import FOREIGN, is_directive, may_be_directive_inside


@pytest.mark.parametrize(
    ("tag", "attributes", "expected"),
    [
        ("macro", "name", True),
        ("macro", "name params", True),
        ("macro", "params", False),
        ("property", "name value", True),
        ("property", "name default", True),
        ("property", "name remove", True),
        ("property", "name scope", True),
        ("property", "name", False),
        ("property", "value", False),
        ("property", "name type", False),
        ("include", "filename", True),
        ("include", "file", False),
        ("arg", "name default", True),
        ("arg", "name", False),
        ("if", "value", True),
        ("unless", "value", True),
        ("if", "", False),
        ("insert_block", "name", True),
        ("link", "name", False),
    ],
)
def test_a_directive_has_its_attributes(tag: str, attributes: str, expected: bool) -> None:
    assert is_directive(tag, attributes.split()) is expected


@pytest.mark.parametrize(
    ("tag", "value", "expected"),
    [
        ("insert_block", "", True),
        ("if", "${a}", True),
        ("unless", "$(arg a)", True),
        ("if", "1", False),
        ("property", "${a}", False),
        ("include", "", False),
    ],
)
def test_in_other_formats_only_blocks_and_computed_conditions_are_directives(
    tag: str, value: str, expected: bool
) -> None:
    assert may_be_directive_inside(["link", "robot"], tag, value)
    for format in FOREIGN:
        assert may_be_directive_inside([format, "robot"], tag, value) is expected
