"""Meshes of markers: files of packages, read once for the page."""

from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError
from urdfkit.meshes.loader import MeshLoader
from urdfkit.view.content.mesh_store import GeometryStore

PACKAGE = "package://"
MOST = 100
"""Maximum number of files: the messages come from strangers."""


class MarkerMeshes:
    """The meshes that markers name.

    Args:
        packages: where packages are found.
        geometries: receives the meshes; they stay there.
    """

    def __init__(self, packages: Packages, geometries: GeometryStore) -> None:
        self._packages, self._geometries = packages, geometries
        self._loader = MeshLoader(is_for_screen=True)
        self._names: dict[str, str] = {}
        self._faults: dict[str, ResourceError] = {}

    def name(self, uri: str) -> str:
        """Return the name in the store of the mesh at ``package://PACKAGE/FILE``.

        Raises:
            ResourceError: the URI is not that of a file in a package, or the file is not a mesh.
        """
        if uri not in self._names and uri not in self._faults:
            if len(self._names) + len(self._faults) >= MOST:
                raise ResourceError(f"the markers use more than {MOST} meshes")
            try:
                self._names[uri] = self._read(uri)
            except ResourceError as error:
                self._faults[uri] = error
        if uri in self._faults:
            raise self._faults[uri]
        return self._names[uri]

    def _read(self, uri: str) -> str:
        if not uri.startswith(PACKAGE):
            raise ResourceError(f"mesh `{uri[:200]}` is not a file of a package; use {PACKAGE}NAME/FILE")
        folder = self._packages.find(uri.removeprefix(PACKAGE).partition("/")[0]).resolve()
        path = self._packages.resolve(uri, folder).resolve()
        if not path.is_relative_to(folder):
            raise ResourceError(f"mesh `{uri[:200]}` is outside its package")
        return self._geometries.add(self._loader.load(path), keep=True)
