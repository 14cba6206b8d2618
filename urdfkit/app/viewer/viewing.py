"""Start the viewer: as a handle for scripts and notebooks, in a `with` block for the command, or as a file."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Any

from urdfkit.app.page import Page, require_page
from urdfkit.app.page_handle import PageHandle
from urdfkit.app.viewer.session import Session, request_schemas
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.description import Robot
from urdfkit.description.loading import refuse_unused
from urdfkit.description.model_argument import model_argument
from urdfkit.resources import ModelArgument


def view(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
    host: str = "127.0.0.1",
    port: int = 0,
    strict: bool = False,
) -> PageHandle:
    """Show a robot in the browser, as ``urdfkit view`` does.

    The page has a slider for each joint and lists the lint findings. It shows changed files without a restart. Defects
    that keep a robot from being shown are repaired, with a warning for each on standard error and on the page.

    Args:
        robot: a file, a package folder, the name of a bundled robot, or a loaded robot, whose files are followed.
        arguments: xacro arguments.
        package_path: folders to search for packages first.
        host: address to listen on; ``0.0.0.0`` accepts other machines, which need the token in the address.
        port: port to serve on; 0 for any free port.
        strict: refuse robots that need a repair, such as a placeholder for a missing mesh.

    Returns:
        A handle with the address of the page. The page is served until its `close` or the end of the process.

    Raises:
        MissingDependencyError: the extra ``view`` is not installed.
        UsageError: `robot` is not a robot, or the port is busy.
        UrdfkitError: the robot cannot be loaded.

    Examples:
        >>> import urdfkit
        >>> with urdfkit.view("simpleton") as page:
        ...     print(page.url.partition(":")[0])  # open the complete address in a browser
        http
    """
    require_page("view", "view", modules=("rosbags",))
    from urdfkit.app.repair_findings import note_repairs

    model = model_argument(robot, arguments=arguments, package_path=package_path)
    shown = ShownRobot.read(model, strict=strict)
    refuse_unused(arguments, shown.files)
    note_repairs(shown.repairs)
    with ExitStack() as stack:
        page = Page("view", host=host, port=port)
        session = stack.enter_context(viewing(page, model, shown, strict=strict))
        return PageHandle(page.server, session.run, stack.pop_all())


@contextmanager
def viewing(page: Page, model: ModelArgument, shown: ShownRobot, *, strict: bool = False) -> Iterator[Session]:
    """Serve the page of a robot inside the context; yield its session, ready to run.

    Args:
        page: the page, not opened yet.
        model: the robot as it was given.
        shown: the robot.
        strict: refuse changed files that need a repair.
    """
    from urdfkit.app.viewer.findings_panel import FindingsPanel
    from urdfkit.network.access_control import is_loopback

    server = page.server
    server.requests.update(request_schemas())
    try:
        findings = FindingsPanel(model, may_write=model.macro is None and is_loopback(page.host))
        session = Session(server, model, shown, findings, strict=strict)
        server.publish_latched("progress", label="Preparing shapes")
        page.open()  # the browser starts while the shapes are prepared
        session.show()
        server.publish_latched("progress", label=None)
        yield session
    finally:
        page.close()


def html_page(
    model: ModelArgument, shown: ShownRobot, messages: Mapping[str, Mapping[str, Any]] = MappingProxyType({})
) -> str:
    """Return the page of a robot as one file that needs no server.

    Args:
        model: the robot as it was given.
        shown: the robot.
        messages: further messages for the page: type → values.
    """
    from urdfkit.app.viewer.findings_panel import FindingsPanel
    from urdfkit.view.html_export import Recording

    recording = Recording()
    session = Session(recording, model, shown, FindingsPanel(model, may_write=False))
    session.show()
    session.lint()
    for name, values in messages.items():
        recording.publish_latched(name, **values)
    return recording.html()
