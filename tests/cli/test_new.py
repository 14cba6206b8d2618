import io
import re
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.resources import find_model


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Stand in an empty folder, not on a terminal, without a git identity."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("GIT_CONFIG_NOSYSTEM", "1")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
    return tmp_path


class Terminal(io.StringIO):
    def isatty(self):
        return True


def type_in(monkeypatch, *lines):
    """Be on a terminal where these lines are typed."""
    monkeypatch.setattr("sys.stdin", Terminal("".join(f"{line}\n" for line in lines)))
    monkeypatch.setattr("sys.stderr", Terminal())
    return sys.stderr


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["jazzy", "kilted", "noetic"])
def test_result_lints_clean_and_loads(place, capsys, ros):
    assert main(["new", "robot", "scout", "--ros", ros]) == 0
    assert sorted(path.name for path in place.glob("s*")) == ["scout_bringup", "scout_description", "scout_gazebo"]
    assert [str(finding) for finding in lint([place])] == []
    robot = load(find_model([str(place / "scout_description")]).path)
    assert robot.name == "scout"
    assert [link.name for link in robot.roots()] == ["base_footprint"]
    assert {"left_wheel_joint", "right_wheel_joint", "caster_joint"} <= set(robot.joint_by_name)
    printed = capsys.readouterr().out
    assert "urdfkit sim teleop scout_description" in printed
    assert ("roslaunch scout_bringup scout.launch" in printed) == (ros == "noetic")


@pytest.mark.slow
def test_no_placeholder_survives(place):
    for ros in ("jazzy", "noetic"):
        assert main(["new", "robot", "scout", "--ros", ros, "--into", ros]) == 0
    for path in place.rglob("*"):
        assert "@" not in path.name
        if path.is_file():
            assert not re.search(r"@[a-z_]+@", path.read_text()), path


@pytest.mark.slow
def test_dimensions_arrive(place):
    options = ["--wheel-radius", "0.1", "--base-length", "0.6", "--mass", "12", "--wheel-separation", "0.5"]
    assert main(["new", "robot", "big", *options, "--into", "src/robots"]) == 0
    robot = load(find_model(["src/robots/big_description"]).path)
    assert robot.joint_by_name["left_wheel_joint"].origin.xyz == (0, 0.25, 0)
    assert robot.joint_by_name["base_joint"].origin.xyz == (0, 0, 0.1)
    assert robot.link_by_name["base_link"].inertial.mass == 12


@pytest.mark.slow
def test_maintainer_and_license(place):
    options = ["--maintainer", "Ada O'Hara", "--email", "ada@example.org", "--license", "MIT"]
    assert main(["new", "robot", "scout", *options]) == 0
    for package in ("scout_description", "scout_gazebo", "scout_bringup"):
        manifest = (place / package / "package.xml").read_text()
        assert '<maintainer email="ada@example.org">Ada O\'Hara</maintainer>' in manifest
        assert "<license>MIT</license>" in manifest
        assert re.search(r"Copyright \(c\) 20\d\d Ada O'Hara", (place / package / "LICENSE").read_text())


@pytest.mark.slow
def test_the_maintainer_comes_from_git(place, monkeypatch):
    config = place / "gitconfig"
    config.write_text("[user]\n\tname = Grace\n\temail = grace@example.org\n")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(config))
    assert main(["new", "robot", "scout"]) == 0
    assert '"grace@example.org">Grace<' in (place / "scout_gazebo/package.xml").read_text()


def test_an_address_of_git_that_ros_refuses_is_left_out(place, monkeypatch):
    config = place / "gitconfig"
    config.write_text("[user]\n\tname = Grace\n\temail = grace@laptop\n")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(config))
    assert main(["new", "package", "scout_tools"]) == 0
    assert '"maintainer@example.com">Grace<' in (place / "scout_tools/package.xml").read_text()


@pytest.mark.slow
def test_quiet_prints_what_was_written_only(place, capsys):
    assert main(["new", "robot", "scout", "-q"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "scout_bringup  8 files",
        "scout_description  19 files",
        "scout_gazebo  11 files",
        ".  .devcontainer, .github, .gitignore, .pre-commit-config.yaml, LICENSE, README.md, pytest.ini",
    ]


@pytest.mark.slow
def test_what_to_do_next_can_be_pasted(place, capsys):
    assert main(["new", "robot", "scout", "--ros", "none", "--into", "my ws", "--yes"]) == 0
    assert "  urdfkit lint 'my ws'/scout_description\n" in capsys.readouterr().out
    assert main(["new", "sensor", "imu", "--into", "my ws/scout_description"]) == 0
    assert "  urdfkit view 'my ws/scout_description'\n" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["jazzy", "none"])
