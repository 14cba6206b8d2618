"""What `urdfkit new package` writes builds with the real tools, and needs what it was told."""

import re
import xml.etree.ElementTree as ElementTree

import pytest

from urdfkit.cli import main
from urdfkit.lint import lint

KINDS = ("plain", "description", "gazebo", "control", "bringup")


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def new(name, *options):
    return main(["new", "package", name, "--into", "src", *options, "--yes"])


@pytest.mark.catkin
def test_catkin(workspace, debian):
    for kind in KINDS:
        assert new(f"scout_{kind}", "--kind", kind, "--ros", "noetic", "--depends", "std_msgs,roscpp,nav_msgs") == 0
    assert "found 0 problems" in debian("catkin_lint -W2 --strict --offline src")
    debian("catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    found = debian(". install/setup.bash; for p in plain bringup; do rospack find scout_$p; done")
    assert f"{workspace}/install/share/scout_bringup" in found
    assert (workspace / "install/share/scout_description/launch/display.launch").is_file()


@pytest.mark.colcon
def test_colcon(workspace, debian):
    assert new("base", "--ros", "humble") == 0
    for kind in KINDS:
        assert new(f"scout_{kind}", "--kind", kind, "--depends", "base") == 0
    assert "6 packages finished" in debian("colcon build")
    assert (workspace / "install/scout_gazebo/share/scout_gazebo/config/bridge.yaml").is_file()
    found = debian(". install/setup.sh && echo $GZ_SIM_RESOURCE_PATH")
    assert f"{workspace}/install/scout_description/share" in found


@pytest.mark.parametrize("ros", ["humble", "jazzy", "kilted", "lyrical", "noetic"])
@pytest.mark.parametrize("kind", KINDS)
def test_it_says_what_it_needs_and_lints_clean(workspace, kind, ros):
    assert new(f"scout_{kind}", "--kind", kind, "--ros", ros, "--depends", "nav_msgs", "--depends", "tf2,nav_msgs") == 0
    folder = workspace / f"src/scout_{kind}"
    manifest = ElementTree.parse(folder / "package.xml").getroot()
    needs = [element.text for element in manifest if element.tag in ("depend", "exec_depend")]
    assert needs.count("nav_msgs") == needs.count("tf2") == 1
    for path in folder.rglob("*"):
        assert not re.search(r"@[a-z_]+@", path.name + (path.read_text() if path.is_file() else "")), path
        if path.suffix == ".py":
            compile(path.read_text(), str(path), "exec")
    if kind == "description":
        assert [str(finding) for finding in lint([folder])] == []


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--kind", "descripton"], "did you mean `description`?"),
        (["--depends", "Nav-Msgs"], "did you mean `nav_msgs`?"),
        (["--depnds", "a"], "did you mean `--depends`?"),
        (["--ros", "jazy"], "did you mean `jazzy`?"),
    ],
)
def test_misspelt_options_of_new_package_name_the_nearest(workspace, capsys, options, says):
    assert new("scout", *options) == 2
    assert says in capsys.readouterr().err
    assert list((workspace / "src").iterdir()) == []
