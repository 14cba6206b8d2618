"""Every file of the corpus that stock xacro expands: same bytes, and an origin for every element."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
import xacro
from xacro import substitution_args

from tests.description.xacro.origins import misplaced
from urdfkit.description import load
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand, expand_leniently
from urdfkit.errors import UrdfkitError

SHARED = Path(__file__).parents[2].parent / "shared"
CORPUS = SHARED / "corpus"

pytestmark = pytest.mark.skipif(not (CORPUS / "expected.json").is_file(), reason="no corpus next to the checkout")


def entries() -> list[dict[str, Any]]:
    expected = json.loads((CORPUS / "expected.json").read_text())
    return [*expected["models"], *expected["others"]]


def stock(path: str, arguments: dict[str, str], packages: Packages, monkeypatch: pytest.MonkeyPatch) -> str | None:
    """Return what stock xacro prints, None when it fails."""

    def find(name: str) -> str:
        return str(packages.find(name))

    monkeypatch.setattr(substitution_args, "_eval_find", find)
    monkeypatch.setitem(substitution_args._eval_dict, "find", find)
    try:
        return str(xacro.process_file(path, mappings=dict(arguments)).toprettyxml(indent="  "))
    except Exception:
        return None


@pytest.fixture
def installed(tmp_path: Path) -> Path:
    """A share folder in which the packages that are read from description/ lie as their CMake installs them."""
    names = {name for entry in entries() for name in entry.get("install_layout", [])}
    finder = Packages([CORPUS / "ros2_control_demos"])
    for name in names:
        share = tmp_path / "share" / name
        share.mkdir(parents=True)
        source = finder.find(name)
        shutil.copy(source / "package.xml", share)
        for child in (source / "description").iterdir():
            (share / child.name).symlink_to(child)
    return tmp_path / "share"


@pytest.mark.slow
def test_same_bytes_as_stock_xacro_and_every_element_has_its_origin(
    installed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    failures, compared = [], 0
    for entry in entries():
        path = str(CORPUS / entry["entry"])
        packages = Packages([installed] if "install_layout" in entry else [], path)
        arguments = entry.get("args", {})
        wanted = stock(path, arguments, packages, monkeypatch)
        try:
            expanded = expand(path, arguments=arguments, packages=packages, run_xacro=True)
        except UrdfkitError as error:
            if wanted is not None:
                failures.append(f"{path}: stock xacro expands it, we say: {error}")
            continue
        if wanted is None:
            failures.append(f"{path}: stock xacro refuses it")
            continue
        compared += 1
        if expanded.xml != wanted:
            failures.append(f"{path}: other bytes")
        failures += [f"{path}: {place}" for place in misplaced(expanded)]
    assert failures == []
    assert compared > 300


@pytest.mark.slow
def test_recovery_changes_nothing_where_nothing_is_wrong() -> None:
    failures = []
    for entry in entries():
        path = CORPUS / entry["entry"]
        if entry["status"] != "model" or path.suffix == ".urdf":
            continue
        strict = expand(path, arguments=entry.get("args"))
        lenient = expand_leniently(path, arguments=entry.get("args"), add_prefixes=False)
        if lenient.faults:
            failures.append(f"{path}: {lenient.faults[0].message}")
        if lenient.xml != strict.xml:
            failures.append(f"{path}: other bytes")
    assert failures == []


@pytest.mark.slow
def test_recovery_survives_everything() -> None:
    failures = []
    for entry in entries():
        expanded = expand_leniently(CORPUS / entry["entry"])
        if (
            (entry["status"] in ("xacro-fails", "not-xml"))
            and not expanded.faults
            and not entry["entry"].endswith(".urdf")
        ):
            failures.append(f"{entry['entry']}: no fault")
        failures += [f"{entry['entry']}: {f}" for f in expanded.faults if f.kind == "other" and "xacro" in f.message]
    assert failures == []


@pytest.mark.slow
def test_what_check_urdf_and_pinocchio_load_loads() -> None:
    failures = []
    for entry in entries():
        if entry["status"] != "model":
            continue
        try:
            robot = load(CORPUS / entry["entry"], arguments=entry.get("args"))
        except UrdfkitError as error:
            if entry["loads"]:
                failures.append(str(error))
            continue
        if (len(robot.links), len(robot.joints)) != (entry["links"], entry["joints"]):
            failures.append(f"{entry['entry']}: {len(robot.links)} links, {len(robot.joints)} joints")
    assert failures == []
