"""``urdfkit lint``: formats, settings, baseline, watching, cache, as options."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.processes import running
from tests.time_limit import PATIENCE, limit
from urdfkit.cli import main
from urdfkit.cli.lint.watch import watch

BAD = '<robot name="r">\n<link name="a" kind="x"/>\n<link name="b"/>\n</robot>\n'


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "p"
    (folder / "urdf").mkdir(parents=True)
    (folder / ".git").mkdir()
    build = "<export><build_type>ament_cmake</build_type></export>"
    (folder / "package.xml").write_text(f"<package><name>p</name>{build}</package>")
    (folder / "urdf" / "bad.urdf").write_text(BAD)
    monkeypatch.chdir(folder)
    return folder


def codes(capsys) -> list[str]:
    return [finding["code"] for finding in json.loads(capsys.readouterr().out)]


def test_the_other_formats(package, capsys):
    assert main(["lint", "--format", "sarif"]) == 1
    assert len(json.loads(capsys.readouterr().out)["runs"][0]["results"]) == 2
    assert main(["lint", "--format", "junit"]) == 1
    assert ElementTree.fromstring(capsys.readouterr().out).get("failures") == "1"
    assert main(["lint", "--format", "github"]) == 1
    assert capsys.readouterr().out.count("::error file=urdf/bad.urdf,line=3") == 1
    (package / "urdf" / "bad.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    assert main(["lint", "--format", "github"]) == 0
    assert capsys.readouterr().out == ""


def test_statistics_as_json(package, capsys):
    assert main(["lint", "--statistics", "--format", "json"]) == 1
    rows = json.loads(capsys.readouterr().out)
    assert {row["code"]: row["count"] for row in rows} == {"T203": 1, "E009": 1}


def test_the_guessed_target_is_reported(package, capsys):
    assert main(["lint"]) == 1
    assert "urdfkit: linted for ros2: p is built with ament_cmake\n" in capsys.readouterr().err
    for words in (["--target", "any"], ["--target", "gz"], ["-q"]):
        assert main(["lint", *words]) == 1
        assert "linted for" not in capsys.readouterr().err


def test_settings_are_found_used_and_overridden(package, capsys):
    Path("urdfkit.toml").write_text('[lint]\nignore = ["T203"]\ntarget = "any"\n')
    assert main(["lint", "--format", "json"]) == 0
    assert codes(capsys) == ["E009"]
    assert main(["lint", "--format", "json", "--no-config", "--target", "any"]) == 1
    assert codes(capsys) == ["E009", "T203"]
    Path("other.toml").write_text('[lint]\nselect = ["T"]\n')
    assert main(["lint", "--format", "json", "--config", "other.toml"]) == 1
    assert codes(capsys) == ["T203"]
    assert main(["lint", "--format", "json", "--config", "other.toml", "--select", "E"]) == 0
    assert codes(capsys) == ["E009"]
    Path("urdfkit.toml").write_text("[lint]\nignroe = []\n")
    assert main(["lint"]) == 2
    assert "did you mean `ignore`?" in capsys.readouterr().err


def test_files_may_be_left_out_and_rules_for_some_files(package, capsys):
    (package / "urdf" / "made").mkdir()
    (package / "urdf" / "made" / "other.urdf").write_text(BAD)
    Path("urdfkit.toml").write_text('[lint]\nexclude = ["urdf/made"]\n[lint.per-file-ignores]\n"*.urdf" = ["E"]\n')
    assert main(["lint", "--format", "json"]) == 1
    assert codes(capsys) == ["T203"]
    assert main(["lint", "urdf/made/other.urdf", "--format", "json"]) == 1
    assert codes(capsys) == ["T203"]
    assert main(["lint", "--diff", "--unsafe-fixes"]) == 1
    assert capsys.readouterr().out == ""


def test_a_baseline_hides_what_is_known(package, capsys):
    assert main(["lint", "--write-baseline", "known.json"]) == 0
    assert "wrote 1 finding to known.json" in capsys.readouterr().err
    assert main(["lint", "--baseline", "known.json"]) == 0
    assert "urdfkit: 1 finding matched by known.json\n" in capsys.readouterr().err
    text = BAD.replace("</robot>", '<link name="c"/></robot>')
    (package / "urdf" / "bad.urdf").write_text(f"\n\n{text}")
    assert main(["lint", "--baseline", "known.json", "--format", "json"]) == 1
    assert "c" in {finding["link"] for finding in json.loads(capsys.readouterr().out)}
    Path("urdfkit.toml").write_text('[lint]\nbaseline = "known.json"\n')
    (package / "urdf" / "bad.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    assert main(["lint"]) == 0
    assert "0 findings matched by" in (err := capsys.readouterr().err)
    assert "1 no longer occur" in err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--watch", "--fix"], "--watch cannot be combined with"),
        (["--write-baseline", "x", "--fix"], "--write-baseline cannot be combined"),
        (["--statistics", "--format", "sarif"], "--statistics supports the formats text and json"),
        (["--config", "x", "--no-config"], "--config cannot be combined with --no-config"),
        (["--jobs", "0"], "`0` is not a number of processes; use 1 or more"),
        (["--format", "sarf"], "did you mean `sarif`?"),
        (["--baseline", "none.json"], "create one with --write-baseline"),
    ],
)
def test_what_does_not_go_together(package, capsys, words, message):
    assert main(["lint", *words]) == 2
    assert message in (err := capsys.readouterr().err.splitlines()[-1])
    assert err.startswith("urdfkit: ")


def test_the_cache_may_be_left_alone(package, monkeypatch, tmp_path):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "own"))
    main(["lint", "--no-cache"])
    assert not (tmp_path / "own").exists()
    main(["lint"])
    assert len(list((tmp_path / "own").rglob("*.found"))) == 1


def test_watching_lints_again_when_a_file_changes(package):
    def until(text: str) -> None:
        for line in process.stdout:  # type: ignore[union-attr]
            if text in line:
                return
        raise AssertionError(text)

    command = [sys.executable, "-u", "-m", "urdfkit", "lint", "--watch", "--target", "any"]
    with running(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        until("Found 1 error, 1 note")
        until("waiting for changes")
        file = package / "urdf" / "bad.urdf"
        file.write_text('<robot name="r"><link name="a"/></robot>')
        until("All checks passed.")
        until("waiting for changes")
        file.write_text("<robo")
        until("waiting for changes")


def test_a_file_that_is_saved_while_it_is_linted_is_linted_again(tmp_path):
    file, seen = tmp_path / "bad.urdf", []
    file.write_text(BAD)

    def lint():
        seen.append(file.read_text())
        if len(seen) == 2:
            raise KeyboardInterrupt
        file.write_text("<robot/>")

    with pytest.raises(KeyboardInterrupt), limit(PATIENCE, "linting again"):
        watch(lint, [file])
    assert seen == [BAD, "<robot/>"]
