"""Noise: mean, deviation, bias and precision of a million samples, for every sensor that has SDF's ``<noise>``."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.description.urdf.parser import parse
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.sim.plugins.sensors.noise import Noise, noise_of

MANY = 1_000_000


def written(inside: str, *, attribute: str = "") -> Noise:
    text = (
        f'<robot><gazebo reference="l"><sensor name="s" type="ray"><ray><noise{attribute}>{inside}</noise></ray>'
        "</sensor></gazebo></robot>"
    )
    sensor = parse(document_of(Source("f", text))).gazebo[0].sensors[0]
    return noise_of(sensor.element.find("ray"), np.random.default_rng(3))


@pytest.mark.parametrize(("mean", "deviation"), [(0.0, 0.01), (0.5, 2.0), (-3.0, 1e-6)])
def test_a_million_samples_have_mean_and_deviation(mean: float, deviation: float) -> None:
    noise = written(f"<type>gaussian</type><mean>{mean}</mean><stddev>{deviation}</stddev>")
    found = noise.on(np.full(MANY, 7.0), np.random.default_rng(5)) - 7.0
    assert found.mean() == pytest.approx(mean, abs=5 * deviation / np.sqrt(MANY) + 1e-12)
    assert found.std() == pytest.approx(deviation, rel=5 / np.sqrt(2 * MANY))


def test_a_bias_is_drawn_once_and_has_its_own_spread() -> None:
    inside = "<type>gaussian</type><bias_mean>1.0</bias_mean><bias_stddev>0.1</bias_stddev>"
    noise = written(inside)
    found = noise.on(np.zeros(10), np.random.default_rng(5))
    assert len(set(found)) == 1
    assert abs(abs(found[0]) - 1.0) < 0.5
    assert written(inside).bias == noise.bias


def test_quantized_readings_are_multiples() -> None:
    noise = written("<stddev>1.0</stddev><precision>0.25</precision>", attribute=' type="gaussian_quantized"')
    found = noise.on(np.zeros(MANY), np.random.default_rng(5)) / 0.25
    assert np.array_equal(found, np.round(found))
    assert found.std() * 0.25 == pytest.approx(np.sqrt(1.0 + 0.25**2 / 12), rel=5 / np.sqrt(2 * MANY))


def test_none_is_none() -> None:
    assert not written("<type>none</type><stddev>9</stddev>")
    assert not written("")
