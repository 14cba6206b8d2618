from pathlib import Path

import pytest

from urdfkit import resources
from urdfkit.errors import ResourceError, UsageError
from urdfkit.resources import find_model, robot_names, robots_dir, templates_dir
from urdfkit.robot_files import models_in

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def urdf(path: Path, name: str = "bot") -> Path:
    return write(path, f'<?xml version="1.0"?>\n<robot name="{name}"><link name="base"/></robot>')


def package(folder: Path, *robots: str) -> Path:
    write(folder / "package.xml", f"<package><name>{folder.name}</name></package>")
    for robot in robots:
        urdf(folder / "urdf" / f"{robot}.urdf", robot)
    return folder


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Stand in an empty folder, with no home above it."""
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_shipped_folders_exist():
    assert (robots_dir() / "simpleton").is_dir()
    assert (templates_dir() / "robot" / "template.toml").is_file()
    assert "simpleton" in robot_names()


def test_installed_data_are_found_without_a_checkout(tmp_path, monkeypatch):
    write(tmp_path / "site" / "urdfkit" / "resources.py", "")
    data = tmp_path / "site" / "urdfkit" / "_data" / "robots"
    data.mkdir(parents=True)
    (tmp_path / "site" / "robots").mkdir()  # somebody else's package of that name
    monkeypatch.setattr(resources, "__file__", str(tmp_path / "site" / "urdfkit" / "resources.py"))
    assert robots_dir() == data.resolve()
    with pytest.raises(ResourceError, match="installed without its templates"):
        templates_dir()


def test_a_robot_with_variants(tmp_path, monkeypatch):
    """The folder's name means the model of that name; a model next to it goes by its own."""
    urdf = tmp_path / "rover" / "rover_description" / "urdf"
    for name in ("rover", "rover_with_arm"):
        write(urdf / f"{name}.urdf.xacro", f'<robot name="{name}"><link name="a"/></robot>')
    write(urdf / "wheel.xacro", "<robot/>")
    monkeypatch.setattr(resources, "robots_dir", lambda: tmp_path)
    assert robot_names() == ["rover", "rover_with_arm"]
    for name in robot_names():
        assert find_model([name]).path == urdf / f"{name}.urdf.xacro"
        assert find_model([name]).name == name


def test_robot_by_name(here):
    found = find_model(["simpleton"])
    assert found.path == robots_dir() / "simpleton/simpleton_description/urdf/simpleton.urdf.xacro"
    assert found.name == "simpleton"
    assert found.arguments == {}


def test_suffixes_in_capital_letters(here):
    path = urdf(here / "robots" / "R2.URDF", "r2")
    assert find_model(["robots"]).path == path
    assert models_in(here) == [path]


def test_file_and_xacro_arguments(here):
    path = urdf(here / "my bot.urdf", "r2")
    found = find_model(["a:=1", "my bot.urdf", "b:=x:=y", "c:="], package_path=["."])
    assert found.path == path
    assert found.name == "r2"
    assert found.arguments == {"a": "1", "b": "x:=y", "c": ""}
    assert found.package_path == (here,)


def test_name_that_is_computed_gives_way_to_the_stem(here):
    write(here / "arm.urdf.xacro", f'<robot name="$(arg name)" {XACRO}><link name="l"/></robot>')
    assert find_model(["arm.urdf.xacro"]).name == "arm"


@pytest.mark.parametrize("quoting", ["name='r'", 'a="x>y" name = "r"', f'{XACRO}\n  name="r"'])
def test_robot_tag_however_it_is_written(here, quoting):
    write(here / "r.xacro", f'<!-- <robot name="no"> --><robot {quoting}><link name="l"/></robot>')
    assert find_model(["r.xacro"]).name == "r"


def test_package_folder_has_its_entry(here):
    folder = package(here / "bot_description")
    entry = write(
        folder / "urdf/bot.urdf.xacro",
        f'<robot name="bot" {XACRO}><xacro:include filename="$(find bot_description)/urdf/wheel.xacro"/></robot>',
    )
    write(
        folder / "urdf/wheel.xacro", f'<robot name="wheel" {XACRO}><link name="w"/></robot>'
    )  # included, though named
    write(folder / "urdf/materials.xacro", '<robot name="materials"><material name="red"/></robot>')  # no links
    write(folder / "urdf/macros.xacro", f"<robot {XACRO}><xacro:macro name='m'/></robot>")  # no name
    urdf(folder / "urdf/bot.urdf")  # made from the xacro
    assert models_in(folder) == [entry]
    assert find_model(["bot_description"]).path == entry


def test_model_without_a_name_is_found_when_it_is_alone(here):
    path = write(here / "p/r.urdf", "<robot><link name='a'/></robot>")
    assert find_model(["p"]).path == path


