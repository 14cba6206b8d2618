"""Settings in files."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.errors import UsageError
from urdfkit.lint.engine.settings import LintSettings, find, read

WHOLE = """[lint]
target = "ros2"
select = ["E", "T"]
ignore = ["J413"]
exclude = ["third_party/*"]
package-path = ["."]
baseline = "known.json"
arguments = {use_camera = true, length = 0.5, name = "a"}
[lint.per-file-ignores]
"urdf/made" = ["E008"]
"""


def test_every_setting_is_read_and_paths_start_at_the_file(tmp_path):
    file = tmp_path / "urdfkit.toml"
    file.write_text(WHOLE)
    settings = read(file)
    assert (settings.target, settings.select, settings.ignore) == ("ros2", ("E", "T"), ("J413",))
    assert settings.package_path == (tmp_path,)
    assert settings.baseline == tmp_path / "known.json"
    assert settings.arguments == {"use_camera": "true", "length": "0.5", "name": "a"}
    assert settings.per_file == {"urdf/made": ("E008",)}
    assert settings.matches(tmp_path / "urdf" / "made" / "a.urdf", "urdf/made")
    assert settings.matches(tmp_path / "third_party" / "a" / "b.urdf", "third_party/*")
    assert not settings.matches(tmp_path / "urdf" / "a.urdf", "urdf/made")
    assert not settings.matches(tmp_path.parent / "a.urdf", "*")


def test_pyproject_has_them_in_a_table_of_its_own(tmp_path):
    file = tmp_path / "pyproject.toml"
    file.write_text('[project]\nname = "x"\n' + WHOLE.replace("[lint", "[tool.urdfkit.lint"))
    assert read(file).target == "ros2"


def test_the_nearest_file_counts_and_the_repository_is_the_end(tmp_path):
    inner = tmp_path / "a" / "b"
    inner.mkdir(parents=True)
    (tmp_path / "urdfkit.toml").write_text('[lint]\ntarget = "gz"\n')
    (tmp_path / "a" / "pyproject.toml").write_text("[project]\n")
    assert find(inner).target == "gz"
    assert find(inner / "robot.urdf").target == "gz"
    (tmp_path / "a" / "pyproject.toml").write_text('[tool.urdfkit.lint]\ntarget = "ros1"\n')
    assert find(inner).target == "ros1"
    (inner / ".git").mkdir()
    assert find(inner) == LintSettings()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[lnt]\n", "unknown setting `lnt`; did you mean `lint`?"),
        ("[lint]\nselct = []\n", "unknown setting `lint.selct`; did you mean `select`?"),
        ("[lint]\nselect = 'E'\n", "`lint.select` must be a list, not 'E'"),
        ("[lint]\nselect = [1]\n", "`lint.select` must be a list of strings, not of 1"),
        ("[lint]\ntarget = ['gz']\n", "`lint.target` must be a string"),
        ("[lint.per-file-ignores]\na = 'E'\n", "`lint.per-file-ignores.a` must be a list of codes"),
        ("[lint.arguments]\na = []\n", "`lint.arguments.a` must be a single value"),
        ("[lint]\npackage-path = ['nowhere']\n", "no such folder"),
        ("lint = 3\n", "`lint` must be a table, not 3"),
        ("[lint\n", "is not valid TOML"),
        ("[lint]\nselect = ['E0O1']\n", "`lint.select` E0O1: unknown rule; did you mean `E0"),
        ("[lint]\nignore = ['Q']\n", "`lint.ignore` Q: unknown rule"),
        ("[lint.per-file-ignores]\na = ['E', 'Q7']\n", "`lint.per-file-ignores.a` Q7: unknown rule"),
        ("[lint]\ntarget = 'gzz'\n", "`lint.target` gzz: unknown target; did you mean `gz"),
    ],
)
def test_what_is_not_known_is_reported_in_one_line(tmp_path, text, message):
    file = tmp_path / "urdfkit.toml"
    file.write_text(text)
    with pytest.raises(UsageError, match=r"urdfkit\.toml") as caught:
        read(file)
    assert message in str(caught.value)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(UsageError, match="no such file"):
        read(Path(tmp_path / "none.toml"))
