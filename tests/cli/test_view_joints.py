"""The joint panel and dragging, in a real browser."""

import math

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from tests.cli.lab import at, drawn, values
from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.view.content.inspector import inspection

pytestmark = pytest.mark.browser


@pytest.fixture
def page(lab_page):
    return lab_page


def test_units_of_angles(page, until, keep) -> None:
    page.get_by_label("Angles in").first.select_option("deg")
    number = page.get_by_label("bend [deg]")
    number.fill("30")
    number.press("Enter")
    until(lambda: values(page)["bend"] == pytest.approx(math.radians(30)))
    ends = page.locator('li[data-joint="bend"] .joint-ends').inner_text().split()
    assert ends == ["-114.592", "57.296"]
    assert page.get_by_label("open [m]").is_visible()  # lengths stay metres
    keep(page, "degrees")


def test_a_typed_limit_is_taken_as_it_is_shown_and_no_more(page, until) -> None:
    page.get_by_label("Angles in").first.select_option("deg")
    number = page.get_by_label("bend [deg]")
    number.fill("57.296")  # a little more than the limit of 1 rad, which is what is shown
    number.press("Enter")
    until(lambda: values(page)["bend"] == pytest.approx(1.0))
    number.fill("57.4")
    number.press("Enter")
    until(lambda: "bend: 57.4 ° is too large; the maximum is 57.296 °" in page.locator("#toast").inner_text())
    assert values(page)["bend"] == 1.0
    page.get_by_label("Angles in").first.select_option("rad")


def test_centre_random_and_zero(page, until, keep) -> None:
    page.get_by_role("button", name="Centre").click()
    until(lambda: values(page)["bend"] == pytest.approx(-0.5))
    assert values(page)["open"] == pytest.approx(0.025)
    assert values(page)["follow"] == pytest.approx(-0.025)  # it follows
    page.get_by_role("button", name="Random").click()
    until(lambda: values(page)["bend"] != pytest.approx(-0.5))
    assert -2 <= values(page)["bend"] <= 1
    assert 0 <= values(page)["open"] <= 0.05
    keep(page, "random")
    page.keyboard.press("0")
    until(lambda: values(page)["bend"] == 0)


def test_limits_can_be_ignored_and_come_back(page, until, keep) -> None:
    number = page.get_by_label("bend [rad]")
    page.get_by_label("Ignore limits").check()
    number.fill("2.5")
    number.press("Enter")
    until(lambda: values(page)["bend"] == 2.5)
    assert page.locator('li[data-joint="bend"]').get_attribute("data-beyond") is not None
    keep(page, "beyond-limits")
    page.get_by_label("Ignore limits").uncheck()
    until(lambda: values(page)["bend"] == 1)


def test_a_mimic_joint_names_its_master_and_cannot_be_moved(page) -> None:
    row = page.locator('li[data-joint="follow"]')
    assert "follows -1 × open" in row.inner_text()
    assert row.locator("input").first.is_disabled()


def test_joints_are_grouped_by_chain(page, keep) -> None:
    shown = "rows => rows.map((row) => row.dataset.joint ?? row.innerText.trim())"
    rows = page.locator("#joints li:visible")
    arm, grip, base = (
        ["to hand (3)", "turn", "bend", "tip"],
        ["at hand (2)", "open", "follow"],
        ["at base (1)", "glass"],
    )
    assert rows.evaluate_all(shown) == [*arm, *grip, *base]
    keep(page, "groups")
    head = page.get_by_role("button", name="to hand (3)")
    head.focus()
    page.keyboard.press("Enter")
    assert head.get_attribute("aria-expanded") == "false"
    assert rows.evaluate_all(shown) == [arm[0], *grip, *base]
    page.locator("#filter").fill("bend")  # a search finds folded rows too
    assert rows.evaluate_all(shown) == ["bend"]
    page.locator("#filter").fill("")
    head.click()
    assert rows.evaluate_all(shown) == [*arm, *grip, *base]


def test_the_filter_leaves_what_fits(page) -> None:
    page.get_by_label("Filter joints").fill("TI")
    assert page.locator("#joints li:visible").evaluate_all("rows => rows.map((r) => r.dataset.joint)") == ["tip"]
    page.get_by_label("Filter joints").fill("nothing")
    assert page.get_by_text("No joint matches.").is_visible()


def test_a_link_follows_the_handle_within_its_limits(page, until, keep) -> None:
    page.evaluate("urdfkit.page.setJoints({ bend: 0.6, tip: 0.6 })")
    until(lambda: values(page)["tip"] == 0.6)
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.get_by_role("button", name="Drag the selected link").click()
    assert page.locator("#ik-strip").inner_text().startswith("Drag the handle of left, or press the arrow keys.")
    drawn(page)
    x, y = at(page, "left")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 10, y + 40, steps=5)
    until(lambda: math.dist(at(page, "left"), (x - 10, y + 40)) < 2)  # the link is where the hand is
    keep(page, "drag")
    page.mouse.move(x + 700, y, steps=5)  # out of reach
    until(lambda: "out of reach" in " ".join(page.locator(".measure-label").all_inner_texts()))
    page.mouse.up()
    now = values(page)
    assert -2 <= now["bend"] <= 1
    assert -1.5 <= now["tip"] <= 1.5
    assert page.locator(".measure-label").count() == 0
    page.get_by_label("Keep the orientation").check()
    assert page.evaluate("urdfkit.ik.gizmo.handles.filter((h) => h.userData.kind === 'about' && h.visible).length") == 6
    keep(page, "drag-rings")


