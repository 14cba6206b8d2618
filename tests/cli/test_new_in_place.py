"""`urdfkit new`: files of a repository, updates in place, templates of one's own, and off to the browser."""

import io
import json
import subprocess

import pytest
import yaml

from urdfkit.cli import main

BESIDE = [".devcontainer", ".github", ".gitignore", ".pre-commit-config.yaml", "LICENSE", "README.md", "pytest.ini"]


@pytest.fixture
def place(tmp_path, monkeypatch):
    folder = tmp_path / "place"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def scout(place):
    assert main(["new", "robot", "scout", "--yes", "-q"]) == 0
    return place


def beside(folder):
    return sorted(path.name for path in folder.iterdir() if not path.name.startswith(("scout", ".git")))


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["humble", "noetic", "none"])
def test_files_of_a_repository(place, ros):
    assert main(["new", "robot", "scout", "--ros", ros, "--into", "new", "--yes", "-q"]) == 0
    new = place / "new"
    assert sorted(path.name for path in new.iterdir() if not path.name.startswith("scout")) == BESIDE
    ci = yaml.safe_load((new / ".github/workflows/ci.yml").read_text())
    assert set(ci["jobs"]) == ({"lint"} if ros == "none" else {"lint", "build"})
    container = json.loads((new / ".devcontainer/devcontainer.json").read_text())
    assert container["image"] == {"none": "mcr.microsoft.com/devcontainers/python:3.12"}.get(ros, f"ros:{ros}")
    if ros != "none":
        assert ci["jobs"]["build"]["container"] == f"ros:{ros}-ros-base"
    hooks = [
        h["id"]
        for repo in yaml.safe_load((new / ".pre-commit-config.yaml").read_text())["repos"]
        for h in repo["hooks"]
    ]
    assert "urdfkit-lint" in hooks
    assert "![scout](scout_description/docs/scout.svg)" in (new / "README.md").read_text()
    assert (new / "scout_description/docs/scout.svg").read_text().startswith("<svg")


@pytest.mark.slow
def test_in_a_folder_with_something_in_it_there_are_packages_only(place):
    (place / "mine").write_text("")
    assert main(["new", "robot", "scout", "--yes", "-q"]) == 0
    assert beside(place) == ["mine"]
    assert main(["new", "robot", "scoot", "--repository", "--yes", "-q"]) == 0
    assert set(beside(place)) == {"mine", "scoot_description", "scoot_gazebo", "scoot_bringup", *BESIDE} - {
        ".github",
        ".gitignore",
    }


@pytest.mark.slow
@pytest.mark.git
def test_in_a_fresh_clone_what_is_there_stays(place):
    subprocess.run(["git", "init", "-q"], check=True)
    (place / "README.md").write_text("mine")
    assert main(["new", "robot", "scout", "--yes", "-q"]) == 0
    assert (place / "README.md").read_text() == "mine"
    assert (place / ".github/workflows/ci.yml").is_file()
    assert main(["new", "robot", "--update", "--mass", "8", "--yes", "-q"]) == 0
    assert (place / "README.md").read_text() == "mine"
    assert not (place / "README.md.new").exists()


def test_without_a_picture(place):
    assert main(["new", "robot", "scout", "--no-picture", "--no-repository", "--yes", "-q"]) == 0
    assert sorted(path.name for path in place.iterdir()) == ["scout_bringup", "scout_description", "scout_gazebo"]
    assert not (place / "scout_description/docs").exists()
    assert "![" not in (place / "scout_description/README.md").read_text()


@pytest.mark.slow
def test_the_same_answers_give_the_same_bytes(place):
    for into in ("one", "two"):
        assert main(["new", "robot", "scout", "--sensor", "camera", "--into", into, "--yes", "-q"]) == 0
    one, two = (
        {path.relative_to(place / into): path.read_bytes() for path in (place / into).rglob("*") if path.is_file()}
        for into in ("one", "two")
    )
    assert one == two


