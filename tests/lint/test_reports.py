"""Findings as SARIF, JUnit and annotations of GitHub."""

from __future__ import annotations

import json
from email.message import Message
from pathlib import Path
from urllib.parse import unquote, urlparse
from xml.etree import ElementTree

import jsonschema
import pytest

from urdfkit.description.xml.source import Span
from urdfkit.lint.engine.run import Outcome, run
from urdfkit.lint.finding import Finding
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options
from urdfkit.lint.report.github import as_github
from urdfkit.lint.report.junit import as_junit
from urdfkit.lint.report.sarif import as_sarif

TEXT = """<xacro:macro name="part" params="n">
  <link name="${n}" kind="x"/>
</xacro:macro>
<xacro:part n="a"/>
<part n="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>"""


@pytest.fixture
def outcome(write) -> Outcome:
    write("urdf/clean one.urdf", '<robot name="c"><link name="a"/></robot>')
    write("urdf/bäd.xacro", TEXT)
    return run(find_entries(["urdf"]), Options())


def an_object(required: str, **properties: object) -> dict:
    return {
        "type": "object",
        "required": required.split(),
        "properties": properties,
        "additionalProperties": False,
    }


# What we write of SARIF 2.1.0, each object with what the standard (sections in brackets) requires and allows of it.
COUNT = {"type": "integer", "minimum": 1}
WORDS = {"type": "string", "minLength": 1}
MESSAGE = an_object("text", text=WORDS)  # 3.11
REGION = an_object("startLine", startLine=COUNT, startColumn=COUNT, endLine=COUNT, endColumn=COUNT)  # 3.30
FILE = an_object("uri", uri={"type": "string", "format": "uri-reference"}, uriBaseId=WORDS)  # 3.4
PLACE = an_object("artifactLocation", artifactLocation=FILE, region=REGION)  # 3.29
LOGICAL = an_object("name", name=WORDS, kind=WORDS)  # 3.33
LOCATION = an_object(
    "physicalLocation", physicalLocation=PLACE, message=MESSAGE, logicalLocations={"type": "array", "items": LOGICAL}
)  # 3.28
REPLACEMENT = an_object(
    "deletedRegion", deletedRegion=REGION, insertedContent=an_object("text", text={"type": "string"})
)  # 3.57
CHANGE = an_object(
    "artifactLocation replacements",
    artifactLocation=FILE,
    replacements={"type": "array", "minItems": 1, "items": REPLACEMENT},
)  # 3.56
FIX = an_object(
    "artifactChanges", description=MESSAGE, artifactChanges={"type": "array", "minItems": 1, "items": CHANGE}
)  # 3.55
LEVEL = {"enum": ["none", "note", "warning", "error"]}
RESULT = an_object(
    "message",
    ruleId=WORDS,
    ruleIndex={"type": "integer", "minimum": 0},
    level=LEVEL,
    message=MESSAGE,
    locations={"type": "array", "items": LOCATION},
    relatedLocations={"type": "array", "uniqueItems": True, "items": LOCATION},
    fixes={"type": "array", "uniqueItems": True, "items": FIX},
)  # 3.27
RULE = an_object(
    "id",
    id=WORDS,
    name=WORDS,
    shortDescription=MESSAGE,
    help=an_object("text", text=WORDS, markdown=WORDS),
    helpUri=WORDS,
    defaultConfiguration=an_object("", level=LEVEL),
)  # 3.49
DRIVER = an_object(
    "name", name=WORDS, semanticVersion=WORDS, rules={"type": "array", "uniqueItems": True, "items": RULE}
)  # 3.19
RUN = an_object(
    "tool",
    tool=an_object("driver", driver=DRIVER),
    originalUriBaseIds={"type": "object", "additionalProperties": an_object("uri", uri=WORDS)},
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    results={"type": "array", "items": RESULT},
)  # 3.14
LOG = an_object(
    "version runs", **{"$schema": WORDS}, version={"const": "2.1.0"}, runs={"type": "array", "items": RUN}
)  # 3.13


