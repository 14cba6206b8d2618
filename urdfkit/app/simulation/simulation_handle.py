"""Start a simulation that is driven from its page: as a handle for scripts and notebooks, or in a `with` block."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from urdfkit.app.page import Page, faults_on_page, require_page
from urdfkit.app.page_handle import PageHandle
from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.description import Robot
from urdfkit.description.loading import load, load_repaired
from urdfkit.description.sdf import World, load_world
from urdfkit.sim import Simulator


class SimulationHandle(PageHandle):
    """Handle to the page of a simulation that advances in the background until `close` is called.

    Attributes:
        simulator: the simulation. It advances in a thread of its own: call its methods before the page is driven, from
            callbacks (`subscribe`, `at`, `every`), or after `close`.
    """

    simulator: Simulator


def teleop(
    robot: Robot | str | Path,
    *,
    world: World | str | Path = "empty",
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
    ros_distro: str | None = None,
    controllers: Sequence[str | Path] = (),
    renderer: str = "ray",
    strict: bool = False,
    density: float = 1000.0,
    host: str = "127.0.0.1",
    port: int = 0,
) -> SimulationHandle:
    """Simulate a robot in real time and drive it in the browser, as ``urdfkit sim teleop`` does.

    Args:
        robot: a file, a package folder, the name of a bundled robot, or a loaded robot.
        world: a world, the name of a bundled world, or an SDF file.
        arguments: xacro arguments.
        package_path: folders to search for packages first.
        ros_distro: the ROS distribution whose behaviour the plugins have; the newest when None.
        controllers: parameter files of controllers, in place of the files that the robot's packages load.
        renderer: renderer of the cameras: ``ray``, ``gl`` or ``auto``.
        strict: refuse robots that need a repair, such as an estimated mass.
        density: density for the mass of moving links without one [kg/m³].
        host: address to listen on; ``0.0.0.0`` accepts other machines, which need the token in the address.
        port: port to serve on; 0 for any free port.

    Returns:
        A handle with the address of the page. The simulation runs until its `close` or the end of the process.

    Raises:
        MissingDependencyError: the extra ``sim`` is not installed.
        UsageError: `robot` is not a robot, or the port is busy.
        UrdfkitError: the robot or the world cannot be loaded or simulated.

    Examples:
        >>> import urdfkit
        >>> with urdfkit.teleop("simpleton") as page:
        ...     print(page.url.partition(":")[0])  # open the complete address in a browser
        http
    """
    require_page("teleop", "sim", modules=("numba", "rosbags"))
    folders = tuple(package_path)
    loaded = (load if strict else load_repaired)(robot, arguments=arguments, package_path=folders)
    place = world if isinstance(world, World) else load_world(world, package_path=folders)
    with ExitStack() as stack:
        page = Page("sim", host=host, port=port)
        options = RunOptions(
            ros_distro=ros_distro, controllers=tuple(controllers), renderer=renderer, strict=strict, density=density
        )
        loop = stack.enter_context(driving(page, loaded, place, options))
        handle = SimulationHandle(page.server, loop.run, stack.pop_all())
    handle.simulator = loop.simulator
    return handle


@contextmanager
def driving(
    page: Page, robot: Robot, world: World, options: RunOptions, *, note: Callable[[str], None] | None = None
) -> Iterator[DriveLoop]:
    """Serve the page of a simulation inside the context; yield its loop, ready to run.

    Args:
        page: the page, not opened yet.
        robot: the robot.
        world: the world.
        options: options of the simulation; its commands are not used.
        note: receives the warnings of the simulation.

    Raises:
        UrdfkitError: the robot cannot be simulated in the world.
    """
    from urdfkit.app.simulation.initial_scene import InitialScene
    from urdfkit.app.simulation.progress import Compilation, progress
    from urdfkit.description.xml.cost_limit import loading_limit
    from urdfkit.scene.rays import cached, warmup
    from urdfkit.view.server.running_simulations import registered

    server = page.server
    try:
        initial_scene = InitialScene(robot, world, strict=options.strict, density=options.density)
        page.open()  # the browser starts and shows the robot while the engine is prepared
        # `urdfkit topic` finds the simulation from here on
        with (
            registered(server.port, server.url, robot.name or "robot"),
            closing(Compilation(server, options.renderer)) as compilation,
        ):
            with faults_on_page(server), compilation.kernels.used():
                initial_scene.show(server)
                server.publish_latched("progress", label="preparing the engine …")
                with progress(server, "loading meshes, building the world …"), loading_limit():
                    loop = DriveLoop(options.build(robot, world, note, scene=initial_scene.scene), server)
                with progress(server, "drawing …"):
                    loop.show()
                if loop.sensor_views.find() and cached():
                    with progress(server, "building the ray-casting trees of sensors …"):
                        warmup()
                        loop.sensor_views.prepare()
                else:
                    loop.sensor_views.begin_when(compilation.rays_are_compiled)
                compilation.show()
            loop.kernels = compilation.kernels.used
            yield loop
    finally:
        page.close()
