import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.errors import UsageError
from urdfkit.scaffold import check_package_name, sanitised
from urdfkit.scaffold.templates.names import check_world_name


@pytest.mark.parametrize("name", ["scout", "r2d2", "a1", "my_robot_2"])
def test_good_names(name):
    assert check_package_name(name) == name


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("Scout", "scout"),
        ("MyRobot", "my_robot"),
        ("my-robot", "my_robot"),
        ("my robot", "my_robot"),
        ("my__robot", "my_robot"),
        ("robot_", "robot"),
        ("_robot", "robot"),
        ("2wheels", "robot_2wheels"),
        ("rüstig", "rustig"),
        ("Fußgänger", "fussganger"),
        ("src/scout", "scout --into src"),
        ("../Evil", "evil"),
        ("../evil", "evil"),
        ("a/b", "a_b"),
        ("x", "x_robot"),
        ("", "robot"),
        ("@name@", "name"),
        ("$(rm -rf)", "rm_rf"),
    ],
)
def test_bad_names_and_the_nearest_good_one(name, near):
    with pytest.raises(UsageError, match=f"did you mean `{near}`"):
        check_package_name(name)


def test_suffix_is_not_brought_along():
    with pytest.raises(UsageError, match="`_description` is appended automatically; did you mean `scout`"):
        check_package_name("scout_description", suffixes=("_gazebo", "_description"))


def test_too_long():
    with pytest.raises(UsageError, match="has 61 characters; use at most 60"):
        check_package_name("a" * 61)


@given(st.text())
def test_the_nearest_name_is_a_good_one(name):
    near = sanitised(name)
    assert re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", near)
    assert check_package_name(near) == near
    assert sanitised(near) == near


@pytest.mark.parametrize("name", ["w", "Lab", "room_2", "x__y", "house_"])
def test_names_of_worlds(name):
    assert check_world_name(name) == name


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("lab.sdf", "lab"),
        ("Lab.world", "Lab"),
        ("my lab", "my_lab"),
        ("2nd", "world_2nd"),
        ("", "world"),
        ("büro", "buro"),
        ("worlds/lab.sdf", "lab --into worlds"),
        ("worlds/2", "worlds_2"),
    ],
)
def test_no_names_of_worlds(name, near):
    with pytest.raises(UsageError, match=f"is not a valid world name: .*did you mean `{near}`"):
        check_world_name(name)


@given(st.text())
def test_the_nearest_name_of_a_world_is_one(name):
    try:
        assert check_world_name(name) == name
    except UsageError as error:
        near = re.search("did you mean `(.*)`", str(error))[1].partition(" --into")[0]
        assert check_world_name(near) == near
