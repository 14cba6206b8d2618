from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.packages import discovery as room
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError
from urdfkit.resources import robots_dir

Write = Callable[[str, str], Path]


@pytest.fixture
def package(write: Write) -> Callable[[str, str], Path]:
    """Make a package folder of a name."""

    def make(folder: str, name: str) -> Path:
        return write(
            f"{folder}/package.xml", f"<package format='3'>\n  <name> {name} </name>\n</package>"
        ).parent.absolute()

    return make


Package = Callable[[str, str], Path]


def test_the_enclosing_package_its_siblings_and_its_workspace(package: Package, write: Write) -> None:
    own = package("ws/src/group/own_dir", "own")
    sibling = package("ws/src/group/sibling", "sibling")
    far = package("ws/src/other/deep/er/far", "far")
    model = write("ws/src/group/own_dir/urdf/robot/r.xacro", "")
    found = Packages(near=model, environment={})
    assert found.find("own") == own
    assert found.find("sibling") == sibling
    assert found.find("far") == far


def test_the_top_of_a_repository_is_a_workspace(package: Package, write: Write) -> None:
    Path("repo/.git").mkdir(parents=True)
    own, other = package("repo/own", "own"), package("repo/lib/other", "other")
    found = Packages(near=own / "urdf", environment={})
    assert (found.find("own"), found.find("other")) == (own, other)


@pytest.mark.parametrize("layout", ["share/p", "install/share/p", "install/p/share/p"])
def test_search_folders_may_be_install_prefixes(package: Package, layout: str) -> None:
    wanted = package(f"top/{layout}", "p")
    prefix = Path("top/install" if layout.startswith("install") else "top")
    assert Packages([prefix], environment={}).find("p") == wanted


@pytest.mark.parametrize(
    ("variable", "folder", "value"),
    [
        ("ROS_PACKAGE_PATH", "a/b/p_dir", "a"),
        ("AMENT_PREFIX_PATH", "pre/share/p", "pre"),
        ("CMAKE_PREFIX_PATH", "pre/share/p", "pre"),
        ("GZ_SIM_RESOURCE_PATH", "models/p", "models"),
        ("GAZEBO_MODEL_PATH", "models/p", "models"),
        ("IGN_GAZEBO_RESOURCE_PATH", "models/p", "models"),
    ],
)
def test_environment(package: Package, variable: str, folder: str, value: str) -> None:
    wanted = package(folder, "p")
    environment = {variable: os.pathsep.join(["/nowhere", str(Path(value).absolute())])}
    assert Packages(environment=environment).find("p") == wanted
    with pytest.raises(ResourceError, match=variable):
        Packages(environment=environment).find("nothing_like_it")


def test_models_of_gazebo(write: Write) -> None:
    write("models/table/model.config", "<model/>")
    mesh = write("models/table/meshes/top.stl", "")
    found = Packages(environment={"GZ_SIM_RESOURCE_PATH": str(Path("models").absolute())})
    assert found.resolve("model://table/meshes/top.stl", ".") == mesh.absolute()


@pytest.mark.parametrize(
    "folder",
    [".gazebo/models/table", ".gz/fuel/fuel.gazebosim.org/owner/models/table/2", ".ignition/fuel/s/o/models/table/1"],
)
def test_models_in_the_home_folder(folder: str, write: Write) -> None:
    mesh = write(f"home/{folder}/meshes/top.stl", "")
    write(f"home/{folder}/model.config", "<model/>")
    home = Path("home").absolute()
    found = Packages(environment={"HOME": str(home)})
    assert found.resolve(
        "model://Table/meshes/top.stl" if "fuel" in folder else "model://table/meshes/top.stl", "."
    ) == (mesh.absolute())


def test_the_newest_version_in_the_cache_of_fuel(write: Write) -> None:
    for version in (2, 10, 9):
        write(f"fuel/server/owner/models/table/{version}/model.config", "<model/>")
    environment = {"HOME": "/nowhere", "GZ_FUEL_CACHE_PATH": str(Path("fuel").absolute())}
    assert Packages(environment=environment).find("table").name == "10"


def test_bundled_models_are_packages_unless_the_user_has_the_model(write: Write) -> None:
    assert (Packages(environment={"HOME": "/nowhere"}).find("bookshelf") / "model.sdf").is_file()
    write("models/bookshelf/model.config", "<model/>")
    own = {"GZ_SIM_RESOURCE_PATH": str(Path("models").absolute())}
    assert Packages(environment=own).find("bookshelf") == Path("models/bookshelf").absolute()


def test_capital_letters_of_files(write: Write) -> None:
    mesh = write("Meshes/Arm.STL", "")
    found = Packages(environment={})
    with pytest.raises(ResourceError, match="no file"):
        found.resolve("meshes/arm.stl", ".")
    assert found.resolve_in_any_case("meshes/arm.stl", ".").samefile(mesh)
    assert list(found.notes.values()) == [
        "meshes/arm.stl: the name of the file is Arm.STL in Meshes; correct the capital letters"
    ]
    write("Meshes/ARM.stl", "")
    with pytest.raises(ResourceError, match="no file"):
        found.resolve_in_any_case("meshes/arm.stl", ".")


def test_robots_we_ship() -> None:
    assert robots_dir() in Packages(environment={}).find("simpleton_description").parents


def test_folders_of_the_caller_take_precedence_over_the_workspace(package: Package, write: Write) -> None:
    package("ws/src/p", "p")
    given = package("given/p", "p")
    assert Packages(["given"], near="ws/src/p/r.xacro", environment={}).find("p") == given


