import math
import os
import signal
import socket
import subprocess
import sys
from http.client import HTTPConnection
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from tests.cli.lab import drawn
from urdfkit.cli import main

ARM = """<robot name="arm">
  <material name="grey"><color rgba="0.55 0.6 0.68 1"/></material>
  <material name="teal"><color rgba="0.05 0.55 0.55 1"/></material>
  <link name="base"><visual><origin xyz="0 0 0.05"/><geometry><cylinder radius="0.1" length="0.1"/></geometry>
    <material name="grey"/></visual></link>
  <link name="upper"><visual><origin xyz="0 0 0.2"/><geometry><box size="0.06 0.08 {length}"/></geometry>
    <material name="teal"/></visual>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.09 0.11 0.44"/></geometry></collision>
    <inertial><origin xyz="0 0 0.2"/><mass value="2"/>
    <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.004"/></inertial></link>
  <link name="finger"><visual><origin xyz="0 0 0.08"/><geometry><box size="0.04 0.05 0.16"/></geometry>
    <material name="grey"/></visual></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="5" velocity="2"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="finger"/><origin xyz="0 0 0.4"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="0.2" effort="5" velocity="2"/></joint>
</robot>
"""
Y_OF_UPPER = "urdfkit.link(1).quaternion.y"


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM.format(length=0.4))
    return path


@pytest.fixture(scope="module")
def arm_served(serve_for_all, tmp_path_factory: pytest.TempPathFactory):
    """The arm, served for all tests that leave its file alone; where its joints stand is anybody's guess."""
    path = tmp_path_factory.mktemp("arm") / "arm.urdf"
    path.write_text(ARM.format(length=0.4))
    return serve_for_all("view", str(path))


def slide(page, joint: str, value: float) -> None:
    """Move a slider as a person's hand does: the value, then the event."""
    page.locator(f"#joint-{joint}").evaluate(
        "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input', { bubbles: true })); }",
        value,
    )


@pytest.mark.browser
def test_a_slider_moves_a_link(arm_served, visits, keep, until) -> None:
    page = visits.open(arm_served.url)
    assert page.url == f"{arm_served.origin}/"  # the key is gone from the address
    assert page.title() == "arm · urdfkit"
    assert page.locator("#robot-name").inner_text() == "arm"
    slide(page, "shoulder", 0)
    slide(page, "slide", 0)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(0, abs=1e-9))
    drawn(page)
    before = page.screenshot()
    keep(page, "open")

    slide(page, "shoulder", 0.8)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.4), abs=1e-6))
    slide(page, "slide", 0.2)
    # the finger's place is Python's: 0.1 up, then 0.4 + 0.2 along the tilted arm
    until(lambda: page.evaluate("urdfkit.link(2).position.x") == pytest.approx(0.6 * math.sin(0.8), abs=1e-6))
    assert page.evaluate("urdfkit.link(2).position.z") == pytest.approx(0.1 + 0.6 * math.cos(0.8), abs=1e-6)
    drawn(page)
    assert page.screenshot() != before
    keep(page, "slider")
    assert visits.problems == []
    assert all(url.startswith((arm_served.origin, "data:", "blob:")) for url in visits.requests)


@pytest.mark.browser
def test_typing_zero_filter_and_keys(arm_served, visits, keep, until) -> None:
    page = visits.open(arm_served.url)
    number = page.get_by_label("shoulder [rad]")
    number.fill("0.5")
    number.press("Enter")
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.25), abs=1e-6))
    for refused in ("9", "1.51", "abc", "nan", "0x10", "inf", "--1", "1_0", "pi/2"):  # beyond the limit, or no number
        number.fill(refused)
        number.press("Enter")
        until(lambda: number.get_attribute("aria-invalid") == "true")
        words = page.locator("#toast").inner_text()
        assert words.startswith("shoulder: ")
        assert ("the maximum is 1.5 rad" in words) is (refused[0] in "91" and "_" not in refused)
        assert float(number.input_value()) == 0.5
    assert page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.25), abs=1e-6)
    number.fill("1.5")  # as it is written below the slider
    number.press("Enter")
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.75), abs=1e-6))
    assert number.get_attribute("aria-invalid") is None
    page.get_by_role("button", name="Zero all").click()
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(0, abs=1e-9))
    page.locator("#joint-shoulder").press("ArrowRight")
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.015), abs=1e-6))
    assert visits.problems == []


@pytest.mark.browser
def test_what_is_shown_can_be_chosen(arm_served, visits, keep, until) -> None:
    page = visits.open(arm_served.url)
    shown = "(role) => urdfkit.scene.viewer.scene_tree.find(['robot', 'links', 'upper', role]).object.visible"
    assert page.evaluate(shown, "visual")
    assert not page.evaluate(shown, "collision")
    page.get_by_role("button", name="Show", exact=True).click()
    page.get_by_role("checkbox", name="Collision", exact=True).check()
    page.get_by_label("Visual").uncheck()
    assert page.evaluate(shown, "collision")
    assert not page.evaluate(shown, "visual")
    page.get_by_label("Visual").check()
    page.get_by_label("Origin").check()
    keep(page, "collision")
    page.get_by_label("Grid").uncheck()
    assert not page.evaluate("urdfkit.viewport.grid.visible")