@pytest.mark.slow
def test_update(scout, capsys):
    assert main(["new", "--update"]) == 0
    assert "nothing to update" in capsys.readouterr().err
    assert main(["new", "robot", "--update", "--mass", "8", "--diff"]) == 1
    shown = capsys.readouterr().out
    assert '-  <xacro:property name="base_mass" value="5"/>' in shown
    assert "scout_description/docs" not in shown  # it looks the same
    assert main(["new", "robot", "--update", "--mass", "8"]) == 2
    captured = capsys.readouterr()
    assert (
        "files would change; nothing was changed: use --yes to change them, --diff to print the changes" in captured.err
    )
    assert 'value="5"' in (scout / "scout_description/urdf/scout.urdf.xacro").read_text()
    (scout / "scout_description/README.md").write_text("mine")
    assert main(["new", "robot", "--update", "--mass", "8", "--yes"]) == 0
    assert "scout_description/README.md: edited by you: the new version is saved as README.md.new" in (
        capsys.readouterr().out
    )
    assert (scout / "scout_description/README.md").read_text() == "mine"
    assert 'value="8"' in (scout / "scout_description/urdf/scout.urdf.xacro").read_text()
    assert main(["lint", "."]) == 0
    assert main(["new", "--update", "--into", "scout_description"]) == 0


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.slow
@pytest.mark.parametrize(("typed", "mass"), [("y\n", "8"), ("n\n", "5"), ("\n", "5"), ("", "5")])
def test_asked_on_a_terminal(scout, monkeypatch, typed, mass):
    monkeypatch.setattr("sys.stdin", Terminal(typed))
    monkeypatch.setattr("sys.stderr", Terminal())
    assert main(["new", "robot", "--update", "--mass", "8"]) == (0 if mass == "8" else 1)
    assert f'name="base_mass" value="{mass}"' in (scout / "scout_description/urdf/scout.urdf.xacro").read_text()


@pytest.mark.slow
def test_colours(scout, capsys):
    assert main(["new", "robot", "--update", "--mass", "8", "--diff", "--color", "always"]) == 1
    assert '\x1b[31m-  <xacro:property name="base_mass" value="5"/>\x1b[0m' in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["robot", "rover", "--update"],
            "--update cannot rename packages, and these options give rover_bringup, rover_description",
        ),
        (["robot", "--update", "--mass", "1000"], "denser than any material"),
        (["robot", "--update", "--mas", "8"], "did you mean `--mass`"),
        (["robot", "--update", "--into", "nowhere"], "nothing to update in nowhere"),
        (["world", "--update"], "urdfkit-new.toml"),
    ],
)
def test_what_cannot_be_updated(scout, capsys, arguments, message):
    assert main(["new", *arguments]) == 2
    reported = capsys.readouterr().err
    assert message in reported
    assert reported.count("\n") == 1


OWN = """
summary = "a box"
recipe = "@name@/urdfkit-new.toml"
[[question]]
name = "name"
prompt = "Name"
kind = "package"
[[question]]
name = "size"
prompt = "Size"
kind = "number"
default = "1"
[[question]]
name = "colour"
prompt = "Colour"
kind = "choice"
choices = ["red", "blue"]
default = "red"
[[layer]]
folder = "all"
[[layer]]
folder = "blue"
when = { colour = ["blue"] }
[[next]]
commands = ["look at @colour@"]
"""


@pytest.fixture
def own(place):
    folder = place.parent / "template"
    for path, text in (("all/@name@/box.txt", "@size@ m"), ("blue/@name@/COLOUR", "blue"), ("template.toml", OWN)):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return folder


def test_a_template_of_ones_own(place, own, capsys):
    assert main(["new", "robot", "box", "--template", "../template", "--colour", "blue", "--yes"]) == 0
    assert "look at blue" in capsys.readouterr().out
    assert 'source = "../template"' in (place / "box/urdfkit-new.toml").read_text()
    (own / "blue/@name@/COLOUR").write_text("azure")
    assert main(["new", "--update", "--yes"]) == 0
    assert (place / "box/COLOUR").read_text() == "azure"
    assert main(["new", "robot", "--template=../template", "--update", "--size", "2", "--yes"]) == 0
    assert (place / "box/box.txt").read_text() == "2 m"
    own.rename(own.with_name("moved"))
    assert main(["new", "--update"]) == 2
    assert "the template ../template of this template does not exist: use --template DIR" in capsys.readouterr().err
    assert main(["new", "--update", "--template", "../moved"]) == 2
    both = "is a recipe for `urdfkit new robot --template ../template`, not for `urdfkit new robot --template ../moved`"
    assert both in capsys.readouterr().err


def test_a_recipe_of_a_user_template_has_the_command_to_repeat_it(place, own, capsys):
    assert main(["new", "robot", "box", "--template", "../template", "--colour", "blue", "--yes"]) == 0
    recipe = place / "box/urdfkit-new.toml"
    command = (
        recipe.read_text()
        .splitlines()[0]
        .removeprefix("# To write the same files again: urdfkit ")
        .partition(" FILE")[0]
        .split()
    )
    assert main([*command, str(recipe), "--into", "again", "--yes"]) == 0
    assert (place / "again/box/COLOUR").read_text() == "blue"
    assert main(["new", "robot", "--from", str(recipe), "--yes"]) == 2
    assert (
        "is a recipe for `urdfkit new robot --template ../template`, not for `urdfkit new robot`"
        in capsys.readouterr().err
    )


