"""Where packages are: the folders of a workspace, of ROS, of Gazebo, and the bundled ones, in order."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from urdfkit.description.packages.existence import is_file, is_folder
from urdfkit.errors import ResourceError

_PREFIX_VARIABLES = ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH")
_BUNDLED_MODELS = Path(__file__).resolve().parents[1] / "library" / "models"
_MODEL_VARIABLES = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH")
VARIABLES = ("ROS_PACKAGE_PATH", *_PREFIX_VARIABLES, *_MODEL_VARIABLES)
"""Environment variables that list folders of packages."""


class PackageSearch:
    """Search for the folder of a package; see `Packages` for the order.

    Args:
        folders: folders to search first: packages, folders of packages, or install prefixes.
        near: a file or folder of the workspace to search.
        environment: environment variables.
        permits: whether a path may be read; every path when None.
        scanned: the packages below each folder that was scanned before; shared by several searches.

    Attributes:
        seen: name → folder of the packages that were passed during the search.
    """

    def __init__(
        self,
        folders: Sequence[Path],
        near: Path | None,
        environment: Mapping[str, str],
        permits: Callable[[Path], bool] | None,
        scanned: dict[Path, dict[str, Path]],
    ) -> None:
        self.folders, self.near, self.environment, self.permitted = folders, near, environment, permits
        self.scanned = scanned
        self.seen: dict[str, Path] = {}

    def __getstate__(self) -> dict[str, object]:
        """Return the attributes, without the environment of this process: a copy uses that of its own process."""
        return vars(self) | {"environment": None if self.environment is os.environ else self.environment}

    def __setstate__(self, state: dict[str, object]) -> None:
        """Set the attributes."""
        vars(self).update(state | ({"environment": os.environ} if state["environment"] is None else {}))

    def look_up(self, name: str) -> Path | None:
        """Return the folder of a package or model; None without one."""
        for folder in self._places():
            if folder is not None and self.permits(folder) and (found := self._below(folder, name)) is not None:
                return found
        if (newest := next(self._fuel_models(name), None)) is not None:
            return newest
        for bundled in (_shipped_robots(), _BUNDLED_MODELS):
            if bundled is not None and (found := self._below(bundled, name)) is not None:
                return found
        if self.near is not None:
            for around in (self.near, *self.near.parents):
                if not self.permits(around):
                    break
                if around.name == name and is_folder(around):
                    return around
                if len(around.parts) > 2 and is_folder(around / name) and around != self.near:
                    return around / name
        return None

    def permits(self, path: str | Path) -> bool:
        """Return whether a path may be read."""
        return (
            self.permitted is None
            or self.permitted(Path(path))
            or any(bundled in (Path(path), *Path(path).parents) for bundled in (_shipped_robots(), _BUNDLED_MODELS))
        )

    def _below(self, folder: Path, name: str) -> Path | None:
        """Return the package or model of a name in or below a folder."""
        from urdfkit.description.packages.discovery import package_name

        direct = folder / name
        if package_name(direct) == name or is_file(direct / "model.config"):
            return direct
        return self._scan(folder).get(name)

    def _places(self) -> Iterator[Path | None]:
        """Yield the folders to search, best first; each is scanned only after the previous ones had no result."""
        from urdfkit.description.packages.discovery import package_name, share_folders, workspace

        for folder in self.folders:
            yield from (folder, *share_folders(folder))
        if (package := self._enclosing_package()) is not None:
            self.seen[package_name(package) or package.name] = package
            yield package
            yield package.parent
            yield workspace(package)
            for level in filter(self.permits, (package, *package.parents[:4])):
                yield from (*share_folders(level / "install"), *share_folders(level / "devel"))
        yield from self._listed("ROS_PACKAGE_PATH")
        for variable in _PREFIX_VARIABLES:
            for prefix in self._listed(variable):
                yield from share_folders(prefix)
        for variable in _MODEL_VARIABLES:
            yield from self._listed(variable)
        yield self._home / ".gazebo" / "models"

    @property
    def _home(self) -> Path:
        return Path(self.environment.get("HOME") or Path.home())

    def _fuel_models(self, name: str) -> Iterator[Path]:
        """Yield the folders of a model in the caches of Gazebo Fuel, the newest version first."""
        from urdfkit.description.packages.discovery import fuel_models

        listed = self._listed("GZ_FUEL_CACHE_PATH") + self._listed("IGN_FUEL_CACHE_PATH")
        for cache in (*listed, self._home / ".gz" / "fuel", self._home / ".ignition" / "fuel"):
            yield from fuel_models(cache, name) if self.permits(cache) else ()

    def _listed(self, variable: str) -> list[Path]:
        return [Path(word) for word in self.environment.get(variable, "").split(os.pathsep) if word]

    def places_searched(self) -> str:
        """Return the searched places in words."""
        from urdfkit.description.packages.discovery import workspace

        places = ["--package-path"] if self.folders else []
        package = self._enclosing_package()
        if package is not None:
            places.append(f"the workspace {workspace(package) or package.parent}")
        elif self.near is not None:
            places.append(f"the folders around {self.near}")
        places += [v for v in ("ROS_PACKAGE_PATH", *_PREFIX_VARIABLES, *_MODEL_VARIABLES) if self._listed(v)]
        return ", ".join([*places, "the bundled robots and models"])

    def _enclosing_package(self) -> Path | None:
        if self.near is None:
            return None
        return next((f for f in (self.near, *self.near.parents) if (f / "package.xml").is_file()), None)

    def _scan(self, top: Path) -> dict[str, Path]:
        from urdfkit.description.packages.discovery import packages_below

        if top not in self.scanned:
            self.scanned[top] = found = packages_below(top)
            for name, folder in found.items():
                self.seen.setdefault(name, folder)
        return self.scanned[top]


def _shipped_robots() -> Path | None:
    from urdfkit.resources import robots_dir

    try:
        return robots_dir()
    except ResourceError:
        return None
