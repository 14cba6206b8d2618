"""What a run of xacro that goes on after errors keeps: its faults, what they spoilt, and what it knows by hindsight."""

from __future__ import annotations

import sys
from collections.abc import Mapping

from urdfkit.description.xacro.diagnosis import fault_of
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.expansion import Run
from urdfkit.description.xacro.expressions.excess import TooMany
from urdfkit.description.xacro.faults import Fault, Unprefixed
from urdfkit.description.xacro.placeholders import Unknown
from urdfkit.description.xacro.recursion import Endless
from urdfkit.description.xacro.xacro_frames import Place, place_of_call
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Position
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from typing_extensions import Self

    from urdfkit.description.packages.resolver import Packages


class NotingRun(Run):
    """One expansion that keeps the faults it meets.

    Args:
        path: as the user named it.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``.
        mend_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        hindsight: values of properties, and macros, that an earlier run found defined too late.
        texts: contents to read instead of those on disk, by absolute path.
    """

    def __init__(
        self,
        path: str,
        arguments: Mapping[str, str],
        packages: Packages,
        *,
        mend_prefixes: bool,
        hindsight: tuple[Mapping[str, Any], Mapping[str, Any]] = ({}, {}),
        texts: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(path, arguments, packages, texts=texts)
        self._mend_prefixes = mend_prefixes
        self._late_properties, self._late_macros = hindsight
        self._unprefixed: dict[Unprefixed, None] = {}
        self._unresolved: set[tuple[Position, str | None]] = set()
        self._strangers: set[str] = set()
        self._endless: set[str] = set()
        self._tables: tuple[Any, Any] | None = None
        self._is_full = False

    def expand(self) -> None:
        """Expand the file as far as it goes; xacro's globals have to be lent.

        Raises:
            ResourceError: the file cannot be read.
        """
        try:
            super().expand()
        except XmlError as error:
            self._note(fault_of(error, self, sys._getframe()))
        self._learn()

    def with_hindsight(self) -> Self | None:
        """Return a run that knows what this one found defined too late; None when there is nothing new."""
        properties, macros = self._learned
        if self._is_full or self.evaluator.is_exhausted:
            return None
        if properties.keys() <= self._late_properties.keys() and macros.keys() <= self._late_macros.keys():
            return None
        return type(self)(
            self.path,
            self.arguments,
            self.packages,
            mend_prefixes=self._mend_prefixes,
            hindsight=({**self._late_properties, **properties}, {**self._late_macros, **macros}),
            texts=self.texts,
        )

    def outcome(self) -> Expanded:
        """Return what came of it, with the faults."""
        plain = super().outcome()
        return Expanded(
            **{**vars(plain), "unprefixed": tuple(self._unprefixed), "unresolved": frozenset(self._unresolved)}
        )

    def _learn(self) -> None:
        """Remember the values of what was undefined when used and is defined by now."""
        properties: dict[str, Any] = {}
        macros: dict[str, Any] = {}
        self._learned = properties, macros
        if self._tables is None:
            return
        table_of_macros, table = self._tables
        for kind, name in {(fault.kind, fault.name): None for fault in self.faults.values() if fault.name}:
            if kind == "undefined-property" and dict.__contains__(table, name):
                value = table[name]
                if not isinstance(value, Unknown):
                    properties[name] = value
            elif kind == "undefined-macro" and dict.__contains__(table_of_macros, name):
                macros[name] = dict.__getitem__(table_of_macros, name)
        for name in self._strangers:
            if dict.__contains__(table_of_macros, name):
                macros[name] = dict.__getitem__(table_of_macros, name)

    def _fault(self, error: Exception, node: Any) -> Fault:
        """Diagnose what was raised; which of too many elements, or rounds, was the last is of no interest."""
        if isinstance(error, TooMany) and node is not None:
            return Fault("too-many", str(error), *self.position_of(node))
        fault = fault_of(error, self, sys._getframe(1))
        if isinstance(error, Endless) and error.what == "file":
            return Fault(**{**vars(fault), "position": self.position_of(node)[0]})
        return fault

    def _goes_up(self, error: Exception, files: int, *, is_inside: bool) -> bool:
        """Return whether an error is dealt with further out: what is dropped is what a person wrote, with all it made.

        Args:
            error: what was raised.
            files: how many files include each other here; where one of them does so twice, a round has begun again.
            is_inside: whether this is inside what a person wrote.
        """
        if isinstance(error, Endless) and error.what == "file":
            open_files = [shown_path(file) for file in self.xacro.filestack[:files]]
            return len(set(open_files)) < len(open_files)
        return isinstance(error, TooMany | RecursionError) and is_inside

    def _note(self, fault: Fault) -> None:
        if fault.kind == "too-many":
            if self._is_full:
                return
            self._is_full = True
        # What calls itself twice would be tried a power of two times.
        self._endless.update(fault.details.get("cycle", ()) if fault.kind == "recursion" else ())
        key = (fault.kind, fault.position, fault.attribute, fault.name, fault.message, fault.expansions)
        self.faults.setdefault(key, fault)

    def _note_at(self, place: Place, facts: dict[str, Any]) -> None:
        position, expansions, attribute = self.where(place)
        expression = place.expression
        self._note(Fault(position=position, expansions=expansions, attribute=attribute, expression=expression, **facts))

    def _mark_unresolved(self) -> None:
        place = place_of_call(sys._getframe(2))
        if place.node is not None and place.property is None:
            self._unresolved.add((self.position_of(place.node)[0], place.attribute))

    def _unwind(self, depth: tuple[int, int]) -> None:
        """Forget the files and macros that an error left open."""
        del self.xacro.filestack[depth[0] :]
        del self.xacro.macrostack[depth[1] :]
        self.end_call()