def test_packages_inside_a_package_get_a_word(place, capsys, ros):
    assert main(["new", "robot", "scout", "--ros", ros, "--yes"]) == 0
    assert "inside" not in capsys.readouterr().err
    again = ["new", "robot", "inner", "--ros", ros, "--yes", "--into", "scout_description/urdf"]
    assert main(again) == 0
    assert "written inside the package scout_description" in capsys.readouterr().err
    command = re.search("`(urdfkit new robot --from [^`]*)`", (place / "scout_description/README.md").read_text())
    assert main([*command[1].split()[1:], "--yes"]) == 0
    assert (place / "another_folder/scout_description").is_dir()
    assert "inside" not in capsys.readouterr().err


def test_a_new_package_next_to_src_prints_a_note(place, capsys):
    (place / "src").mkdir()
    assert main(["new", "package", "scout_bringup", "--yes"]) == 0
    assert "use --into src" in capsys.readouterr().err
    assert main(["new", "package", "scout_bringup", "--yes", "--into", "src"]) == 0
    assert "src" not in capsys.readouterr().err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
@pytest.mark.parametrize("thing", ["package", "world"])
def test_what_is_written_is_there_though_it_cannot_be_printed(place, thing):
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-m", "urdfkit", "new", thing, "mine", "--yes"]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60)
    assert done.returncode == 2
    assert done.stderr == (
        "urdfkit: all files were written to ., but the report could not be printed: No space left on device\n"
    )
    assert list(place.glob("mine*"))


@pytest.mark.slow
def test_questions_on_a_terminal(place, monkeypatch):
    typed = ["Scout", "scout", "lunar", "noetic", "", "", "", "", "", "0.1"]
    shown = type_in(monkeypatch, *typed, *[""] * 10)
    assert main(["new", "robot"]) == 0
    text = shown.getvalue()
    assert "did you mean `scout`" in text
    assert "`lunar` is not available" in text
    assert "Radius of a wheel or ball [m] = 0.075: " in text
    assert "Drive (diff, skid, ackermann, omni, none) = diff: " in text
    assert "axle" not in text  # that is for other drives
    assert (place / "scout_gazebo/launch/scout.launch").is_file()
    assert '"wheel_radius" value="0.1"' in (place / "scout_description/urdf/drive.xacro").read_text()


def test_contradicting_answers_repeat_the_question_at_once(place, monkeypatch):
    given = ["--no-picture", "--ros", "none", "--drive", "diff", "--base-length", "0.4", "--base-width", "0.3"]
    typed = ["scout", "", "9000", "9", "0.5", "0.1", "", "0.1", "0.5"]
    shown = type_in(monkeypatch, *typed, *[""] * 10)
    assert main(["new", "robot", *given]) == 0
    text = shown.getvalue()
    for told in (
        "(--mass 9000 kg, at most 240 kg)\nMass of the base [kg] = 5: ",
        "(--wheel-radius 0.5 m, at most 0.32 m)\nRadius of a wheel",
        "(--wheel-separation 0.1 m, at least 0.34 m)\nDistance between",
    ):
        assert told in text
    recipe = (place / "scout_description/urdfkit-new.toml").read_text()
    assert "mass = 9\nwheel_radius = 0.1\n" in recipe
    assert "wheel_separation = 0.5\n" in recipe


def test_where_no_answer_would_do_it_ends_at_once(place, monkeypatch):
    given = ["--wheel-radius", "0.5", "--drive", "diff", "--base-length", "0.4", "--base-width", "0.3"]
    shown = type_in(monkeypatch, *["scout", *[""] * 10])
    assert main(["new", "robot", *given]) == 2
    assert "--wheel-radius must be at most 0.8 × --base-length; nothing was written" in shown.getvalue()
    assert list(place.iterdir()) == []


@pytest.mark.slow
def test_options_replace_questions(place, monkeypatch):
    shown = type_in(monkeypatch, *[""] * 20)
    assert main(["new", "robot", "scout", "--ros", "noetic", "--mass", "3"]) == 0
    assert "ROS" not in shown.getvalue()
    assert "Mass of the base" not in shown.getvalue()
    assert "Length of the base" in shown.getvalue()


@pytest.mark.slow
def test_yes_skips_the_questions(place, monkeypatch):
    shown = type_in(monkeypatch)
    assert main(["new", "robot", "scout", "--yes"]) == 0
    assert shown.getvalue() == ""