@pytest.mark.browser
def test_saving_shows_the_change_and_keeps_joints_and_camera(serve, visits, keep, until, arm: Path) -> None:
    served = serve("view", str(arm))
    page = visits.open(served.url)
    slide(page, "shoulder", 0.8)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.4), abs=1e-6))
    page.mouse.move(400, 400)
    page.mouse.down()
    page.mouse.move(500, 430, steps=4)
    page.mouse.up()
    camera = page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()")
    model = page.evaluate("urdfkit.scene.model")

    arm.write_text(ARM.format(length=0.3).replace('upper="1.5"', 'upper="1.2"'))
    until(lambda: page.evaluate("urdfkit.scene.model") != model)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.4), abs=1e-6))
    assert page.locator("#joint-shoulder").evaluate("s => [Number(s.value), Number(s.max)]") == [0.8, 1.2]
    upper = "urdfkit.scene.viewer.scene_tree.find(['robot', 'links', 'upper', 'visual', '0'])"
    depth = f"{upper}.object.children[0].geometry.parameters.depth"
    assert page.evaluate(depth) == 0.3
    assert page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()") == pytest.approx(camera)
    keep(page, "reloaded")

    arm.write_text(ARM.format(length=0.3).replace('<child link="finger"/>', '<child link="finger">'))
    page.wait_for_selector("#fault:visible")
    until(lambda: "mismatched tag" in page.locator("#fault").inner_text())
    assert "mismatched tag" in served.errors.read_text()
    assert page.evaluate(depth) == 0.3  # the last good robot stays
    keep(page, "fault")

    arm.write_text(ARM.format(length=0.35))
    page.wait_for_selector("#fault", state="hidden")
    until(lambda: page.evaluate(depth) == 0.35)
    assert visits.problems == []


@pytest.mark.browser
def test_a_mesh_used_four_times_is_fetched_once(serve, visits, keep, until, tmp_path: Path) -> None:
    import trimesh

    trimesh.creation.annulus(0.05, 0.1, 0.04).export(tmp_path / "wheel.stl")
    links = "".join(
        f"""<link name="w{i}"><visual><geometry><mesh filename="wheel.stl" scale="1 1 2"/></geometry></visual></link>
        <joint name="j{i}" type="continuous"><parent link="base"/><child link="w{i}"/>
        <origin xyz="{0.3 * (i % 2)} {0.3 * (i // 2)} 0.1" rpy="1.5708 0 0"/></joint>"""
        for i in range(4)
    )
    (tmp_path / "cart.urdf").write_text(f'<robot name="cart"><link name="base"/>{links}</robot>')
    page = visits.open(serve("view", "cart.urdf").url)
    assert sum("/geometry/" in url for url in visits.requests) == 1
    size = "new MeshCat.THREE.Box3().setFromObject(urdfkit.link(1)).getSize(new MeshCat.THREE.Vector3()).toArray()"
    assert page.evaluate(size) == pytest.approx([0.2, 0.2, 0.08], abs=1e-3)
    keep(page, "mesh")
    assert visits.problems == []


@pytest.mark.browser
def test_nobody_gets_in_without_the_key(arm_served, visits, keep) -> None:
    visits.open(arm_served.url)
    other = visits.open("about:blank", ready=False)
    answer = other.goto(f"{arm_served.origin}/")
    assert answer is not None
    assert answer.status == 403
    assert "requires its token" in other.content()
    keep(other, "refused")


@pytest.mark.browser
def test_several_pages_see_the_same(arm_served, visits, until) -> None:
    one, two = visits.open(arm_served.url), visits.open(arm_served.url)
    slide(one, "shoulder", -0.6)
    until(lambda: two.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(-0.3), abs=1e-6))
    until(lambda: two.get_by_label("shoulder [rad]").input_value() == "-0.600")
    late = visits.open(arm_served.url)
    until(lambda: late.get_by_label("shoulder [rad]").input_value() == "-0.600")
    assert late.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(-0.3), abs=1e-6)


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone(arm_served, visits, keep, until, scheme: str) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
    page = visits.open(arm_served.url, color_scheme=scheme, **phone)
    keep(page, f"phone-{scheme}")
    page.get_by_role("button", name="Joints", exact=True).tap()
    slide(page, "shoulder", 0.5)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.25), abs=1e-6))
    keep(page, f"phone-{scheme}-panel")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    # 43.99: boxes that a transform moves by parts of a pixel measure 43.9999847 of 44 px.
    small = page.evaluate(
        """() => [...document.querySelectorAll('button, input:not([type=checkbox]), summary, .checks label')]
             .filter((e) => e.checkVisibility() && e.getBoundingClientRect().height < 43.99).map((e) => e.outerHTML)"""
    )
    assert small == []


