"""The session behind the viewer's page, without a page."""

import time
from pathlib import Path

import numpy as np
import pytest
import trimesh

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.app.viewer.findings_panel import FindingsPanel
from urdfkit.app.viewer.session import CHECK_PERIOD, CLICKED_POINT, SAVE_TIME, Session, request_schemas
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.errors import UrdfkitError
from urdfkit.resources import find_model
from urdfkit.view.html_export import Recording
from urdfkit.view.protocol.page_requests import Request, check
from urdfkit.view.protocol.websocket_messages import ProtocolError, RawRequest
from urdfkit.view.server.request_inbox import PageInput

ROBOT = """<robot name="lab">
  <link name="base"/><link name="arm"/><link name="kite"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
    <axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="fly" type="floating"><parent link="base"/><child link="kite"/></joint>
</robot>
"""


class Shown(Recording):
    """Keeps the last poses, and every text."""

    def __init__(self) -> None:
        super().__init__()
        self.poses = np.zeros((0, 7))
        self.reported: dict[str, dict] = {}

    def publish(self, time: float, poses: np.ndarray) -> None:
        self.poses = poses

    def publish_latched(self, type: str, **values) -> None:
        super().publish_latched(type, **values)
        self.reported[type] = values

    broadcast = publish_latched


@pytest.fixture
def session(tmp_path: Path) -> Session:
    path = tmp_path / "lab.urdf"
    path.write_text(ROBOT)
    model = find_model([str(path)])
    made = Session(Shown(), model, ShownRobot.read(model), FindingsPanel(model))
    made.show()
    return made


def test_joints_move_links_and_unknown_ones_nothing(session: Session) -> None:
    session.move({"turn": 0.5, "nothing": 1.0, "fly/trans_x": 2.0})
    assert session.server.poses[1, 5] == pytest.approx(np.sin(0.25))
    assert session.server.poses[2, :3] == pytest.approx([2, 0, 0])
    assert session.server.reported["joints"]["positions"]["fly/trans_x"] == 2.0
    assert "nothing" not in session.positions


def test_a_pose_that_is_none_is_not_taken(session: Session) -> None:
    session.move({"fly/trans_x": 2.0})
    session.move({"fly/rot_w": 0.0})  # then the quaternion is zero
    assert session.positions["fly/rot_w"] == 1.0
    assert session.server.poses[2, :3] == pytest.approx([2, 0, 0])


def test_a_point_is_published_in_the_frame_of_its_link(session: Session, capsys) -> None:
    heard = []
    session.bus.subscribe(CLICKED_POINT, "geometry_msgs/msg/PointStamped", heard.append)
    assert session.execute(Request(1, 1, "point", {"frame": "arm", "position": [1.0, 2.0, 3.0]})) == {}
    (point,) = heard
    assert (point.header.frame_id, point.point.x, point.point.y, point.point.z) == ("arm", 1.0, 2.0, 3.0)
    assert "/clicked_point: 1 2 3 in arm" in capsys.readouterr().err
    with pytest.raises(UrdfkitError, match="no frame"):
        session.execute(Request(1, 2, "point", {"frame": "../arm", "position": [0.0, 0.0, 0.0]}))


def test_a_fix_is_ordered_by_its_number(session: Session) -> None:
    session.lint()
    number = next(row["number"] for row in session.server.reported["findings"]["findings"] if row["code"] == "J412")
    assert session.execute(Request(1, 1, "fix", {"finding": number}))["done"].startswith("J412: ")
    assert 'xyz="0 0 1"' in session.model.path.read_text()


def test_a_deleted_file_is_reported_and_followed_again(session: Session, capsys) -> None:
    path = session.model.path
    aside = path.with_name("aside")
    path.rename(aside)
    session.check_files()
    session.check_files()
    assert (
        "lab.urdf not found; the page shows the last robot that was read" in session.server.reported["fault"]["message"]
    )
    assert capsys.readouterr().err.count("not found") == 1
    session.check_files()
    assert capsys.readouterr().err == ""  # once
    aside.rename(path)  # as it was, to the time of its last change
    session.check_files()
    session.check_files()
    assert session.server.reported["fault"]["message"] is None
    assert "reloaded lab.urdf" in capsys.readouterr().err


def test_pages_hear_something_before_they_take_the_line_for_lost(session: Session, monkeypatch) -> None:
    class EndedError(Exception):
        pass

    start = time.monotonic()

    class Inbox:
        looks = 0

        def wait(self, timeout: float) -> PageInput:
            self.looks += 1
            monkeypatch.setattr("time.monotonic", lambda: start + self.looks * timeout)
            if self.looks * timeout > 6.0:  # the page's patience, connection.js
                raise EndedError
            return PageInput()

    heard = []
    session.server.inbox = Inbox()
    session.server.broadcast = lambda kind, **values: heard.append(kind)
    with pytest.raises(EndedError):
        session.run()
    assert heard.count("alive") >= 3


