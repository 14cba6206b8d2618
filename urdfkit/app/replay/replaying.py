"""Show a recording on a page: as a context for the command."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from urdfkit.app.page import Page, faults_on_page
from urdfkit.app.replay.replay_session import ReplaySession
from urdfkit.bridges.bag_file import BagFile
from urdfkit.errors import UsageError
from urdfkit.resources import ModelArgument


@contextmanager
def recorded_model(bag: BagFile) -> Iterator[Path]:
    """Write the robot description of a recording to a temporary file inside the context.

    Raises:
        UsageError: the recording has none.
    """
    from urdfkit.app.replay.recorded_robot import recorded_description

    text = recorded_description(bag)
    if text is None:
        raise UsageError(f"{bag.path} contains no robot description: name the robot, as in `urdfkit replay FILE ROBOT`")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "robot_description.urdf"
        file.write_text(text, encoding="utf-8")
        yield file


@contextmanager
def replaying(
    page: Page, bag: BagFile, model: ModelArgument, *, fixed_frame: str | None = None, loop: bool = False
) -> Iterator[ReplaySession]:
    """Serve the page of a recording inside the context; yield its session, ready to run.

    Args:
        page: the page, not opened yet.
        bag: the recording.
        model: the robot.
        fixed_frame: frame in which everything is shown; None for the root of the transforms.
        loop: start again at the end of the recording.

    Raises:
        UrdfkitError: the robot or the recording cannot be read.
    """
    from urdfkit.app.repair_findings import note_repairs
    from urdfkit.app.replay.recorded_robot import RecordedRobot
    from urdfkit.app.viewer.shown_robot import ShownRobot

    server = page.server
    try:
        page.open()
        with faults_on_page(server):
            server.publish_latched("progress", label=f"reading {bag.path.name} …")
            shown = ShownRobot.read(model)
            note_repairs(shown.repairs)

            def progress(part: float) -> None:
                server.publish_latched("progress", label=f"reading {bag.path.name}: {part:.0%} …")

            robot = RecordedRobot(bag, shown.kinematics, fixed_frame=fixed_frame, progress=progress)
            session = ReplaySession(bag, shown, robot, server, loop=loop)
            session.show()
            server.publish_latched("progress", label=None)
        try:
            yield session
        finally:
            session.close()
    finally:
        server.stop()