@pytest.mark.browser
def test_the_page_is_found_again_after_the_line_broke(arm_served, visits, until) -> None:
    page = visits.open(arm_served.url)
    page.evaluate("urdfkit.connection.socket.close()")
    page.wait_for_selector("#state[data-state=lost]")
    page.wait_for_selector("#state[data-state=connected]")
    slide(page, "shoulder", 0.4)
    until(lambda: page.evaluate(Y_OF_UPPER) == pytest.approx(math.sin(0.2), abs=1e-6))


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_ending_is_clean_and_leaves_nothing_behind(serve, arm: Path, how: signal.Signals) -> None:
    served = serve("view", str(arm))
    assert served.end(how) in (0, 130)
    assert served.errors.read_text().strip() == ""
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", int(served.origin.rsplit(":", 1)[1]))) != 0


def test_a_background_job_of_a_script_ignores_a_closed_terminal_and_ends_with_sigint(serve, arm: Path) -> None:
    served = serve("view", str(arm), ignored=[signal.SIGINT, signal.SIGHUP])
    served.process.send_signal(signal.SIGHUP)
    page = HTTPConnection(served.origin.removeprefix("http://"))
    page.request("GET", "/")
    assert page.getresponse().status == 403  # it runs; who has no token is not let in
    page.close()
    assert served.end(signal.SIGINT) in (0, 130)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["no-such-robot-at-all"], "no robot, file or folder"),
        (["{folder}/missing.urdf"], "no such file"),
        (["{folder}/broken.urdf"], "broken.urdf:"),
        (["{folder}/loop.urdf", "--strict"], "loop.urdf:"),
        (["{folder}/mesh.urdf", "--strict"], "mesh.urdf:2:"),
        (["{folder}/arm.urdf", "--port", "99999"], "outside 0..65535"),
        (["{folder}/arm.urdf", "--port", "x"], "is not an integer"),
        (["{folder}/arm.urdf", "--host", "192.0.2.1"], "cannot listen on"),
        (["{folder}/arm.urdf", "--html", "{folder}/no/such/folder/x.html"], "cannot write"),
    ],
)
def test_bad_input_is_one_line_and_exit_2(arm: Path, capfd, words: list[str], expected: str) -> None:
    folder = arm.parent
    (folder / "broken.urdf").write_text("<robot name='x'><link></robot>")
    link, joint = (
        '<link name="{0}"/>',
        '<joint name="j{0}" type="fixed"><parent link="{0}"/><child link="{1}"/></joint>',
    )
    loop = link.format("a") + link.format("b") + joint.format("a", "b") + joint.format("b", "a")
    (folder / "loop.urdf").write_text(f'<robot name="x">{loop}</robot>')
    (folder / "mesh.urdf").write_text(
        '<robot name="x">\n'
        '<link name="a"><visual><geometry><mesh filename="gone.stl"/></geometry></visual></link></robot>'
    )
    assert main(["view", *(word.format(folder=folder) for word in words), "--no-browser"]) == 2
    output = capfd.readouterr()
    assert output.out == ""
    assert expected in output.err
    assert len(output.err.strip().splitlines()) == 1
    assert "Traceback" not in output.err


def test_a_busy_port_names_a_free_one(arm_served, arm: Path, capfd) -> None:
    port = arm_served.origin.rsplit(":", 1)[1]
    assert main(["view", str(arm), "--port", port, "--no-browser"]) == 2
    assert capfd.readouterr().err.startswith(f"urdfkit: port {port} is in use; ")


@pytest.mark.parametrize(
    ("gone", "platform", "expected"),
    [
        (["meshcat"], "linux", "view needs meshcat: pip install 'urdfkit[view]'"),
        (["meshcat", "pinocchio"], "linux", "view needs meshcat and pinocchio: pip install 'urdfkit[view]'"),
        (["meshcat", "pinocchio"], "win32", "WSL"),
    ],
)
def test_what_is_not_installed_is_one_line(monkeypatch, capfd, gone: list[str], platform: str, expected: str) -> None:
    for module in gone:
        monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.setattr(sys, "platform", platform)
    assert main(["view", "x.urdf"]) == 2
    error = capfd.readouterr().err
    assert expected in error
    assert len(error.strip().splitlines()) == 1


def test_nothing_heavy_is_imported_for_the_help() -> None:
    code = "import sys; from urdfkit.cli import main\ntry: main(['view', '--help'])\nexcept SystemExit: pass\n"
    code += (
        "heavy = {'numpy', 'pinocchio', 'tornado', 'meshcat', 'trimesh'} & set(sys.modules); assert not heavy, heavy"
    )
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, env={**os.environ})
