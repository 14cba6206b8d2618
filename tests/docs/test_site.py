"""The site builds without warnings: links, anchors, spelling; every command, rule and public name has a page."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import urdfkit
from urdfkit.cli import COMMANDS
from urdfkit.errors import UsageError
from urdfkit.lint.catalogue import page as rule_page
from urdfkit.lint.catalogue import rules
from urdfkit.lint.engine import settings

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
def test_the_strict_build_has_every_page(tmp_path: Path) -> None:
    pytest.importorskip("mkdocstrings")
    pytest.importorskip("numba")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    done = subprocess.run(
        [*command, "--config-file", str(ROOT / "docs/site/mkdocs.yml")],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT), "NO_MKDOCS_2_WARNING": "1"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    reference = tmp_path / "reference"
    assert {page.stem for page in (reference / "commands").glob("*.html")} == {"index", *COMMANDS}
    assert {page.stem for page in (reference / "rules").glob("*.html")} == {"index", *(rule.code for rule in rules())}
    names = {*urdfkit.__all__} - {"__version__"}
    assert {page.stem for page in (reference / "api").glob("*.html") if "." not in page.stem} == {"index", *names}
    assert 'id="example"' in (reference / "rules/I503.html").read_text("utf-8")
    lint = (reference / "commands/lint.html").read_text("utf-8")
    assert all(f"<code>{option}</code>" in lint for option in ("--fix", "--select", "--baseline"))
    for notebook in (ROOT / "docs/notebooks").glob("*.ipynb"):
        cells = json.loads(notebook.read_text("utf-8"))["cells"]
        page = (tmp_path / f"notebooks/{notebook.stem}.html").read_text("utf-8")
        plots = sum("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", ()))
        assert page.count('alt="Plot of the cell above"') == plots
        assert len(list((tmp_path / "notebooks").glob(f"{notebook.stem}-*.png"))) == plots
        assert page.count(' highlight">') >= sum(cell["cell_type"] == "code" for cell in cells)
        assert (tmp_path / f"notebooks/{notebook.stem}.ipynb").is_file()
        assert f"notebooks/{notebook.stem}.html" in (tmp_path / "guides/notebook.html").read_text("utf-8")
    index = json.loads((tmp_path / "search/search_index.json").read_text("utf-8"))
    assert index["config"]["separator"] == search_separator()
    titles = {entry["title"] for entry in index["docs"]}
    assert {rule_page(rule).partition("\n")[0].removeprefix("# ") for rule in rules()} <= titles
    assert (tmp_path / "javascripts/copy_commands.js").is_file()
    start = (tmp_path / "index.html").read_text("utf-8")
    assert "javascripts/copy_commands.js" in start
    assert '<div class="language-console highlight">' in start
    assert "The same seed and the same calls give bit-identical results." in (
        reference / "api/Simulator.html"
    ).read_text("utf-8")


def search_separator() -> str:
    """Return the regular expression that divides the texts and the queries of the site's search into tokens."""
    settings = yaml.load((ROOT / "docs/site/mkdocs.yml").read_text("utf-8"), yaml.BaseLoader)
    return str(next(plugin["search"] for plugin in settings["plugins"] if "search" in plugin)["separator"])


def test_the_search_finds_rules_and_methods_by_name() -> None:
    def tokens(text: str) -> list[str]:
        return [token for token in re.split(search_separator(), text) if token]

    for rule in rules():
        assert rule.code in tokens(rule_page(rule).partition("\n")[0])
    assert tokens("urdfkit.Simulator.run(seconds)") == ["urdfkit", "Simulator", "run", "seconds"]
    assert tokens('"package://robot/mesh.stl"') == ["package", "robot", "mesh", "stl"]
    assert tokens("use_sim_time: 0.25") == ["use_sim_time", "0.25"]


CONSOLE = """# a comment
$ urdfkit lint robot.urdf
robot.urdf:3:5: error: $ is no prompt here
$ urdfkit sim run robot.urdf \\
    --for 5 \\
> --quiet
> output
"""


@pytest.mark.node
def test_the_copy_button_of_a_console_block_copies_its_commands() -> None:
    program = "const {commandsOf} = require(process.argv[1]); const texts = JSON.parse(process.argv[2]);"
    program += "console.log(JSON.stringify(texts.map(commandsOf)))"
    script, texts = str(ROOT / "docs/site/copy_commands.js"), json.dumps([CONSOLE, "only output\n"])
    done = subprocess.run(["node", "-e", program, script, texts], capture_output=True, text=True, check=True)
    commands = "urdfkit lint robot.urdf\nurdfkit sim run robot.urdf \\\n    --for 5 \\\n--quiet"
    assert json.loads(done.stdout) == [commands, ""]


def test_the_page_of_settings_lists_each_and_its_example_is_valid(tmp_path: Path) -> None:
    page = (ROOT / "docs/configuration.md").read_text("utf-8")
    example = re.search(r"^```toml title=\"urdfkit.toml\"\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    assert example is not None
    file = tmp_path / "project/urdfkit.toml"
    file.parent.mkdir()
    (tmp_path / "common_ws/src").mkdir(parents=True)
    file.write_text(example[1])
    assert settings.read(file).indent == 4
    for table in ("lint", "format"):
        file.write_text(f"[{table}]\nqqqqqqqq = 1\n")
        with pytest.raises(UsageError, match="the settings are") as refused:
            settings.read(file)
        listed = str(refused.value).partition("the settings are ")[2].split(", ")
        rows = page.partition(f"## Settings of `[{table}]`")[2].partition("\n## ")[0]
        assert re.findall(r"^\| `([\w-]+)` \|", rows, re.MULTILINE) == listed
        assert all(re.search(rf"^{name} = |^\[lint\.{name}\]", example[1], re.MULTILINE) for name in listed)
