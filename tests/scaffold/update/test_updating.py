"""Made again in place: what was edited stays, what was not follows, and all of it or nothing."""

import shutil
from pathlib import Path

import pytest

from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold import PackageFault, create, find_recipe, load_template, read_made, read_recipe, updating


@pytest.fixture
def template(small_template):
    path = small_template / "template.toml"
    path.write_text(
        path.read_text().replace(
            "        # Keys of the template", '        recipe = "@name@/made.toml"\n        # Keys of the template', 1
        )
    )
    (small_template / "all/@name@/more.txt").write_text("more @colour@\n")
    return load_template(small_template)


@pytest.fixture
def place(template, tmp_path):
    folder = tmp_path / "place"
    create(template, template.answers({"name": "box"}) | {"year": "2026", "into": "."}, folder)
    return folder


def changed(template, place, apply=True, check=None, **given):
    """Update; return what became of which file."""
    recipe, into = find_recipe(template, place)
    made = read_made(recipe)
    answers = template.answers(read_recipe(template, recipe, given)) | {"year": made.year, "into": "."}
    with updating(template, answers, into, made, check=check) as update:
        if apply:
            update.apply()
        return {change.path.as_posix(): change.kind for change in update.changes}


def contents(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_without_a_change_there_is_none(template, place):
    before = contents(place)
    assert changed(template, place) == {}
    assert contents(place) == before


def test_what_was_not_edited_follows(template, place):
    assert changed(template, place, size="2") == {"box/src/box.txt": "replace", "box/made.toml": "replace"}
    assert (place / "box/src/box.txt").read_text().startswith("box is 2 m")
    assert changed(template, place) == {}


def test_files_come_and_go(template, place):
    assert changed(template, place, colour="blue") == {
        "box/COLOUR": "add",
        "box/made.toml": "replace",
        "box/more.txt": "replace",
        "paint/COLOUR": "add",
    }
    assert (place / "paint/COLOUR").read_text() == "blue"
    assert changed(template, place, colour="red")["box/COLOUR"] == "remove"
    assert not (place / "box/COLOUR").exists()


def test_what_was_edited_stays_and_is_reported(template, place):
    path = place / "box/src/box.txt"
    path.write_text("mine\n")
    assert changed(template, place, colour="blue")["box/more.txt"] == "replace"
    assert "box/src/box.txt" not in changed(template, place, colour="red")  # the template states what it said
    assert changed(template, place, size="3")["box/src/box.txt"] == "new_version"
    assert path.read_text() == "mine\n"
    assert path.with_name("box.txt.new").read_text().startswith("box is 3 m")
    assert changed(template, place) == {}


def test_what_was_deleted_stays_away(template, place):
    (place / "box/more.txt").unlink()
    assert changed(template, place, size="2")["box/more.txt"] == "keep"
    assert not (place / "box/more.txt").exists()


def test_an_edited_file_that_is_no_more_is_kept(template, place):
    changed(template, place, colour="blue")
    (place / "paint/COLOUR").write_text("azure")
    assert changed(template, place, colour="red")["paint/COLOUR"] == "keep"
    assert (place / "paint/COLOUR").read_text() == "azure"


def test_a_file_of_the_users_own_in_the_way(template, place):
    (place / "box/COLOUR").write_text("mine")
    assert changed(template, place, colour="blue")["box/COLOUR"] == "new_version"
    assert (place / "box/COLOUR").read_text() == "mine"


def test_a_change_of_the_template(template, place, small_template):
    (small_template / "all/@name@/more.txt").write_text("better @colour@\n")
    assert changed(template, place)["box/more.txt"] == "replace"
    assert (place / "box/more.txt").read_text() == "better red\n"


def test_shown_only(template, place):
    before = contents(place)
    assert changed(template, place, apply=False, size="2")
    assert contents(place) == before


def test_what_follows_from_answers_follows_again(template, place):
    recipe, _ = find_recipe(template, place)
    assert template.answers(read_recipe(template, recipe, {"size": "4"}))["twice"] == "8"
    changed(template, place, twice="9")
    assert template.answers(read_recipe(template, recipe, {"size": "4"}))["twice"] == "9"


def test_what_does_not_pass_changes_nothing(template, place):
    before = contents(place)
    with pytest.raises(ResourceError, match="the result has errors: bad"):
        changed(template, place, size="2", check=lambda folder: [PackageFault("bad")])
    assert contents(place) == before


def test_an_outcome_that_only_had_better_be_different_is_made_and_told(template, place):
    (place / "box/more.txt").write_text("mine")  # before it is changed the result is clean, and so is what is there

    def check(folder):
        edited = (folder / "box/more.txt").read_text() == "mine"
        size = (folder / "box/src/box.txt").read_text().split()[2]
        return [
            PackageFault(f"odd {number}", is_error=False, file="box.txt", line=1)
            for number in range(5)
            if edited and size == "2"
        ]

    recipe, into = find_recipe(template, place)
    answers = template.answers(read_recipe(template, recipe, {"size": "2"})) | {"year": "2026", "into": "."}
    with updating(template, answers, into, read_made(recipe), check=check) as update:
        assert update.warned == (*(f"odd {number} (box.txt:1)" for number in range(3)), "… and 2 more")
        update.apply()
    assert (place / "box/src/box.txt").read_text().startswith("box is 2 m")


def test_update_keeps_added_and_edited_files(template, place):
    (place / "box/src/box.txt").write_text("mine\n")
    beside = place / "box/src/box.txt.new"
    for size in ("2", "3"):  # nobody has edited it
        assert changed(template, place, size=size)["box/src/box.txt"] == "new_version"
        assert beside.read_text().startswith(f"box is {size} m")
    beside.write_text("half merged")
    changed(template, place, size="4")
    assert beside.read_text() == "half merged"
    assert (place / "box/src/box.txt.new.2").read_text().startswith("box is 4 m")


def test_what_is_refused_may_be_offered_to_merge_from(template, place):
    (place / "box/src/box.txt").write_text("mine\n")
    before = contents(place)

    def check(folder):
        edited = "mine" in (folder / "box/src/box.txt").read_text()
        return [PackageFault("bad")] if edited and "blue" in (folder / "box/more.txt").read_text() else []

    recipe, into = find_recipe(template, place)
    answers = template.answers(read_recipe(template, recipe, {"size": "2", "colour": "blue"}))
    with updating(template, answers | {"year": "2026", "into": "."}, into, read_made(recipe), check=check) as update:
        assert "would add errors: bad; adapt your box/src/box.txt first" in update.refused
        update.apply_new_versions()
    after = contents(place)
    assert after.pop("box/src/box.txt.new").startswith(b"box is 2 m")
    assert after == before


def test_parts_of_models_that_nothing_names_are_not_looked_at(template, place, small_template):
    (small_template / "blue/part.xacro").write_text("<robot/>")
    (small_template / "all/@name@/src/@name@.txt").write_text("@size@\n")
    (place / "box/src/box.txt").write_text("mine\n")

    def check(folder):
        return (
            [PackageFault("bad")]
            if (folder / "box/part.xacro").exists() and b"mine\n" in contents(folder).values()
            else []
        )

    recipe, into = find_recipe(template, place)
    answers = template.answers(read_recipe(template, recipe, {"colour": "blue"})) | {"year": "2026", "into": "."}
    with updating(template, answers, into, read_made(recipe), check=check) as update:
        assert not update.refused
        assert [path.as_posix() for path in update.unused] == ["box/part.xacro", "paint/part.xacro"]
        update.apply()
    assert (place / "box/part.xacro").is_file()


def test_a_failure_undoes_all(template, place, monkeypatch):
    before = contents(place)
    replace = Path.replace

    def full(self, target):
        if Path(target) == place / "box/made.toml" and self.parent.name == "box":
            raise OSError(28, "No space left on device")
        return replace(self, target)

    recipe, into = find_recipe(template, place)
    answers = template.answers(read_recipe(template, recipe, {"colour": "blue"})) | {"year": "2026", "into": "."}
    with updating(template, answers, into, read_made(recipe)) as update:
        monkeypatch.setattr(Path, "replace", full)
        with pytest.raises(ResourceError, match=r"nothing was changed: cannot write .*made\.toml: No space left"):
            update.apply()
        monkeypatch.setattr(Path, "replace", replace)
    assert contents(place) == before


class Killed(BaseException):
    """No code reverts the changes after it, as after SIGKILL."""


@pytest.mark.parametrize("moment", range(1, 5))
def test_a_killed_update_loses_no_file_and_the_next_one_completes_it(template, place, tmp_path, monkeypatch, moment):
    changed(template, place, colour="blue")
    whole = tmp_path / "whole"
    shutil.copytree(place, whole)
    changed(template, whole, colour="red", size="2")
    before, calls = contents(place), []

    def killed(self, target):
        calls.append((self, target))
        if len(calls) == moment:
            raise Killed
        return move(self, target)

    for name in ("replace", "rename"):
        move = getattr(Path, name)
        monkeypatch.setattr(Path, name, killed)
        try:
            changed(template, place, colour="red", size="2")
        except Killed:
            pass
        finally:
            monkeypatch.setattr(Path, name, move)
        assert set(before) & set(contents(whole)) <= set(contents(place))
    changed(template, place, colour="red", size="2")
    assert contents(place) == contents(whole)


def test_found_from_inside_the_package(template, place):
    assert find_recipe(template, place / "box")[1] == place


def test_where_nothing_was_made(template, tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(ResourceError, match=r"nothing to update in .*: no \*/made\.toml"):
        find_recipe(template, tmp_path / "empty")


def test_of_several_one_is_named(template, place):
    create(template, template.answers({"name": "tin"}) | {"year": "2026", "into": "."}, place)
    with pytest.raises(ResourceError, match=r"found several recipes in .*choose one with --into"):
        find_recipe(template, place)
    assert find_recipe(template, place / "tin")[0].parent.name == "tin"


def test_names_are_kept(template, place):
    with pytest.raises(UsageError, match="--update cannot rename packages, and these options give tin"):
        changed(template, place, name="tin")


def test_what_follows_from_what_is_gone_goes_too(robot_template, tmp_path):
    recipe = tmp_path / "urdfkit-new.toml"
    recipe.write_text('template = "robot"\nname = "rr"\narm = "4"\ngripper = true\nfinger_travel = 0.04\n')
    for given in ({"arm": "none"}, {"arm": "none", "gripper": "no"}):
        answers = robot_template.answers(read_recipe(robot_template, recipe, given))
        assert (answers["arm"], answers["gripper"]) == ("none", "no")
    with pytest.raises(UsageError, match="--finger-travel requires --gripper yes"):
        robot_template.answers(read_recipe(robot_template, recipe, {"arm": "none", "finger_travel": "0.03"}))


def test_a_recipe_that_answers_what_is_not_asked(robot_template, tmp_path):
    recipe = tmp_path / "urdfkit-new.toml"
    recipe.write_text('name = "rr"\ngripper = true\n')
    with pytest.raises(UsageError, match=r"urdfkit-new\.toml: `gripper` requires --arm 3 or 4"):
        read_recipe(robot_template, recipe, {})
    recipe.write_text('name = "rr"\ngripper = false\n')
    assert "gripper" not in read_recipe(robot_template, recipe, {})


def test_a_recipe_touches_nothing_outside(template, place, tmp_path):
    recipe = place / "box" / "made.toml"
    (tmp_path / "mine").write_text("mine")
    recipe.write_text(recipe.read_text() + '"../mine" = "0"\n')
    with pytest.raises(ResourceError, match=r"made\.toml: \.\./mine is outside"):
        read_made(recipe)
