"""The house holds: rooms know only the rooms below them, the light path stays light, modules stay readable."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import urdfkit
from tests.import_graph import cycles, import_graph
from tests.private_access import private_accesses

ROOT = Path(urdfkit.__file__).parent
HEAVY = ("numpy", "scipy", "pinocchio", "trimesh", "meshcat", "tornado", "numba", "rosbags", "torch")


def modules_after(code: str) -> set[str]:
    """Run `code` in a fresh interpreter and return the top-level modules it left loaded."""
    script = f"import sys\n{code}\nprint('\\n'.join(sorted({{name.split('.')[0] for name in sys.modules}})))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    "module", ["urdfkit", "urdfkit.cli", "urdfkit.description", "urdfkit.lint", "urdfkit.scaffold", "urdfkit.resources"]
)
def test_light_rooms_import_nothing_heavy(module: str) -> None:
    assert modules_after(f"import {module}").isdisjoint(HEAVY)


def test_the_plain_lint_path_loads_nothing_heavy(tmp_path: Path) -> None:
    model = tmp_path / "arm.urdf.xacro"
    model.write_text(
        '<?xml version="1.0"?>\n'
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n  <link name="base"/>\n</robot>\n'
    )
    code = (
        "import contextlib, io\nfrom urdfkit.cli import main\n"
        f"with contextlib.redirect_stdout(io.StringIO()):\n    assert main(['lint', {str(model)!r}]) == 0"
    )
    # Importing typing takes as long as parsing the robot.
    assert (modules_after(code) - modules_after("")).isdisjoint((*HEAVY, "typing"))


def test_import_urdfkit_adds_only_a_handful_of_modules() -> None:
    bare = modules_after("")
    assert len(modules_after("import urdfkit") - bare) <= 3


def owners(package: str) -> set[str]:
    found = set()
    for path in ROOT.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if any(
            line.split()[1].split(".")[0] == package
            for line in text.splitlines()
            if line.strip().startswith(("import ", "from ")) and len(line.split()) > 1
        ):
            found.add(path.relative_to(ROOT).parts[0])
    return found


@pytest.mark.parametrize(
    ("package", "rooms"),
    [
        ("pinocchio", {"kinematics", "sim"}),
        ("meshcat", {"view"}),
        ("xacro", {"description"}),
        ("torch", {"kinematics"}),
    ],
)
def test_a_dependency_is_used_only_in_its_rooms(package: str, rooms: set[str]) -> None:
    assert owners(package) <= rooms


@pytest.mark.slow
def test_no_modules_import_each_other() -> None:
    graph = import_graph(ROOT)
    assert len(graph) > 800
    assert sum(map(len, graph.values())) > 3000
    assert cycles(graph) == []


PLANTED = {
    "at_run_time": {"a": "from house.b import b", "b": "def b():\n    from house import c", "c": "import house.a"},
    "for_types": {"a": "from house.b import B", "b": "if TYPE_CHECKING:\n    from house.a import A"},
    "by_a_name_of_a_lazy_package": {
        "room/__init__": "if TYPE_CHECKING:\n    from house.a import A as B\n\ndef __getattr__(name): ...",
        "a": "import house.b",
        "b": "from house.room import B",
    },
}


@pytest.mark.parametrize("modules", PLANTED.values(), ids=PLANTED)
def test_modules_that_import_each_other_are_found(tmp_path: Path, modules: dict[str, str]) -> None:
    for name, text in {"__init__": "", **modules}.items():
        path = tmp_path / "house" / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    expected = [f"house.{name}" for name in modules if "/" not in name]
    assert cycles(import_graph(tmp_path / "house")) == [expected]


def test_modules_that_import_one_way_are_no_cycle(tmp_path: Path) -> None:
    (tmp_path / "house").mkdir()
    for name, text in {"__init__": "", "a": "import house.b\nimport house.c", "b": "import house.c", "c": ""}.items():
        (tmp_path / "house" / f"{name}.py").write_text(text)
    assert cycles(import_graph(tmp_path / "house")) == []


MOST = 16
"""Modules of one folder, `__init__.py` counted out; a family of rules has as many as the field has defects."""


def test_no_folder_holds_too_many_modules() -> None:
    folders = {path for path in ROOT.rglob("*") if path.is_dir() and path.parent != ROOT / "lint" / "rules"}
    counts = {
        f"{folder.relative_to(ROOT)}/*{suffix}": len([p for p in folder.glob(f"*{suffix}") if p.name != "__init__.py"])
        for folder in (*folders, ROOT)
        for suffix in (".py", ".js")
    }
    assert counts["description/*.py"] > 0
    assert {folder: count for folder, count in counts.items() if count > MOST} == {}


def test_every_package_says_what_it_is_for() -> None:
    silent = []
    for path in ROOT.rglob("__init__.py"):
        text = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
        if path.parent.parent != ROOT / "lint" / "rules" and len(re.findall(r"\.(?=\s|$)", text)) < 2:
            silent.append(str(path.parent.relative_to(ROOT)))
    assert silent == []


def test_no_module_is_too_long() -> None:
    long = {str(p.relative_to(ROOT)): n for p in ROOT.rglob("*.py") if (n := len(p.read_text().splitlines())) > 400}
    assert not long


PARSERS = {"search", "match", "fullmatch", "findall", "finditer", "sub"}
"""Functions of `re` that read a text by a pattern."""
SPLITTERS = {"split", "rsplit", "partition", "rpartition", "startswith", "endswith", "removeprefix", "removesuffix"}
"""Methods of a text that read a part of it."""
SUGGESTIONS = ("Suggestion", "did_you_mean", "near_path")


def parsed_messages(code: str) -> list[int]:
    """Return the lines that read a part of the message of an error, finding or repair from its text."""
    lines = list[int]()
    if re.search(r"\.\s*message\b", code) is None:  # most modules, whose syntax tree takes a second together
        return lines
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            texts = node.args if node.func.attr in PARSERS else [node.func.value] if node.func.attr in SPLITTERS else []
            lines += [text.lineno for text in texts if isinstance(text, ast.Attribute) and text.attr == "message"]
    return lines


def formatted_suggestions(code: str) -> list[int]:
    """Return the lines that format a suggestion into a text, which is no `DefectMessage` then."""
    if not any(name in code for name in SUGGESTIONS):
        return []
    texts = [node for node in ast.walk(ast.parse(code)) if isinstance(node, ast.JoinedStr)]
    calls = [part.value for text in texts for part in text.values if isinstance(part, ast.FormattedValue)]
    return [
        call.lineno
        for call in calls
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in SUGGESTIONS
    ]


def test_messages_keep_their_parts() -> None:
    found = {}
    for path in ROOT.rglob("*.py"):
        name, text = path.relative_to(ROOT).as_posix(), path.read_text("utf-8")
        if not name.startswith("lint/report/"):
            found[name] = parsed_messages(text)
        if name.startswith(
            ("lint/", "description/urdf/", "description/xacro/evaluation/", "description/xacro/recovery/")
        ):
            found[name] = found.get(name, []) + formatted_suggestions(text)
    assert {name: lines for name, lines in found.items() if lines} == {}


@pytest.mark.parametrize(
    "use",
    [
        'name = finding.message.split("`")[1]',
        'names = re.findall("`(.*?)`", finding.message)',
        'effect = repair.message.partition("; ")[2]',
    ],
)
def test_a_message_that_is_read_back_is_found(use: str) -> None:
    assert parsed_messages(use) == [1]


def test_a_suggestion_in_a_formatted_text_is_found() -> None:
    assert formatted_suggestions('message = f"no `{name}`{did_you_mean(name, names)}"') == [1]
    assert formatted_suggestions('message = f"no `{name}`" + did_you_mean(name, names)') == []


def test_every_public_name_resolves() -> None:
    for name in urdfkit.__all__:
        assert getattr(urdfkit, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = urdfkit.nonsense


COMMUNITY = ("CITATION.cff", "CODE_OF_CONDUCT.md", "SECURITY.md")


def test_top_level_holds_what_the_house_draws() -> None:
    allowed = {"urdfkit", "templates", "robots", "tests", "docs", "editors", "pyproject.toml"}
    customary = {"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "Makefile", *COMMUNITY}
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT.parent, capture_output=True, text=True, check=False, env={**os.environ}
    )
    if listed.returncode:
        pytest.skip("not a git checkout")
    top = {line.split("/")[0] for line in listed.stdout.splitlines()}
    assert {name for name in top if not name.startswith(".")} <= allowed | customary


OF_LIBRARIES = {
    "bridges/ros2/cyclonedds_node.py": {"_ref"},
    "bridges/ros2/cyclonedds_types.py": {"_ref"},
    "cli/completion.py": {"_actions", "_SubParsersAction"},
    "cli/kinematics/ik/__init__.py": {"_negative_number_matcher"},
    "cli/kinematics/reach.py": {"_negative_number_matcher"},
    "cli/new/__init__.py": {"_option_string_actions"},
    "cli/new/template_options.py": {"_actions", "_option_string_actions"},
    "cli/parser.py": {"_actions", "_option_string_actions", "_SubParsersAction"},
    "cli/sim/run_options.py": {"_negative_number_matcher"},
    "compilation/codegen.py": {"_internal_codegen"},
    "compilation/native.py": {"_final_module", "_get_compiled_object"},
    "compilation/native_entry.py": {"_getvalue"},
    "compilation/whole_program.py": {
        *("_check_llvm_bugs", "_engine", "_final_module", "_get_module_for_linking", "_linking_libraries"),
        *("_make_finalizer", "_reload_init", "_reset_overloads"),
    },
    "meshes/mesh_appearance.py": {"_cache"},
    "view/server/page_socket.py": {"_abort", "_receive_frame"},
}
"""Private attributes of argparse, numba, trimesh and tornado, which have no public equivalent."""

PUBLIC = {"_exit", "_asdict"}
"""Documented functions of the standard library: os._exit and namedtuple._asdict."""


@pytest.mark.slow
def test_no_private_attribute_is_used_outside_its_package() -> None:
    accesses = private_accesses(ROOT)
    libraries = {(file, name) for file, names in OF_LIBRARIES.items() for name in names}
    assert libraries <= set(accesses)  # an exception that is no longer needed is removed here
    # xacro has no interface for what the package reads of it.
    others = [each for each in accesses if each[1] not in PUBLIC and not each[0].startswith("description/xacro/")]
    assert [each for each in others if each not in libraries] == []


@pytest.mark.parametrize(
    ("use", "found"),
    [
        ("robot._pose", ["_pose"]),
        ("from house.room.a import _helper", ["_helper"]),
        ("robot.pose", []),
        ("robot.__dict__", []),
        (
            "class B:\n    def __init__(self): self._own = 1\n    def same(self, b): return self._own == b._own",
            [],
        ),
    ],
)
def test_a_private_attribute_of_another_package_is_found(tmp_path: Path, use: str, found: list[str]) -> None:
    for name, text in {"room/a": "class A:\n    _pose = 1\n\ndef _helper(): ...", "hall/b": use}.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / f"{name}.py").write_text(text)
    assert private_accesses(tmp_path) == [("hall/b.py", name) for name in found]


AMBIGUOUS = {
    *("Ground", "Surface"),  # of SDF, and of the engine
    *("Node", "Scope", "Tag", "TooLarge"),  # of xacro, and others
    *("Collision", "Fix", "Ros2Control"),  # of descriptions, findings and commands, and of plugins
}
"""Names of classes that have two meanings."""


@pytest.mark.slow
def test_class_names_have_one_meaning() -> None:
    counts: dict[str, int] = {}
    for path in ROOT.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef):
                counts[node.name] = counts.get(node.name, 0) + 1
    assert {name for name, count in counts.items() if count > 1} == AMBIGUOUS