def test_help_is_of_the_template(place, own, capsys):
    with pytest.raises(SystemExit):
        main(["new", "robot", "--template", "../template", "--help"])
    shown = capsys.readouterr().out
    assert "--colour" in shown
    assert "--drive" not in shown


@pytest.mark.slow
def test_off_to_the_browser(place, monkeypatch, capsys):
    called = []
    monkeypatch.setattr("urdfkit.cli.main", lambda words: called.append(words) or 0)
    assert main(["new", "robot", "scout", "--into", "ws", "--yes", "--teleop"]) == 0
    assert called == [["sim", "teleop", "ws/scout_description"]]
    assert "next:" not in capsys.readouterr().out


def lines_of(capsys):
    return capsys.readouterr().out.splitlines()


@pytest.mark.slow
def test_what_an_edited_file_includes_is_kept(place, capsys):
    assert main(["new", "robot", "scout", "--sensor", "lidar,camera", "--no-picture", "--yes", "-q"]) == 0
    model = place / "scout_description/urdf/scout.urdf.xacro"
    edited = model.read_text().replace(
        '  <xacro:include filename="sensors/camera.xacro"/>\n', "<!-- no camera.xacro -->\n"
    )
    model.write_text(edited)
    capsys.readouterr()
    assert main(["new", "--update", "--diff", "-q"]) == 0  # what is edited is left alone
    assert main(["new", "robot", "--update", "--sensor", "", "--yes", "-q"]) == 0
    reported = lines_of(capsys)
    lidar = "scout_description/urdf/sensors/lidar"
    assert f"{lidar}.xacro: kept: scout_description/urdf/scout.urdf.xacro refers to it" in reported
    assert f"{lidar}_gazebo.xacro: kept: {lidar}.xacro refers to it" in reported
    assert "scout_description/urdf/sensors/camera.xacro: removed" in reported
    assert model.read_text() == edited
    assert main(["lint", "scout_description", "-q"]) == 0
    # Once nothing names them they go, and the folder with them.
    model.write_text(model.with_name("scout.urdf.xacro.new").read_text())
    assert main(["new", "robot", "--update", "--sensor", "", "--yes", "-q"]) == 0
    assert not (place / "scout_description/urdf/sensors").exists()
    assert main(["lint", "scout_description", "-q"]) == 0


@pytest.mark.slow
def test_an_outcome_that_would_be_broken_is_refused(place, capsys):
    assert main(["new", "robot", "scout", "--no-picture", "--yes", "-q"]) == 0
    model = place / "scout_description/urdf/scout.urdf.xacro"
    mine = '<link name="flag"><visual><geometry><sphere radius="${wheel_radius}"/></geometry></visual></link>'
    joint = '<joint name="flag_joint" type="fixed"><parent link="base_link"/><child link="flag"/></joint>'
    model.write_text(model.read_text().replace("</robot>", f"  {mine}{joint}\n</robot>"))
    before = {path: path.read_bytes() for path in place.rglob("*") if path.is_file()}
    capsys.readouterr()
    for options in (["--yes"], ["--diff"]):
        assert main(["new", "robot", "--update", "--drive", "none", "-q", *options]) == 2
        reported = capsys.readouterr()
        assert "scout_description/urdf/drive.xacro: changed" in reported.out
        assert reported.err.startswith("urdfkit: nothing was changed: the update would add errors: ")
        assert "wheel_radius" in reported.err
        assert "adapt your scout_description/urdf/scout.urdf.xacro first" in reported.err
        assert reported.err.count("\n") == 1
    # Nothing is changed; what it would be is next to it, and once that is merged the same goes.
    offered = model.with_name("scout.urdf.xacro.new")
    after = {path: path.read_bytes() for path in place.rglob("*") if path.is_file()}
    assert after.pop(offered).decode().rstrip().endswith("</robot>")
    assert after == before
    model.write_text(offered.read_text().replace("</robot>", '  <link name="flag"/>' + joint + "\n</robot>"))
    offered.unlink()
    assert main(["new", "robot", "--update", "--drive", "none", "-q", "--yes"]) == 0
    assert 'name="flag"' in model.read_text()
    assert main(["lint", "scout_description", "-q"]) == 0
    capsys.readouterr()
    assert main(["new", "--update"]) == 0
    assert "nothing to update" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("options", [["--sensor", "lidar"], ["--arm", "5", "--gripper"]])