def test_folders_without_package_xml(write: Write) -> None:
    model = write("somewhere/robot_description/urdf/r.xacro", "")
    write("somewhere/robot_gazebo/worlds/w.world", "")
    found = Packages(near=model, environment={})
    assert found.find("robot_description") == Path("somewhere/robot_description").absolute()
    assert found.find("robot_gazebo") == Path("somewhere/robot_gazebo").absolute()


def test_ignored_and_built_folders_are_not_entered(package: Package, write: Write) -> None:
    own = package("ws/src/own", "own")
    package("ws/src/skipped/p", "p")
    write("ws/src/skipped/COLCON_IGNORE", "")
    package("ws/src/build/q", "q")
    package("ws/src/own/inner/r", "r")
    found = Packages(near=own, environment={})
    for name in "pqr":
        with pytest.raises(ResourceError):
            found.find(name)


def test_an_unknown_package_names_places_and_the_nearest(package: Package) -> None:
    own = package("ws/src/simple_description", "simple_description")
    with pytest.raises(ResourceError) as caught:
        Packages(near=own, environment={}).find("simpel_description")
    line = str(caught.value)
    assert line.startswith("no package `simpel_description` (searched: the workspace ")
    assert line.endswith("; did you mean `simple_description`?")
    assert "\n" not in line


@pytest.mark.parametrize("name", ["", "..", "a/b", "."])
def test_names_that_are_paths_are_no_packages(name: str) -> None:
    with pytest.raises(ResourceError, match="no package"):
        Packages(near=".", environment={}).find(name)


def test_looking_is_lazy_and_bounded(package: Package, monkeypatch: pytest.MonkeyPatch) -> None:
    own = package("ws/src/own", "own")
    for number in range(30):
        Path(f"ws/src/many/{number}").mkdir(parents=True)
    entered: list[Path] = []
    enter = room._enter
    monkeypatch.setattr(room, "_enter", lambda folder, found: entered.append(folder) or enter(folder, found))
    monkeypatch.setattr(room, "_MAX_FOLDERS", 10)
    found = Packages(near=own, environment={})
    assert entered == []
    assert found.find("own") == own
    assert entered == [own]
    with pytest.raises(ResourceError):
        found.find("none")
    ours = [folder for folder in entered if own.parents[1] in folder.parents or folder == own.parents[1]]
    assert len(ours) <= 20
    count = len(entered)
    with pytest.raises(ResourceError):
        found.find("none_either")
    assert len(entered) == count


def test_uris(package: Package, write: Write) -> None:
    own = package("ws/src/own", "own")
    mesh = write("ws/src/own/meshes/Arm Link.stl", "").absolute()
    model = own / "urdf" / "r.urdf"
    found = Packages(near=model, environment={})
    assert found.resolve("package://own/meshes/Arm Link.stl", model) == mesh
    assert found.resolve(f"file://{mesh}", model) == mesh
    assert found.resolve(f"file://{str(mesh).replace(' ', '%20')}", model) == mesh
    assert found.resolve(str(mesh), model) == mesh
    write("ws/src/own/urdf/r.urdf", "")
    assert found.resolve("../meshes/Arm Link.stl", model).samefile(mesh)


@pytest.mark.parametrize(
    ("uri", "message"),
    [
        ("package://own/meshes/arm.STL", "did you mean `arm.stl`?"),
        ("package://own/mesh/arm.stl", "did you mean `meshes`?"),
        ("package://own/meshes/arms.stl", "did you mean `arm.stl`?"),
        ("package://onw/meshes/arm.stl", "no package `onw`"),
        ("http://example.com/arm.stl", "from this machine only"),
        ("nothing.stl", "no file nothing.stl"),
    ],
)
def test_uris_that_mean_nothing(package: Package, write: Write, uri: str, message: str) -> None:
    own = package("ws/src/own", "own")
    write("ws/src/own/meshes/arm.stl", "")
    with pytest.raises(ResourceError) as caught:
        Packages(near=own, environment={}).resolve(uri, own / "r.urdf")
    assert message in str(caught.value)


def test_files_are_not_near_for_their_suffix_alone(package: Package, write: Write) -> None:
    own = package("ws/src/own", "own")
    write("ws/src/own/meshes/soup.stl", "")
    with pytest.raises(ResourceError) as caught:
        Packages(near=own, environment={}).resolve("package://own/meshes/gone.stl", own / "r.urdf")
    assert "did you mean" not in str(caught.value)


def test_source_folders_stand_for_what_cmake_installs(package: Package, write: Write) -> None:
    own = package("ws/src/demo", "demo")
    mesh = write("ws/src/demo/description/meshes/a.stl", "").absolute()
    found = Packages(near=own, environment={})
    assert found.resolve("package://demo/meshes/a.stl", own) == mesh
    assert found.relocate(own / "meshes" / "b.stl") is None


def test_a_last_word_in_common_makes_no_package_near():
    from urdfkit.description.packages.similar_names import near_package

    known = ("artoo_description", "husky_description", "kmsg")
    assert near_package("flir_camera_description", known) == ""
    assert "husky_description" in near_package("huksy_description", known)
    assert "husky_description" in near_package("husky_descripton", known)


@pytest.mark.parametrize("name", ["a" * 90_000, "ä" * 128])
def test_a_name_too_long_for_a_folder_is_an_unknown_package(write: Write, name: str) -> None:
    found = Packages(near=write("ws/r.urdf", ""), environment={})
    for search in (lambda: found.find(name), lambda: found.resolve(f"package://{name}/m.stl", "ws/r.urdf")):
        with pytest.raises(ResourceError, match="no package") as caught:
            search()
        assert len(str(caught.value)) < 1_000