def test_a_saved_file_is_shown_after_waits_of_a_tenth_of_a_second(session: Session) -> None:
    class EndedError(Exception):
        pass

    first, waited = session.shown, []

    class Inbox:
        def wait(self, timeout: float) -> PageInput:
            if session.shown is not first:
                raise EndedError
            if not waited:
                session.model.path.write_text(ROBOT.replace("lab", "saved", 1))
            waited.append(timeout)
            return PageInput()

    session.server.inbox = Inbox()
    with pytest.raises(EndedError):
        session.run()
    assert session.shown.kinematics.robot.name == "saved"
    assert sum(waited) < 0.11


def checked(session: Session, until, patience: float = 10.0) -> float:
    """Check the files as `run` does until a condition holds; return how long that took [s]."""
    start = time.monotonic()
    while not until():
        assert time.monotonic() - start < patience
        time.sleep(CHECK_PERIOD)
        session.check_files()
    return time.monotonic() - start


def placeholders(session: Session) -> list[str]:
    return [shape.name for shape in session.shown.scene.shapes if shape.is_placeholder]


@pytest.mark.parametrize("uri", ["meshes/arm.stl", "package://lab_description/meshes/arm.stl"])
def test_a_mesh_that_comes_back_is_shown_within_a_second(uri: str, tmp_path: Path, capsys) -> None:
    folder = tmp_path / "lab_description"
    path = tmp_path / "lab.urdf" if uri.startswith("package") else folder / "lab.urdf"
    folder.mkdir()
    mesh = f'<visual><geometry><mesh filename="{uri}"/></geometry></visual>'
    path.write_text(ROBOT.replace('<link name="arm"/>', f'<link name="arm">{mesh}</link>'))
    if uri.startswith("package"):
        folder.rmdir()
    model = find_model([str(path)])
    session = Session(Shown(), model, ShownRobot.read(model), FindingsPanel(model))
    assert placeholders(session) == ["arm/visual/placeholder"]
    checked(session, lambda: session.shown.missing == (uri,))
    (folder / "meshes").mkdir(parents=True)
    file = folder / "meshes" / "arm.stl"
    file.write_bytes(b"solid")  # half written
    checked(session, lambda: session.shown.missing == ())
    assert placeholders(session) == ["arm/visual/placeholder"]
    trimesh.creation.box().export(file)
    assert checked(session, lambda: placeholders(session) == []) < 1.0
    file.unlink()
    assert checked(session, lambda: placeholders(session) == ["arm/visual/placeholder"]) < 1.0
    assert session.server.reported["fault"]["message"] is None


def test_a_file_that_is_empty_while_it_is_saved_is_not_reported(session: Session, capsys) -> None:
    path = session.model.path
    path.write_text("")
    for _ in range(3):  # it has settled, and is invalid
        session.check_files()
    path.write_text(ROBOT.replace("kite", "dragon"))
    checked(session, lambda: "dragon" in session.shown.kinematics.link_names)
    assert "empty" not in capsys.readouterr().err
    path.write_text("")
    assert checked(session, lambda: session.server.reported["fault"]["message"] is not None) >= SAVE_TIME
    assert "the file is empty" in session.server.reported["fault"]["message"]


def test_repairs_are_printed_once_and_join_the_findings_of_their_line(session: Session, capsys) -> None:
    path = session.model.path
    path.write_text(ROBOT.replace("</robot>", '<link name="stray"/>\n</robot>'))
    checked(session, lambda: session.shown.repairs)
    printed = capsys.readouterr().err
    assert printed.count("urdfkit: warning: ") == 1
    assert "is fixed to the origin of `base`" in printed
    rows = [row for row in session.server.reported["findings"]["findings"] if row["code"] == "T203"]
    assert [row["link"] for row in rows] == ["stray"]
    assert "is fixed to the origin of `base`" in rows[0]["repair"]
    path.write_text(path.read_text() + "\n")
    seen = session.shown
    checked(session, lambda: session.shown is not seen)
    assert "warning" not in capsys.readouterr().err


def test_a_strict_session_keeps_the_last_robot_that_needs_no_repair(session: Session, capsys) -> None:
    session.strict = True
    session.model.path.write_text(ROBOT.replace("</robot>", '<link name="stray"/></robot>'))
    checked(session, lambda: session.server.reported["fault"]["message"] is not None)
    assert "2 root links" in session.server.reported["fault"]["message"]
    assert "stray" not in session.shown.kinematics.link_names


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("fix", {}),
        ("fix", {"finding": "1"}),
        ("fix", {"finding": -1}),
        ("fix", {"finding": 1.5}),
        ("fix", {"finding": True}),
        ("fix", {"finding": 1, "file": "/etc/passwd"}),
        ("point", {"frame": "arm"}),
        ("point", {"frame": "arm", "position": [0, 0]}),
        ("point", {"frame": "arm", "position": [0, 0, 1e9]}),
        ("point", {"frame": "a" * 1000, "position": [0, 0, 0]}),
        ("point", {"frame": ["arm"], "position": [0, 0, 0]}),
        ("save", {"path": "x"}),
    ],
)
def test_orders_that_make_no_sense_are_refused(name: str, values: dict) -> None:
    with pytest.raises(ProtocolError):
        check(request_schemas(), 1, RawRequest(1, name, values))
