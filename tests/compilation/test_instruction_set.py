"""The level of x86-64 that kernels are compiled for."""

from __future__ import annotations

import numba
import pytest
from llvmlite import binding
from numba.core.registry import cpu_target

from urdfkit.compilation import compile_or_load
from urdfkit.compilation.codegen import fixed_level
from urdfkit.compilation.instruction_set import LEVELS, NATIVE, level

FLOATS = (numba.float64[::1],)


@pytest.fixture
def fresh():
    level.cache_clear()
    yield
    level.cache_clear()


@pytest.fixture
def host(monkeypatch, fresh):
    """Make this a processor with all of the first level but these features."""

    def without(*features):
        has = dict.fromkeys((*LEVELS["x86-64-v3"], "avx512f"), True) | dict.fromkeys(features, False)
        monkeypatch.setattr(binding, "get_host_cpu_features", lambda: has)

    monkeypatch.setattr(numba.config, "ENABLE_AVX", 1)
    monkeypatch.setattr(numba.config, "CPU_NAME", None)
    monkeypatch.setattr(numba.config, "CPU_FEATURES", None)
    return without


def total(values):
    found = 0.0
    for k in range(len(values)):
        found += values[k] * values[k]
        values[k] *= 3.0
    return found


@pytest.mark.parametrize(
    ("features", "expected"),
    [
        ((), "x86-64-v3"),
        (("avx512f",), "x86-64-v3"),
        (("fma",), "x86-64-v2"),
        (("avx2", "bmi2"), "x86-64-v2"),
        (("avx2", "sse4.2"), "x86-64"),
    ],
)
def test_the_best_level_that_the_processor_has_all_of(host, features, expected):
    host(*features)
    assert level() == expected


def test_settings_of_numba_come_first(host, monkeypatch):
    host()
    monkeypatch.setenv("NUMBA_ENABLE_AVX", "0")
    assert level() == "x86-64-v2"
    level.cache_clear()
    monkeypatch.setenv("NUMBA_CPU_NAME", "znver4")
    assert level() == NATIVE


def test_a_processor_of_which_nothing_is_known_has_the_least(host, monkeypatch):
    def unknown():
        raise RuntimeError

    monkeypatch.setattr(binding, "get_host_cpu_features", unknown)
    assert level() == "x86-64"


@pytest.mark.skipif(level() != "x86-64-v3", reason="this processor is below the first level, or numba is configured")
def test_kernels_have_no_instruction_beyond_the_level(tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    compiled = compile_or_load(total, FLOATS, digest="0" * 16, options={"fastmath": True, "error_model": "numpy"})
    library = compiled.overloads[FLOATS].library
    text = library.get_asm_str()
    assert "ymm" in text
    assert "zmm" not in text
    assert not [register for register in range(16, 32) if f"%ymm{register}" in text or f"%xmm{register}" in text]
    assert any("_x86_64_v3_" in path.name for path in tmp_path.rglob("*.nbi"))


@pytest.mark.skipif(level() == NATIVE, reason="another architecture, or numba is configured")
def test_functions_of_others_are_compiled_as_numba_does():
    target = cpu_target.target_context
    native, subroutines = target.codegen(), target.cached_internal_func
    with fixed_level():
        assert target.codegen() is not native
    assert target.codegen() is native
    assert target.cached_internal_func is subroutines
    other = numba.njit(lambda x: x + 1.0)
    other.compile((numba.float64,))
    assert other.overloads[(numba.float64,)].library.codegen.magic_tuple() == native.magic_tuple()
