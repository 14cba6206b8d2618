"""Duration of a compilation, as announced before it starts."""

import os


def announced_duration(seconds: float) -> str:
    """Return the approximate duration of a compilation in one thread, e.g. ``about 50 s``, at the load of the machine.

    Args:
        seconds: measured duration on an idle machine [s].
    """
    slowdown = (_load() + 1.0) / (os.cpu_count() or 1)
    if slowdown < 1.5:
        return f"about {seconds:.0f} s"
    expected = seconds * slowdown
    rounded = f"{expected:.2g} s" if expected < 100.0 else f"{expected / 60.0:.0f} min"
    return f"about {rounded} at the present load of this machine"


def _load() -> float:
    """Return the mean number of busy threads of the last minute; 0 on systems that do not measure it."""
    try:
        return os.getloadavg()[0]
    except (AttributeError, OSError):  # AttributeError: Windows
        return 0.0