def test_new_parts_beside_an_edited_file_wait_for_it_to_be_merged(place, capsys, options):
    assert main(["new", "robot", "scout", "--no-picture", "--yes", "-q"]) == 0
    model = place / "scout_description/urdf/scout.urdf.xacro"
    mine = (
        model.read_text()
        .replace("</robot>", '  <link name="a"/><!-- mine -->\n</robot>')
        .replace('<link name="a"/>', '<xacro:property name="mine" value="1"/>')
    )
    model.write_text(mine)
    capsys.readouterr()
    assert main(["new", "robot", "--update", *options, "-q"]) == 2  # nobody was asked
    assert not model.with_name("scout.urdf.xacro.new").exists()
    capsys.readouterr()
    assert main(["new", "robot", "--update", *options, "--yes", "-q"]) == 0
    reported = capsys.readouterr().err
    assert reported == (
        "urdfkit: to do: merge scout_description/urdf/scout.urdf.xacro.new into your scout.urdf.xacro; "
        "until then its new elements have no effect\n"
    )
    assert model.read_text() == mine
    assert main(["new", "--update"]) == 0
    assert "scout_description/urdf/scout.urdf.xacro.new remains to be merged" in capsys.readouterr().err
    model.write_text(
        model.with_name("scout.urdf.xacro.new").read_text().replace("</robot>", "  <!-- mine -->\n</robot>")
    )
    model.with_name("scout.urdf.xacro.new").unlink()
    assert main(["lint", ".", "-q"]) == 0
    capsys.readouterr()
    assert main(["new", "--update"]) == 0
    assert capsys.readouterr().err == ".: nothing to update\n"


def test_a_package_that_an_edited_file_names_is_kept_whole(place, capsys):
    assert main(["new", "robot", "picker", "--ros", "noetic", "--arm", "4", "--no-picture", "--yes", "-q"]) == 0
    for edited in ("launch/picker.launch", "package.xml"):
        path = place / "picker_gazebo" / edited
        path.write_text(f"{path.read_text()}<!-- mine -->\n")
    capsys.readouterr()
    assert main(["new", "robot", "--update", "--arm", "none", "--yes", "-q"]) == 0
    assert "picker_control/package.xml: kept: picker_gazebo/launch/picker.launch refers to it" in lines_of(capsys)
    assert (place / "picker_control/config/controllers.yaml").is_file()
    assert main(["lint", "picker_description", "-q"]) == 0


@pytest.mark.slow
def test_extensions_for_the_other_gazebo_are_reported(place, capsys):
    """A camera that `new sensor` had written for gz sim was dead in Gazebo Classic, and nobody said so."""
    assert main(["new", "robot", "scout", "--no-picture", "--yes", "-q"]) == 0
    assert main(["new", "sensor", "camera", "--into", "scout_description", "-q"]) == 0
    capsys.readouterr()
    assert main(["new", "robot", "--update", "--mass", "6", "--yes", "-q"]) == 0
    assert "was kept" not in capsys.readouterr().err
    assert main(["new", "robot", "--update", "--ros", "noetic", "--yes", "-q"]) == 0
    reported = capsys.readouterr().err
    assert (
        "urdfkit: scout_description/urdf/camera_sensor.xacro was kept, but its sensor has no plugin for Gazebo Classic"
        in reported
    )
    assert (
        "urdfkit: scout_gazebo/config/bridge.yaml was kept, but it configures a bridge, which Gazebo Classic"
        in reported
    )
    assert reported.count("was kept") == 2
    (place / "scout_gazebo/config/bridge.yaml").unlink()
    assert main(["new", "sensor", "camera", "--into", "scout_description", "--name", "other", "-q"]) == 0
    assert "libgazebo_ros_camera.so" in (place / "scout_description/urdf/camera_sensor.xacro").read_text()
    capsys.readouterr()
    assert main(["new", "robot", "--update", "--ros", "jazzy", "--yes", "-q"]) == 0
    reported = capsys.readouterr().err
    assert "are for Gazebo Classic, and Gazebo Sim ignores them" in reported


@pytest.mark.slow
def test_joints_missing_in_edited_settings_are_reported(place, capsys):
    """The model had six joints and a gripper, the controllers four and none, and nobody said so."""
    assert main(["new", "robot", "rover", "--arm", "4", "--no-picture", "--yes", "-q"]) == 0
    settings = place / "rover_control/config/controllers.yaml"
    settings.write_text(settings.read_text() + "# mine, for wrist_roll_joint\n")
    capsys.readouterr()
    assert main(["new", "robot", "--update", "--arm", "6", "--gripper", "--yes", "-q"]) == 0
    reported = capsys.readouterr().err
    assert (
        "to do: merge rover_control/config/controllers.yaml.new into your controllers.yaml; until then "
        "its controllers do not move `forearm_roll_joint`, `wrist_roll_joint`, `left_finger_joint`\n"
    ) in reported
    assert "K960 unknown controller `gripper_controller`" in reported
    settings.with_name("controllers.yaml.new").replace(settings)
    assert main(["lint", ".", "-q"]) == 0