def test_end_of_input_writes_nothing(place, monkeypatch):
    shown = type_in(monkeypatch, "scout")
    assert main(["new", "robot"]) == 2
    assert "end of input before the last answer; nothing was written" in shown.getvalue()
    assert list(place.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["robot"], "name of the robot is missing; pass NAME"),
        (["robot", "My Robot"], "not a valid ROS package name: .*; did you mean `my_robot`?"),
        (["robot", "scout_description"], "did you mean `scout`?"),
        (["robot", "my", "scout"], "unrecognized arguments: scout; did you mean `my_scout`?"),
        (
            ["robot", "--name", "scout"],
            "unrecognized arguments: --name; it is a positional argument: urdfkit new robot NAME",
        ),
        (["robot", "src/scout"], "did you mean `scout --into src`?"),
        (
            ["robot", "scout", "--ros", "foxy"],
            "--ros `foxy` is not available; the nearest is `humble`; choose from: humble, jazzy, kilted",
        ),
        (["robot", "scout", "--ros", "noetc"], "did you mean `noetic`?"),
        (
            ["robot", "scout", "--drive", "skdi"],
            r"--drive `skdi` is not available; did you mean `skid`\? The choices are diff, skid, ack",
        ),
        (
            ["robot", "scout", "--drive", "omni", "--wheel-torque", "2"],
            "--wheel-torque requires --drive diff or ackermann",
        ),
        (["robot", "scout", "--wheel-base", "2"], "--wheel-base requires --drive skid or ackermann or omni"),
        (
            ["robot", "car", "--drive", "omni", "--wheel-base", "0.1"],
            "the wheels would touch each other: --wheel-base",
        ),
        (["robot", "scout", "--drive", "skid", "--wheel-base", "0.5"], "the robot would hardly turn"),
        (
            ["robot", "scout", "--drive", "skid", "--base-height", "0.2", "--wheel-base", "0.25"],
            "the robot would tip over when it starts",
        ),
        (["robot", "scout", "--arm", "8"], "--arm `8` is not available; choose from: none, 3, 4, 5, 6, 7"),
        (["robot", "scout", "--sensor", "lidra"], "--sensor `lidra` is not available; did you mean `lidar`"),
        (["robot", "scout", "--sensor", "imu", "--sensor", "imu"], "--sensor `imu` is repeated; write each value"),
        (["robot", "scout", "--sensor", "gps", "--mass", "2"], "too light for these sensors: .* at least 4 kg"),
        (
            ["robot", "scout", "--sensor", "lidar", "--base-length", "0.2"],
            "the base has no room for the sensors: --base-length",
        ),
        (["robot", "scout", "--gripper"], "--gripper requires --arm 3 or 4 or 5 or 6 or 7"),
        (["robot", "scout", "--wheel-raduis", "1"], "did you mean `--wheel-radius`?"),
        (["robot", "scout", "--wheel-radius", "5in"], r"--wheel-radius `5in` is not a number \(in m, cm, mm\)"),
        (["robot", "scout", "--mass", "400"], "denser than any material: --mass"),
        (["robot", "scout", "--mass", "0.01"], "lighter than any material: --mass"),
        (["robot", "scout", "--mass", "-1"], "--mass -1 kg is out of range"),
        (["robot", "scout", "--wheel-separation", "0.2"], "the wheels would overlap the base: --wheel-separation"),
        (["robot", "scout", "--wheel-torque", "9"], "the robot would tip over when it starts or brakes"),
        (["robot", "scout", "--email", "nobody"], "--email `nobody` cannot be written"),
        (["robot", "scout", "--ros", "noetic", "--sim", "gz"], "between ROS 1 and Gazebo Sim; use --sim classic, or"),
        (["robot", "scout", "--sim", "classic"], "never released for this distribution; use --sim gz, or --ros humble"),
        (
            ["robot", "scout", "--ros", "none", "--sim", "classic"],
            "are part of ROS; use --sim gz, or --ros noetic or humble",
        ),
        (["robot", "scout", "--ros", "melodic"], "`melodic` is not available; the nearest is `noetic`"),
        (["robot", "scout", "--drive", "differential"], "`differential` is not available; the nearest is `diff`"),
        (["robot", "scout", "--yes", "--wheel-torque", "-0.1"], "--wheel-torque -0.1 N·m is out of range: 1e-06 to"),
        (["robot", "scout", "--yes", "--wheel-radius", "0.5"], r"\(--wheel-radius 0\.5 m, at most 0\.32 m\)"),
        (["robot", "scout", "--yes", "--base-length", "0.01"], r"\(--base-length 0\.01 m, at least 0\.0938 m\)"),
        (["robot", "scout", "--yes", "--mass", "1000"], r"\(--mass 1000 kg, at most 240 kg\)"),
        (["robot", "scout", "--yes", "--wheel-torque", "1e5"], r"\(--wheel-torque 1e\+05 N·m, at most [\d.]+ N·m\)"),
        (["robot", "scout", "--yes", "--arm", "5", "--payload", "50"], r"\(--payload 50 kg, at most 0\.74 kg\)"),
        (["--updat"], "new: unrecognized arguments: --updat; did you mean `--update`"),
        (["--drve", "diff"], "--drve; did you mean `urdfkit new robot NAME --drive`"),
        (["--drive", "diff"], "--drive; did you mean `urdfkit new robot NAME --drive`"),
        (["robt", "scout", "--drive", "diff"], "no kind `robt`; did you mean `robot`"),
        (["robot", "scout", "more"], "unrecognized arguments: more"),
        (["wrld", "w"], "did you mean `world`?"),
        (["robto", "r"], "no kind `robto`; did you mean `robot`"),
        ([], "pass a kind: .*robot, world"),
        (["robot", "scout", "--diff"], "--diff requires --update"),
        (["--update"], r"nothing to update in \.: no \*/urdfkit-new\.toml"),
        (["robot", "scout", "--template", "mine"], "--template: no such folder: mine"),
    ],
)
def test_errors_are_one_line_and_write_nothing(place, capsys, arguments, message):
    assert main(["new", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert captured.err.startswith("urdfkit: ")
    assert re.search(message, captured.err), captured.err
    assert list(place.iterdir()) == []


def test_nothing_is_overwritten(place, capsys):
    (place / "scout_gazebo").mkdir()
    assert main(["new", "robot", "scout"]) == 2
    assert capsys.readouterr().err == "urdfkit: scout_gazebo already exists; nothing was overwritten\n"
    assert [path.name for path in place.iterdir()] == ["scout_gazebo"]


def written(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
def test_the_same_again_from_a_file(place):
    options = ["--drive", "skid", "--sensor", "camera,lidar", "--mass", "7", "--maintainer", "Ada O'Hara, \\ 2nd"]
    assert main(["new", "robot", "scout", *options, "--into", "one"]) == 0
    kept = place / "one/scout_description/urdfkit-new.toml"
    assert 'sensor = ["lidar", "camera"]\n' in kept.read_text()
    assert "wheel_torque" not in kept.read_text()
    assert main(["new", "robot", "--from", str(kept), "--into", "two"]) == 0
    assert written(place / "one") == written(place / "two")


@pytest.mark.slow
def test_options_come_before_the_file(place):
    (place / "car.toml").write_text('name = "car"\ndrive = "skid"\nwheel_base = 0.3\nmass = 8\nsensor = ["imu"]\n')
    assert main(["new", "robot", "cart", "--from", "car.toml", "--drive", "diff"]) == 0
    robot = load(find_model(["cart_description"]).path)
    assert robot.link_by_name["base_link"].inertial.mass == 8
    assert {"imu_link", "caster"} <= set(robot.link_by_name)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (None, r"--from: no such file: a\.toml"),
        ("name = ", r"--from a\.toml: Invalid"),
        ('name = "ox"\nmass = -2\n', r"a\.toml: --mass -2 kg is out of range"),
        ('nmae = "x"\n', r"a\.toml: no question `nmae`; did you mean `name`"),
        ("mass = true\n", r"a\.toml: `mass` must be a string, a number or a list of strings"),
        ('template = "world"\n', r"is a recipe for `urdfkit new world`, not for `urdfkit new robot`"),
        ("mass = 3\n", "name of the robot is missing; pass NAME"),
    ],
)
def test_a_wrong_file_is_one_line(place, capsys, text, message):
    if text is not None:
        (place / "a.toml").write_text(text)
    assert main(["new", "robot", "--from", "a.toml"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert re.search(message, error), error
    assert [path.name for path in place.iterdir()] == ([] if text is None else ["a.toml"])


def test_the_checker_finds_what_the_linter_does(place):
    # No answer the questions allow brings a finding about, so a result is spoiled by hand.
    from urdfkit.cli.new.update import findings
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import load_template

    template = load_template(templates_dir() / "robot")
    answers = template.answers({"name": "scout"}) | {"year": "2026", "into": "."}
    template.render(answers, place)
    path = place / "scout_description/urdf/inertia.xacro"
    path.write_text(path.read_text().replace('ixx="${mass*(y*y + z*z)/12}"', 'ixx="${mass*100}"'))
    assert [fault.message[:4] for fault in findings(place) if fault.is_error] == ["X119"]


@pytest.mark.slow
def test_light_imports():
    code = (
        "import sys; from urdfkit.cli import main; main(['new', 'robot', 'scout', '-q', '--into', sys.argv[1]]);"
        "print(*sys.modules)"
    )
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-c", code, folder], capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL
        )
        assert Path(folder, "scout_gazebo").is_dir()
    assert not {"numpy", "pinocchio", "trimesh", "meshcat"} & set(done.stdout.split())


def test_joints_of_an_arm_are_given_with_the_arm(capsys):
    assert main(["new", "robot", "scout", "--dof", "5"]) == 2
    assert "did you mean `--arm`?" in capsys.readouterr().err
