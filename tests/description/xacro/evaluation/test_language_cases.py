"""The facts of `language_cases.yaml`, which follow the test suite of the xacro package, hold for both."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.description.xacro.evaluation.stock import difference
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand
from urdfkit.errors import UrdfkitError

Write = Callable[[str, str], Path]

ROOT = '<r xmlns:xacro="http://www.ros.org/wiki/xacro">'
DATA = yaml.safe_load(Path(__file__).with_name("language_cases.yaml").read_text(encoding="utf-8"))


def content(xml: str, *, whole: bool) -> str:
    """Return the document below the banner, or the content of its root, without white space next to tags."""
    text = re.sub(r"\s+", " ", xml.split(" -->\n", 4)[4])
    text = re.sub(r" ?(<[^<>]*>) ?", r"\1", text)
    return text if whole else text.removeprefix("<r>").removesuffix("</r>").removeprefix("<r/>")


@pytest.mark.parametrize("case", DATA["cases"], ids=lambda case: case.get("root") or case["in"])
def test_a_fact_holds_for_urdfkit_and_the_xacro_package(write: Write, case: dict[str, Any]) -> None:
    for name, text in DATA["files"].items():
        write(name, re.sub("^R", lambda _: ROOT, text))
    path = write("m.xacro", case.get("root") or f"{ROOT}{case['in']}</r>")
    packages, arguments = Packages(near=path), case.get("arguments", {})
    assert difference(path, arguments, packages)[0] == ""
    if "error" in case:
        with pytest.raises(UrdfkitError, match=re.escape(case["error"])) as caught:
            expand(path, arguments=arguments, packages=packages)
        assert caught.value.position is not None
        return
    expanded = expand(path, arguments=arguments, packages=packages)
    assert content(expanded.xml, whole="root" in case) == case["out"]
    for warning, part in zip(expanded.warnings, case.get("reports", ()), strict=True):
        assert part in warning.message
