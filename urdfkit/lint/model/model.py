"""Model: the robot being linted and every file it was read from."""

from __future__ import annotations

from collections import Counter
from functools import cached_property

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position, Source, Span
from urdfkit.lint.model.element_facts import ElementFacts
from urdfkit.lint.model.mesh_boxes import MeshBoxes
from urdfkit.lint.model.repeated_elements import content_key
from urdfkit.lint.model.tags import Document
from urdfkit.lint.model.xacro_prefix import URDF_CHILDREN, signatures
from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
    from pathlib import Path

    from urdfkit.description.urdf.robot import Joint, Link, Mesh, Vector
    from urdfkit.description.xacro.expanded import Expanded
    from urdfkit.description.xacro.faults import Fault
    from urdfkit.description.xml.source import Expansion
    from urdfkit.lint.model.masked_names import MaskedNames
    from urdfkit.lint.model.neighbouring_descriptions import NeighbouringDescriptions
    from urdfkit.lint.model.placement import Extent, Frame
    from urdfkit.lint.model.tags import Attribute, Tag
    from urdfkit.lint.model.xacro_prefix import Signature


_DROPPING = frozenset(
    (
        *("xml", "undefined-macro", "undefined-block", "include-not-found", "package-not-found", "macro-arguments"),
        *("recursion", "too-many", "conditional"),
    )
)
"""Fault kinds after which elements are missing or superfluous."""

_MAX_DISTINCT = 0.75
"""Proportion of distinct elements above which checking only these saves little."""


