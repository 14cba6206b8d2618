"""The wheel, the source distribution, and the files of a release."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tarfile
import zipfile
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import jsonschema
import pytest
import yaml
from packaging.licenses import canonicalize_license_expression

import urdfkit
from urdfkit.cli import main
from urdfkit.cli.installation.distributions import BY_LICENCE_FILE, licence, required

ROOT = Path(__file__).parents[2]


def tracked(*folders: str) -> set[str]:
    """Return the files of folders that git knows, without ignored ones."""
    listed = subprocess.run(["git", "ls-files", *folders], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(listed.stdout.splitlines())


@pytest.mark.git
@pytest.mark.slow
def test_the_wheel_holds_all_data_and_no_tests(tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-d", str(tmp_path)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (wheel,), (sdist,) = tmp_path.glob("*.whl"), tmp_path.glob("*.tar.gz")
    subprocess.run([sys.executable, "-m", "twine", "check", "--strict", wheel, sdist], check=True, capture_output=True)
    names = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    names = {name for name in names if not name.startswith("urdfkit/machine_code/")}  # of `make wheel`
    data = {f"urdfkit/_data/{name}" for name in tracked("templates", "robots")}
    assert names == tracked("urdfkit") | data
    assert "urdfkit/py.typed" in names
    with tarfile.open(sdist) as archive:
        inside = {name.partition("/")[2] for name in archive.getnames()}
    assert {"LICENSE", "README.md", "CHANGELOG.md", "pyproject.toml", "tests/conftest.py", "Makefile"} <= inside
    assert not [name for name in inside if name.startswith((".github", "editors", "docs/images"))]


def test_the_metadata_agree() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["version"] == urdfkit.__version__
    text = (ROOT / "pyproject.toml").read_text()
    assert '"Typing :: Typed"' in text
    tested = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text())["jobs"]["python"]["strategy"]
    named = re.findall(r'"Programming Language :: Python :: (3\.\d+)"', text)
    assert tested["matrix"]["python"] == named
    for name in ("SECURITY.md", "CODE_OF_CONDUCT.md", "CITATION.cff", "LICENSE"):
        assert (ROOT / name).is_file()
    for form in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"):
        assert {"name", "description", "body"} <= yaml.safe_load(form.read_text()).keys()


def test_upper_bounds_have_a_reason() -> None:
    bounded = set(re.findall(r'"([\w-]+)>=[^",;]*,<', (ROOT / "pyproject.toml").read_text()))
    page = (ROOT / "docs" / "releasing.md").read_text()
    reasons = {"xacro": "xacro: the output", "cyclonedds": "Cyclone DDS: the interface", "mkdocs": "MkDocs: version 2"}
    assert bounded == set(reasons)
    assert all(reason in page for reason in reasons.values())


def test_the_page_of_the_installation_states_the_purpose_of_each_core_dependency() -> None:
    (core,) = re.findall(r"^dependencies = \[(.*)\]$", (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    rows = re.findall(r"^\| (\w+)[^|]* \| [^|\d]+", (ROOT / "docs/install.md").read_text(), re.MULTILINE)
    assert {name.lower() for name in re.findall(r'"([\w-]+)', core)} <= {row.lower() for row in rows}


def test_licences_of_the_table_agree_with_the_licence_files() -> None:
    for name, expression in BY_LICENCE_FILE.items():
        try:
            files = distribution(name).files or ()
        except PackageNotFoundError:
            continue
        text = " ".join(next(each for each in files if re.match("LICEN[CS]E|COPYING", each.name)).read_text().split())
        assert ("to endorse or promote products" in text) is ("BSD-3-Clause" in expression), name
        assert ("Redistribution and use in source" in text) is ("BSD" in expression), name


def test_licenses_and_the_bill_of_materials(capsys: pytest.CaptureFixture[str]) -> None:
    packages = {each.metadata["Name"].lower(): each for each in required()}
    assert {"xacro", "pyyaml"} <= packages.keys()
    assert "pytest" not in packages
    assert licence(packages["pyyaml"]) == "MIT"
    for each in packages.values():
        found = licence(each)
        assert canonicalize_license_expression(found) == found, each.metadata["Name"]
        assert found != "any-OSI"
    assert [licence(packages[name]) for name in ("xacro", "apsw", "numba")] == [
        "BSD-3-Clause",
        "Zlib OR any-OSI",
        "BSD-2-Clause",
    ]
    assert main(["licenses", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert ("PyYAML", distribution("pyyaml").version) in {(row["name"], row["version"]) for row in rows}
    assert main(["licenses", "--sbom"]) == 0
    bill = json.loads(capsys.readouterr().out)
    jsonschema.validate(bill, SCHEMA)
    assert {each["name"].lower() for each in bill["components"]} == packages.keys() - {"urdfkit"}


SCHEMA = {
    "type": "object",
    "required": ["bomFormat", "specVersion", "version", "metadata", "components"],
    "properties": {
        "bomFormat": {"const": "CycloneDX"},
        "specVersion": {"const": "1.5"},
        "components": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["type", "name", "version", "purl", "licenses"],
                "properties": {"purl": {"pattern": "^pkg:pypi/[^@]+@.+"}, "type": {"const": "library"}},
            },
        },
    },
}
"""The keys of CycloneDX 1.5 that are written (https://cyclonedx.org/docs/1.5/json/)."""


def test_the_version_report_names_what_a_bug_report_needs(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    monkeypatch.setenv("HOME", str(Path(sys.executable).parents[1]))
    assert main(["--version", "--verbose"]) == 0
    text = capsys.readouterr().out
    assert text.startswith(f"urdfkit {urdfkit.__version__}\nPython {sys.version.split()[0]}")
    assert f"  xacro {distribution('xacro').version}\n" in text
    assert "ROS_DISTRO=jazzy" in text
    assert ", ~/" in text
    assert str(Path(sys.executable).parents[1]) not in text
