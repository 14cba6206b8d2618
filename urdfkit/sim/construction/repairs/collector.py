"""Collection of the repairs of a simulation, each reported once; or refusal of everything that needs one."""

from collections.abc import Callable

from urdfkit.defect_message import DefectMessage, with_effect
from urdfkit.description.repair_positions import at_attributes
from urdfkit.description.urdf.repair_record import Repair, RepairKind, grouped
from urdfkit.description.xml.source import Position
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.notice import Notice

DENSITY = 1000.0
"""Default density of links without mass [kg/m³]: water."""


class _RefusedError(SimulationError):
    """A robot that needs a repair is refused; perhaps because of a part inside the part that is left out."""

    def __init__(self, defect: str, position: Position | None, code: str | None) -> None:
        super().__init__(f"{defect} (rejected: strict)", position=position, code=code)
        self.defect = defect


class Repairs:
    """Collects the repairs of a simulation.

    Args:
        note: reports a warning to the user.
        strict: refuse robots that need a repair.
        density: density of links without mass [kg/m³].

    Attributes:
        strict: refuse robots that need a repair.
        density: density of links without mass [kg/m³].
        found: the repairs.
    """

    def __init__(self, note: Callable[[str], None], *, strict: bool = False, density: float = DENSITY) -> None:
        self._note = note
        self.strict, self.density = strict, density
        self.found: list[Repair] = []
        self._recorded: set[Repair] = set()

    def add(self, *repairs: Repair) -> None:
        """Record and report repairs that were not recorded before; see `grouped`.

        Raises:
            SimulationError: a repair is a warning, and robots that need one are refused.
        """
        new = [repair for repair in dict.fromkeys(at_attributes(repairs)) if repair not in self._recorded]
        if self.strict and (refused := next((one for one in new if one.severity == "warning"), None)) is not None:
            raise _RefusedError(DefectMessage.of(refused.message).without_effect, refused.position, refused.code)
        self._recorded.update(new)
        self.found += new
        for repair in grouped(new):
            at, cause, package = repair.position, repair.cause, repair.package
            self._note(Notice(str(repair), repair.severity, position=at, cause=cause, package=package))

    def leave_out(
        self,
        error: UrdfkitError,
        effect: str,
        kind: RepairKind,
        code: str | None = None,
        *,
        position: Position | None = None,
    ) -> None:
        """Record that a defective part is ignored.

        Args:
            error: the defect.
            effect: the omission, for the message.
            kind: kind of the omitted part.
            code: code of the lint rule that reports the same defect; None if it depends on the parameter.
            position: source position for an error without position.

        Raises:
            SimulationError: robots that need a repair are refused.
        """
        if self.strict:
            defect = error.defect if isinstance(error, _RefusedError) else error.message
            raise _RefusedError(defect, error.position, error.code) from error
        self.add(Repair(kind, error.code or code, with_effect(error.message, effect), error.position or position))
