"""``urdfkit licenses``: versions and licences of the installed dependencies, and a software bill of materials."""

from __future__ import annotations

import json
from typing import Any

from urdfkit.cli.installation.distributions import licence, required, spdx_expression

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from importlib.metadata import Distribution


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    output = parser.add_mutually_exclusive_group()
    output.add_argument("--json", action="store_true", help="print one JSON value")
    output.add_argument("--sbom", action="store_true", help="print a software bill of materials: CycloneDX 1.5, JSON")
    parser.epilog = "examples:\n  urdfkit licenses\n  urdfkit licenses --sbom > sbom.json"


def run(arguments: argparse.Namespace) -> int:
    """Print the dependencies."""
    packages = required()
    if arguments.sbom:
        print(json.dumps(_sbom(packages), indent=1))
        return 0
    rows = [(str(each.metadata["Name"]), each.version, licence(each)) for each in packages]
    if arguments.json:
        print(json.dumps([{"name": name, "version": version, "license": of} for name, version, of in rows], indent=1))
        return 0
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    for name, version, of in rows:
        print(f"{name:{widths[0]}}  {version:{widths[1]}}  {of}")
    return 0


def _sbom(packages: list[Distribution]) -> dict[str, Any]:
    """Return the bill of materials; the keys are those of CycloneDX 1.5 (https://cyclonedx.org/docs/1.5/json/)."""
    components = []
    for package in packages:
        name, version = str(package.metadata["Name"]), package.version
        expression = spdx_expression(package)
        found = [{"expression": expression}] if expression else [{"license": {"name": licence(package)}}]
        place = f"pkg:pypi/{name.lower().replace('_', '-')}@{version}"
        components.append(
            {"type": "library", "bom-ref": place, "name": name, "version": version, "purl": place, "licenses": found}
        )
    own = [each for each in components if each["name"] == "urdfkit"]
    main = {**own[0], "type": "application"} if own else {"type": "application", "name": "urdfkit"}
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": main},
        "components": [each for each in components if each["name"] != "urdfkit"],
    }