def test_sarif_is_what_the_standard_asks_and_has_every_finding(outcome):
    log = json.loads(as_sarif(outcome.findings))
    jsonschema.Draft7Validator(LOG).validate(log)
    (found,) = log["runs"]
    results = found["results"]
    assert [result["ruleId"] for result in results] == [finding.code for finding in outcome.findings]
    rules = found["tool"]["driver"]["rules"]
    assert all(rules[result["ruleIndex"]]["id"] == result["ruleId"] for result in results)
    base = found["originalUriBaseIds"]["SRCROOT"]["uri"]
    assert Path(unquote(urlparse(base).path)) == Path.cwd()
    for result, finding in zip(results, outcome.findings, strict=True):
        place = result["locations"][0]["physicalLocation"]
        assert unquote(place["artifactLocation"]["uri"]) == finding.file
        assert place["region"]["startLine"] == finding.line
        assert len(result.get("relatedLocations", [])) == len(finding.expansions)
        assert ("fixes" in result) is (finding.fix is not None)


def test_sarif_of_nothing_and_of_files_elsewhere(write):
    jsonschema.Draft7Validator(LOG).validate(json.loads(as_sarif([])))
    far = Finding("I503", "x", "error", "m", Span("/opt/a b.urdf", 1, 1, 1, 2))
    log = json.loads(as_sarif([far]))
    jsonschema.Draft7Validator(LOG).validate(log)
    place = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "file:///opt/a%20b.urdf"}


def test_sarif_links_the_pages_of_rules_on_the_published_site(outcome, monkeypatch):
    def rules() -> list[dict[str, str]]:
        return json.loads(as_sarif(outcome.findings))["runs"][0]["tool"]["driver"]["rules"]

    published = Message()
    monkeypatch.setattr("importlib.metadata.metadata", lambda name: published)
    assert not any("helpUri" in rule for rule in rules())
    published["Project-URL"] = "Source, https://example.org/source"
    published["Project-URL"] = "Documentation, https://example.org/docs/"
    assert [rule["helpUri"] for rule in rules()] == [
        f"https://example.org/docs/reference/rules/{rule['id']}.html" for rule in rules()
    ]
    jsonschema.Draft7Validator(LOG).validate(json.loads(as_sarif(outcome.findings)))


def test_junit_has_a_suite_for_each_file_and_a_failure_for_each_error_and_warning(outcome):
    root = ElementTree.fromstring(as_junit(outcome.findings, outcome.files))
    suites = {suite.get("name"): suite for suite in root}
    assert set(suites) == {"urdf/bäd.xacro", "urdf/clean one.urdf"}
    serious = [finding for finding in outcome.findings if finding.severity != "note"]
    assert root.get("failures") == str(len(serious)) == str(len(root.findall(".//failure")))
    assert len(root.findall(".//skipped")) == len(outcome.findings) - len(serious)
    assert [case.get("name") for case in suites["urdf/clean one.urdf"]] == ["no finding"]
    for suite in root:
        assert suite.get("tests") == str(len(suite))
    failure = root.find(".//failure")
    assert failure is not None
    assert failure.get("type") in ("error", "warning")
    assert failure.text is not None
    assert failure.text.startswith("urdf/bäd.xacro:")


def test_junit_holds_no_character_that_xml_lacks():
    finding = Finding("N302", "x", "error", 'a\x00<"&>\x1b\ud800 b', Span("f\x01.urdf", 1, 1, 1, 2), help="l\n<2>")
    root = ElementTree.fromstring(as_junit([finding], ["f\x01.urdf"]))
    failure = root.find(".//failure")
    assert failure is not None
    assert failure.get("message") == 'a\ufffd<"&>\ufffd\ufffd b'


def test_github_annotations_are_commands_of_one_line(outcome):
    lines = as_github(outcome.findings).splitlines()
    assert len(lines) == len(outcome.findings)
    assert all(line.startswith(("::error ", "::warning ", "::notice ")) for line in lines)
    finding = Finding("N302", "x", "note", "50 %\nof a: b, c", Span("a,b:c.urdf", 2, 3, 4, 5))
    where = "file=a%2Cb%3Ac.urdf,line=2,endLine=4,col=3,title=N302 x"
    assert as_github([finding]) == f"::notice {where}::50 %25%0Aof a: b, c"
