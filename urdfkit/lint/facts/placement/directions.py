"""Directions in which left and front parts lie, and the part and coordinate that contradict them."""

from collections.abc import Iterable

from urdfkit.description.urdf.robot import Joint
from urdfkit.lint.facts.twins import Twins

_SIDE, _END = 1, 0
"""Coordinates of REP 103: y to the left, x forward."""


class Directions:
    """The coordinates in which most left and right, and most front and rear parts differ.

    Args:
        pairs: the twins of a robot.
    """

    def __init__(self, pairs: Iterable[Twins]) -> None:
        pairs = list(pairs)
        self._directions = {
            are_sides: _direction([pair for pair in pairs if pair.are_sides is are_sides], usual)
            for are_sides, usual in ((True, _SIDE), (False, _END))
        }
        self._roles: dict[tuple[str, bool], float] = {}
        for pair in pairs:
            self._roles[pair.first.name, pair.are_sides] = 1.0
            self._roles[pair.second.name, pair.are_sides] = -1.0

    def contradicted(self, joint: Joint) -> list[int]:
        """Return the coordinates that place a joint on the other side or at the other end."""
        found = []
        for are_sides, (k, sign) in self._directions.items():
            role = self._roles.get((joint.name, are_sides), 0.0)
            if joint.origin.xyz[k] * sign * role < 0.0:
                found.append(k)
        return found

    def wrong_coordinate(self, joint: Joint, pair: Twins) -> int:
        """Return the coordinate of a misplaced joint that has to be changed."""
        if contradicted := self.contradicted(joint):
            return contradicted[0]
        differences = [abs(abs(a) - abs(b)) for a, b in zip(pair.first.origin.xyz, pair.second.origin.xyz, strict=True)]
        return differences.index(max(differences)) if any(differences) else self._directions[pair.are_sides][0]


def _direction(pairs: list[Twins], usual: int) -> tuple[int, float]:
    """Return the coordinate in which most pairs differ, and the sign of the first joint."""
    sums = [0.0, 0.0, 0.0]
    for pair in pairs:
        for k, (a, b) in enumerate(zip(pair.first.origin.xyz, pair.second.origin.xyz, strict=True)):
            sums[k] += (a > b) - (a < b)
    most = max(sums, key=abs)
    return (sums.index(most), most) if most else (usual, 1.0)
