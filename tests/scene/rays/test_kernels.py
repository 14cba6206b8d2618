"""The cache of the ray kernels."""

import pytest

pytest.importorskip("numba")

from urdfkit.scene.rays import cached, kernels, warmup


def test_the_kernels_are_cached_once_they_are_compiled(monkeypatch) -> None:
    warmup()
    assert cached()
    monkeypatch.setattr(kernels, "sources_digest", lambda: "0" * 64)
    assert not cached()