def test_skipped_folders(here):
    folder = package(here / "p", "bot")
    for skipped in ("build", "install", "test", ".hidden"):
        urdf(folder / skipped / "other.urdf")
    urdf(folder / "off" / "other.urdf")
    write(folder / "off" / "COLCON_IGNORE", "")
    assert [path.name for path in models_in(folder)] == ["bot.urdf"]


def test_left_out_in_a_package(here, monkeypatch):
    package(here / "ws/src/bot_description", "bot")
    monkeypatch.chdir(here / "ws/src/bot_description/urdf")
    assert find_model([]).name == "bot"
    assert find_model(["k:=v"]).arguments == {"k": "v"}


def test_left_out_in_a_neighbour_package_and_in_the_workspace(here, monkeypatch):
    package(here / "ws/src/bot_description", "bot")
    package(here / "ws/src/bot_gazebo")
    monkeypatch.chdir(here / "ws")
    assert find_model([]).name == "bot"
    monkeypatch.chdir(here / "ws/src/bot_gazebo")
    assert find_model([]).name == "bot"


def test_left_out_with_several_lists_them(here):
    package(here / "src/p", "one", "two")
    with pytest.raises(ResourceError, match=r"2 robot descriptions .*src/p/urdf/one\.urdf, src/p/urdf/two\.urdf"):
        find_model([])


def test_long_lists_are_cut(here):
    package(here / "p", *(f"r{i:02}" for i in range(20)))
    with pytest.raises(ResourceError, match=r"r07\.urdf and 12 more$"):
        find_model(["p"])


def test_left_out_with_none(here):
    with pytest.raises(ResourceError, match=r"no robot is named, and there is no robot description .*simpleton"):
        find_model([])


def test_home_is_not_searched_from_below(here, monkeypatch):
    urdf(here / "home/stray.urdf")
    write(here / "home/package.xml", "")
    (here / "home/work").mkdir()
    monkeypatch.chdir(here / "home/work")
    with pytest.raises(ResourceError, match="no robot is named"):
        find_model([])


def test_a_folder_called_as_a_robot_but_without_a_model(here):
    (here / "simpleton").mkdir()
    assert find_model(["simpleton"]).path.is_relative_to(robots_dir())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["simpletn"], "no robot, file or folder `simpletn`; did you mean `simpleton`?"),
        (["Simpleton"], "no robot, file or folder `Simpleton`; did you mean `simpleton`?"),
        (["scuot.urdf"], "no such file or folder: scuot.urdf; did you mean `scout.urdf`?"),
        (["./scuot.urdf"], "no such file or folder: ./scuot.urdf; did you mean `scout.urdf`?"),
        (["desciption/urdf/bot.urdf"], "no such file or folder: desciption/urdf/bot.urdf; did you mean `description`?"),
        (
            ["description/bot.udrf"],
            "no such file or folder: description/bot.udrf; did you mean `description/bot.urdf`?",
        ),
        (["empty"], "no robot description (.urdf or .xacro with <robot name=…>) in folder empty"),
        (["hall.world"], "hall.world is an SDF file, not a robot description; a world goes after --world"),
    ],
)
def test_what_resolves_to_nothing_names_the_nearest(here, words, message):
    urdf(here / "scout.urdf")
    urdf(here / "description/bot.urdf")
    (here / "empty").mkdir()
    write(here / "hall.world", "<sdf/>")
    with pytest.raises(ResourceError) as caught:
        find_model(words)
    assert str(caught.value) == message


def test_nothing_near_lists_the_robots(here):
    with pytest.raises(ResourceError, match=r"no robot, file or folder `xyzzy`; bundled robots: .*simpleton"):
        find_model(["xyzzy"])


def test_usage_errors(here):
    with pytest.raises(UsageError, match="one ROBOT at a time, not 2: a b; xacro arguments are key:=value"):
        find_model(["a", "b"])
    with pytest.raises(UsageError, match="`:=5` has no key"):
        find_model(["simpleton", ":=5"])
    with pytest.raises(ResourceError, match="--package-path: no such folder: nowhere"):
        find_model(["simpleton"], package_path=["nowhere"])


def test_resources_stay_light():
    import subprocess
    import sys

    code = "import sys, urdfkit.resources as r; r.find_model(['simpleton']); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numpy", "xml.dom.minidom", "xacro", "pinocchio"} & set(loaded)


def test_what_is_neither_a_file_nor_a_folder_is_called_so() -> None:
    with pytest.raises(ResourceError, match=r"^/dev/null is neither a file nor a folder$"):
        find_model(["/dev/null"])
