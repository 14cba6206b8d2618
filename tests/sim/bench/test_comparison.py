"""How settings are chosen and ratios are made, with engines that say how fast they are."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import pytest

from tests.bench.peers import peer_engines as module
from tests.bench.peers.comparison import Compared, Scaled, Speed
from tests.bench.peers.peer_engines import choose
from tests.bench.peers.scene import Check, Running, Scene

FINE = Check("speed", 1.0, 1.0, 0.1, "m/s")
OFF = Check("speed", 0.5, 1.0, 0.1, "m/s")


class Paper(Running):
    """An engine that computes nothing, as fast as its settings say."""

    def __init__(self, scene: Scene, settings: str) -> None:
        super().__init__(scene)
        self.settings = settings

    def many(self, steps: int) -> None: ...
    def one_by_one(self, steps: int) -> None: ...
    def set_targets(self, k: int, number: int) -> None: ...
    def knock(self, k: int, speed: float) -> None: ...
    def asleep(self) -> int | None: ...
    def position(self, k: int, joint: str) -> float:
        return 0.0

    def base(self, k: int) -> tuple[float, ...]:
        return (0.0,) * 7


@dataclass
class PaperPeer:
    """Offers settings, and variations of some of them."""

    first: tuple[str, ...]
    variations: Mapping[str, tuple[str, ...]]
    name: str = "paper"
    label: str = "Paper"

    def version(self) -> str:
        return "1"

    def settings(self, scene: Scene) -> Iterator[str]:
        yield from self.first

    def refined(self, settings: str) -> Iterator[str]:
        yield from self.variations.get(settings, ())

    def build(self, scene: Scene) -> Callable[[str], Running]:
        return lambda settings: Paper(scene, settings)


def scene_right_for(*right: str) -> Scene:
    def check(running: Running) -> tuple[Check, ...]:
        assert isinstance(running, Paper)
        return (FINE if running.settings in right else OFF,)

    return Scene("paper", "nothing happens", (), check)


@pytest.fixture
def rates(monkeypatch: pytest.MonkeyPatch) -> dict[str, float]:
    found: dict[str, float] = {}
    monkeypatch.setattr(module, "rate", lambda running, seconds: found[running.settings])
    return found


def test_the_fastest_settings_that_are_right_are_chosen(rates: dict[str, float]) -> None:
    rates |= {"slow": 1.0, "good": 2.0, "wild": 9.0}
    choice = choose(PaperPeer(("slow", "good", "wild"), {}), scene_right_for("slow", "good"))
    assert choice.best.settings == "good"
    assert choice.faster is not None
    assert choice.faster.settings == "wild"


def test_variations_of_the_fastest_are_tried(rates: dict[str, float]) -> None:
    rates |= {"slow": 1.0, "good": 2.0, "better": 3.0}
    choice = choose(PaperPeer(("slow", "good"), {"good": ("better",)}), scene_right_for("slow", "good", "better"))
    assert choice.best.settings == "better"
    assert choice.faster is None


def test_where_none_is_right_the_fastest_is_chosen(rates: dict[str, float]) -> None:
    rates |= {"slow": 1.0, "wild": 9.0}
    choice = choose(PaperPeer(("slow", "wild"), {}), scene_right_for())
    assert choice.best.settings == "wild"
    assert not choice.best.right
    assert choice.faster is None


def test_settings_that_go_wrong_later_are_not_chosen(rates: dict[str, float]) -> None:
    rates |= {"steady": 1.0, "fickle": 2.0}
    looks = []

    def check(running: Running) -> tuple[Check, ...]:
        assert isinstance(running, Paper)
        looks.append(running.settings)
        return (OFF if running.settings == "fickle" and looks.count("fickle") > 2 else FINE,)

    choice = choose(PaperPeer(("steady", "fickle"), {}), Scene("paper", "", (), check))
    assert choice.best.settings == "steady"


def speed(engine: str, single: tuple[float, ...], many: tuple[float, ...]) -> Speed:
    return Speed(engine, "", (FINE,), None, single, many)


def test_a_ratio_is_the_median_of_those_of_the_rounds() -> None:
    # The machine was half as fast in the second round: what was measured side by side is compared.
    ours = speed("urdfkit", (4.0, 2.0, 5.0), (8.0, 4.0, 9.0))
    compared = Compared(scene_right_for(), (ours, speed("paper", (2.0, 1.0, 2.0), (2.0, 1.0, 2.0))))
    assert compared.ratio("paper", at_once=False) == 2.0
    assert compared.ratio("paper", at_once=True) == 4.0


def test_growth_is_the_cost_of_the_last_by_that_of_the_first() -> None:
    assert Scaled("urdfkit", "", True, (2.0, 2.5, 3.0)).growth == 1.5