def test_a_link_follows_the_arrow_keys(page, until) -> None:
    page.evaluate("urdfkit.page.setJoints({ turn: 0, bend: 0.6, tip: 0.6 })")
    until(lambda: values(page)["tip"] == 0.6)
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.get_by_role("button", name="Drag the selected link").press("Enter")
    where = "urdfkit.kinematics.forward(urdfkit.page.values).get('left').slice(0, 3)"
    place = page.evaluate(where)
    for key, axis, step in (("Shift+ArrowDown", 2, -0.01), ("Shift+ArrowDown", 2, -0.01), ("ArrowDown", None, 0.01)):
        before, place = place, list(place)
        page.keyboard.press(key)
        until(lambda b=before: math.dist(page.evaluate(where), b) > 5e-3)
        place = page.evaluate(where)
        assert math.dist(place, before) == pytest.approx(0.01, abs=1e-4)
        if axis is not None:
            assert place[axis] - before[axis] == pytest.approx(step, abs=1e-4)
    page.keyboard.press("Escape")


def test_solutions_to_choose_from_and_the_motions_that_are_lost(page, until, keep) -> None:
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.get_by_role("button", name="Drag the selected link").click()
    until(lambda: "singular: no translation along z of base" in page.locator("#ik-lost").inner_text())
    until(lambda: page.evaluate("urdfkit.ik.lost.visible"))
    keep(page, "singular")
    page.evaluate("urdfkit.page.setJoints({ bend: -0.8, tip: 0.9 })")
    until(lambda: page.locator("#ik-lost").inner_text() == "")
    assert not page.evaluate("urdfkit.ik.lost.visible")
    where = "urdfkit.kinematics.forward(urdfkit.page.values).get('left').slice(0, 3)"
    pose = page.evaluate(where)
    page.get_by_role("button", name="Solutions").click()
    until(lambda: page.locator("#ik-count").inner_text().startswith("1 of "))
    count = page.evaluate("urdfkit.ik.choice.found.length")
    assert count >= 2
    seen = set()
    for k in range(count):
        until(lambda k=k: page.locator("#ik-count").inner_text() == f"{k + 1} of {count}")
        wanted = page.evaluate(f"urdfkit.ik.choice.found[{k}]")
        until(lambda w=wanted: all(values(page)[name] == pytest.approx(w[name]) for name in w))
        assert page.evaluate(where) == pytest.approx(pose, abs=1e-4)
        seen.add(tuple(round(values(page)[name], 3) for name in ("turn", "bend", "tip")))
        page.get_by_role("button", name="Next solution").click()
    assert len(seen) == count
    keep(page, "solutions")
    page.get_by_label("bend [rad]").fill("0.123")
    page.get_by_label("bend [rad]").press("Enter")
    page.get_by_role("button", name="Solutions").wait_for()  # those solutions had another pose


@pytest.mark.parametrize("turn", [False, True])
def test_inverse_kinematics_finds_what_can_be_reached(page, turn: bool) -> None:
    """200 random goals of a real arm, from its zero: at least 98 in 100, inside the limits."""
    robot = Kinematics(load("seven_dof_arm"))
    found = page.evaluate(
        """([description, turn]) => { const k = new urdfkit.kinematics.constructor(description), found = [];
            let seed = 7; const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
            const link = "gripper_roll_link", movers = k.movers(link);
            const within = (value, { lower, upper }) => Math.min(upper ?? 9, Math.max(lower ?? -9, value));
            for (let i = 0; i < 200; i++) {
              const pose = {}, start = {};
              for (const joint of movers) {
                const [low, high] = [joint.lower ?? -Math.PI, joint.upper ?? Math.PI];
                pose[joint.name] = low + random() * (high - low);
                start[joint.name] = within(0, joint);
              }
              const { values, error, turned } = k.inverse(link, k.forward(pose).get(link), start, { turn });
              const off = ({ name, ...ends }) => Math.abs(within(values[name], ends) - values[name]);
              const kept = movers.every((joint) => off(joint) < 1e-9);
              found.push([error, turn ? turned : 0, kept]);
            }
            return found; }""",
        [inspection(robot), turn],
    )
    assert all(kept for _, _, kept in found)
    assert sum(error < 1e-3 and turned < 1e-2 for error, turned, _ in found) >= 196


def test_a_decimal_comma_is_as_good_as_a_point_and_words_are_refused(page, until, keep) -> None:
    number = page.get_by_label("bend [rad]")
    number.fill("0,5")
    number.press("Enter")
    until(lambda: values(page)["bend"] == 0.5)
    assert number.input_value() == "0.500"
    number.fill("half")
    number.press("Enter")
    until(lambda: page.locator("#toast").inner_text() == "bend: “half” is not a number, such as 0.5")
    assert number.input_value() == "0.500"
    assert values(page)["bend"] == 0.5
    keep(page, "no-number")
    number.press("ArrowUp")
    until(lambda: values(page)["bend"] == pytest.approx(0.51))
    read = """async () => { const { readNumber } = await import("/app/page/number_field.js");
        return ["0,5", "-1", " 2.5 ", "−3", "1e-3", ".5", "1 000", "1,234.5", "1.234,5", "0x10", "", "1,2,3"].map(
          (text) => { const found = readNumber(text); return Number.isNaN(found) ? null : found; }); }"""
    assert page.evaluate(read) == [0.5, -1, 2.5, -3, 0.001, 0.5, 1000, None, None, None, None, None]


def test_the_map_of_reach_is_a_layer(page, until, keep) -> None:
    # The last test: the map stays on the page, and opens its panel.
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.get_by_role("button", name="Drag the selected link").click()
    page.get_by_role("button", name="Reach map").click()
    until(lambda: page.evaluate("urdfkit.reach.map?.tip") == "left")
    assert page.locator("#panel-reach").is_visible()
    assert page.evaluate("urdfkit.reach.shown.count") > 10
    keep(page, "reach")