@record(eq=False)
class Model:
    """The linted model: the expanded robot, its source files and its package.

    Attributes:
        expanded: result of the expansion with error recovery, with missing ``xacro:`` prefixes added.
        robot: the parsed robot; empty if the files define none.
        target: the consumer of the robot; None for all consumers.
        expand_as_written: expands the robot without adding missing prefixes; see `as_written`.
        release: release of the target (``jazzy``); empty if unspecified.
        texts: absolute path → content that replaces the file on disk.
        facts: facts of elements that an earlier check of the same file may have computed.
        mesh_boxes: bounding boxes of meshes.
    """

    expanded: Expanded
    robot: Robot
    target: str | None = None
    expand_as_written: Callable[[], Robot] | None = field(default=None, repr=False)
    release: str = ""
    texts: Mapping[str, str] = field(default_factory=dict, repr=False)
    facts: ElementFacts = field(default_factory=ElementFacts, repr=False)
    mesh_boxes: MeshBoxes = field(default_factory=MeshBoxes, repr=False)

    @cached_property
    def as_written(self) -> Robot:
        """The robot as other tools read it: directives without ``xacro:`` prefix are not expanded."""
        if self.expand_as_written is None or not self.expanded.unprefixed:
            return self.robot
        return self.expand_as_written()

    @cached_property
    def is_incomplete(self) -> bool:
        """Whether missing elements may be defined elsewhere.

        True if a fault dropped or kept elements, if a <link> or <joint> tag is misspelt, and for files without a link,
        which are fragments included by a robot.
        """
        if not self.robot.links:
            return True
        from urdfkit.lint.model.xacro_prefix import misspelt_in_robot

        if any(self.facts.of(misspelt_in_robot, self.robot.element.children)):
            return True
        faults = (fault for fault in self.expanded.faults if "meant" not in fault.details)
        return any(fault.kind in _DROPPING and fault.details.get("cause") != "unbound prefix" for fault in faults)

    @cached_property
    def unknown_parts(self) -> frozenset[str]:
        """Names of the links and joints that depend on values that xacro could not compute."""
        from urdfkit.lint.model.unknown_parts import unknown_parts

        return unknown_parts(self.robot, self.expanded)

    @cached_property
    def is_damaged(self) -> bool:
        """Whether defined elements may lack parts; missing files and macros lack elements of their own only."""
        kept = _DROPPING - {"package-not-found", "include-not-found", "undefined-macro"}
        return not self.robot.links or any(fault.kind in kept for fault in self.expanded.faults)

    @cached_property
    def encoding_faults(self) -> tuple[Fault, ...]:
        """One fault for each otherwise well-formed file that is not UTF-8."""
        if all(source.flaw is None for source in self.expanded.sources.values()):
            return ()
        from urdfkit.description.encoding_defects import encoding_faults

        return encoding_faults(self.expanded)

    @cached_property
    def faults_by_call(self) -> dict[tuple[str, Position, tuple[Expansion, ...]], list[Fault]]:
        """Kind, position and macro calls → the faults there."""
        found: dict[tuple[str, Position, tuple[Expansion, ...]], list[Fault]] = {}
        for fault in self.expanded.faults:
            found.setdefault((fault.kind, fault.position, fault.expansions), []).append(fault)
        return found

    @cached_property
    def masked_names(self) -> MaskedNames:
        """Names that missing parts of the robot may define; see `masked_names.unless_masked`."""
        from urdfkit.lint.model.masked_names import MaskedNames

        return MaskedNames(self)

    @cached_property
    def neighbouring_descriptions(self) -> NeighbouringDescriptions:
        """The descriptions in neighbouring packages."""
        from urdfkit.lint.model.neighbouring_descriptions import NeighbouringDescriptions

        return NeighbouringDescriptions(self.expanded, self.package, self.related_files)

    @cached_property
    def missing_file(self) -> str:
        """An included file, or its package, that was not found; empty if all were found."""
        for fault in self.expanded.faults:
            if fault.kind in ("include-not-found", "package-not-found"):
                return f"package `{fault.name}`" if fault.kind == "package-not-found" else str(fault.name)
        return ""

    @cached_property
    def package(self) -> Path | None:
        """The package folder of the entry file."""
        from urdfkit.description.packages.related_files import package_of

        return package_of(self.expanded.path)

    def manifest(self, package: Path) -> str:
        """Return the package.xml of a package without comments; empty if it cannot be read."""
        from urdfkit.description.packages.related_files import manifest, uncommented

        text = self.texts.get(str(package / "package.xml"))
        return manifest(package) if text is None else uncommented(text)

    @cached_property
    def related_files(self) -> dict[str, Source]:
        """Shown name → launch, YAML, SRDF and package files of the package and of related packages.

        Without a package, the SRDF files in the folder of the description.
        """
        return self._related[0]

    @cached_property
    def semantic_roots(self) -> dict[str, Element]:
        """Shown name → root element of each well-formed SRDF among the related files, after expansion."""
        return self._related[1]

    @cached_property
    def _related(self) -> tuple[dict[str, Source], dict[str, Element]]:
        from urdfkit.lint.model.related_files import related_files

        return related_files(self.expanded, self.robot, self.package, self.texts)

    def watch(self, *endings: str) -> None:
        """Make size and time of the files of the package with some endings count for the stored result of the lint."""
        if self.package is not None:
            self.expanded.packages.watch(self.package, *endings)

    @cached_property
    def neighbouring_macros(self) -> dict[str, list[Path]]:
        """Macro → files of the package, or of the entry's folder, that define it but are not included."""
        from pathlib import Path

        from urdfkit.lint.project.description_files import SUFFIXES, near_descriptions

        self.watch(*SUFFIXES)
        read = {str(Path(file).absolute()) for file in self.expanded.sources}
        found: dict[str, list[Path]] = {}
        for path, text in near_descriptions(self.package, self.expanded.path):
            if str(path.absolute()) not in read:
                for name, _ in signatures(text):
                    found.setdefault(name, []).append(path.absolute())
        return found

    @cached_property
    def signatures(self) -> dict[str, list[Signature]]:
        """Macro → its signatures in all files, with or without ``xacro:`` prefix."""
        found: dict[str, list[Signature]] = {}
        for source in self.expanded.sources.values():
            for name, signature in signatures(source.text):
                found.setdefault(name, []).append(signature)
        return found

    @cached_property
    def parts(self) -> tuple[Link | Joint, ...]:
        """All links, then all joints."""
        return (*self.robot.links, *self.robot.joints)

    @cached_property
    def elements(self) -> list[Element]:
        """The links, joints and materials with all descendants that URDF defines."""
        found: list[Element] = []
        pending = [part for part in self.robot.element.children if part.tag in ("link", "joint", "material")]
        for element in pending:  # The list grows during the iteration.
            found.append(element)
            allowed = URDF_CHILDREN.get(element.tag)
            if allowed is not None and element.children:
                pending += [child for child in element.children if child.tag in allowed]
        return found

    def key(self, part: Link | Joint | Element) -> Hashable:
        """Return the `content_key` of a link, a joint or another child of the root element."""
        element = part if isinstance(part, Element) else part.element
        found = self._keys.get(element)
        if found is None:
            found = self._keys[element] = content_key(element)
        return found

    @cached_property
    def _keys(self) -> dict[Element, Hashable]:
        return {}

    @cached_property
    def distinct(self) -> Model:
        """The model with one of the elements that calls of a macro make alike; this model if that saves little."""
        robot = self.robot
        if len(robot.link_by_name) < len(robot.links):  # Which of the duplicate links are checked depends on all.
            return self
        children = robot.element.children
        kept = {self.key(child): child for child in reversed(children)}.values()
        return self if len(kept) > _MAX_DISTINCT * len(children) else self.part(frozenset(kept))

    def part(self, kept: Collection[Element]) -> Model:
        """Return a model whose root element has only the children in `kept`."""
        robot = self.robot
        root = robot.element
        part = Robot(
            robot.name,
            tuple([link for link in robot.links if link.element in kept]),
            tuple([joint for joint in robot.joints if joint.element in kept]),
            robot.materials,
            robot.transmissions,
            robot.gazebo,
            robot.ros2_control,
            robot.problems,
            Element(root.tag, root.attributes, [one for one in root.children if one in kept], root.text, root.origin),
            robot.files,
            robot.packages,
            robot.arguments,
        )
        return Model(self.expanded, part, self.target, None, self.release, self.texts, ElementFacts(), self.mesh_boxes)

    @cached_property
    def meshes(self) -> list[tuple[Mesh, Element, Link]]:
        """Every mesh that has a file name, with its ``<mesh>`` element and link."""
        from urdfkit.lint.model.mesh_files import meshes_of

        return [mesh for meshes in self.facts.of(meshes_of, self.robot.links) for mesh in meshes]

    @cached_property
    def frames(self) -> dict[str, Frame]:
        """Link name → its frame in the root link, every joint at zero."""
        from urdfkit.lint.model.placement import frames

        return frames(self.robot)

    @property
    def extents(self) -> dict[str, Extent]:
        """Link name → extent of its shapes; without links that have no shapes or a shape of unknown size."""
        version = self.mesh_boxes.version
        if version not in self._extents:
            self._extents[version] = self._compute_extents()
        self.mesh_boxes.were_used = True
        return self._extents[version]

    @cached_property
    def _extents(self) -> dict[int, dict[str, Extent]]:
        return {}

    def _compute_extents(self) -> dict[str, Extent]:
        from urdfkit.lint.model.placement import extent_of_primitives, extent_with_boxes, meshes_in

        once: Sequence[Link] = self.robot.links
        if len(self.robot.link_by_name) < len(once):  # Which shapes of a duplicate link apply is undefined.
            counts = Counter(link.name for link in once)
            once = [link for link in once if counts[link.name] == 1]
        extents = zip(once, self.facts.of(extent_of_primitives, once, self.key), strict=True)
        found = {link.name: extent for link, extent in extents}
        with_meshes = [
            (link, tuple(map(self.box_of, meshes)))
            for link in once
            if found[link.name] is None and (meshes := meshes_in(link))
        ]
        measured = self.facts.of(extent_with_boxes, with_meshes, lambda each: (self.key(each[0]), each[1]))
        found.update((link.name, extent) for (link, _), extent in zip(with_meshes, measured, strict=True))
        return {name: extent for name, extent in found.items() if extent is not None}

    def box_of(self, mesh: Mesh) -> tuple[Vector, Vector] | None:
        """Return centre and size of a mesh's bounding box [m], scale included; None if it cannot be read."""
        return self.mesh_boxes.box(mesh, self.expanded)

    @cached_property
    def documents_read(self) -> list[str]:
        """The files whose source tags were requested, in order; findings may depend on these tags."""
        return []

    @cached_property
    def _documents(self) -> dict[str, Document]:
        return {}

    def document(self, file: str) -> Document:
        """Return the source tags of one file."""
        self.documents_read.append(file)
        if file not in self._documents:
            source = self.expanded.sources.get(file) or self.related_files.get(file) or Source(file, "")
            self._documents[file] = Document(source)
        return self._documents[file]

    def tag(self, position: Position) -> Tag | None:
        """Return the source tag at a position."""
        return self.document(position.file).tag_at(position.line, position.column)

    def span(self, position: Position, attribute: str | None = None) -> Span:
        """Return the span of an attribute of the tag at `position`; else of the tag; else the position itself."""
        document = self.document(position.file)
        at = position.line, position.column
        tag = document.tag_at(*at) if self._has_syntax_errors else document.start_tag_at(*at)
        if tag is not None:
            return document.span_of(tag, attribute)
        return Span(position.file, position.line, position.column, position.line, position.column + 1)

    @cached_property
    def _has_syntax_errors(self) -> bool:
        return any(fault.kind == "xml" for fault in self.expanded.faults)

    def is_unresolved(self, element: Element, attribute: str | None = None) -> bool:
        """Return whether xacro failed to evaluate the attribute or text, which a fault reports already."""
        return (element.origin.position, attribute) in self.expanded.unresolved

    def literal(self, element: Element, attribute: str) -> Attribute | None:
        """Return the source attribute if it is a literal: no expression, no entity, same value as after expansion."""
        tag = self.tag(element.origin.position)
        written = tag.attributes.get(attribute) if tag is not None else None
        if written is None or written.value != element.get(attribute) or "&" in written.value:
            return None
        return written

    def shown(self, position: Position) -> str:
        """Format a position as ``file:line``."""
        return f"{position.file}:{position.line}"
