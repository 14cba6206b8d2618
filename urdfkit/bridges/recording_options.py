"""Options of a recording: selection of topics, compression, splitting into several files."""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from urdfkit.bus import absolute
from urdfkit.errors import UsageError, did_you_mean

JPEG_QUALITY = 90
"""Quality of JPEG images where none is given; Pillow advises against more than 95."""
_SPLIT = re.compile(r"(\d+(?:\.\d+)?)\s*(s|min|MB|GB)")
_UNITS = {"s": 1.0, "min": 60.0, "MB": 1e6, "GB": 1e9}


@dataclass(frozen=True, slots=True)
class RecordingOptions:
    """Options of a recording.

    Attributes:
        topics: patterns with ``*`` and ``?``; a topic is recorded if its name matches one. Empty: all topics.
        exclude: patterns of topics that are not recorded.
        compression: compress the chunks of the file with zstd, without loss.
        jpeg: record 8-bit images as JPEG of this quality, on the topic ``…/compressed``; None for raw images.
        split_duration: simulated time after which a recording continues in another file [s].
        split_size: size of messages before compression after which it does [bytes].
    """

    topics: tuple[str, ...] = ()
    exclude: tuple[str, ...] = ()
    compression: bool = True
    jpeg: int | None = None
    split_duration: float = math.inf
    split_size: float = math.inf

    @property
    def splits(self) -> bool:
        """Whether a recording may have several files."""
        return min(self.split_duration, self.split_size) < math.inf

    def includes(self, topic: str) -> bool:
        """Whether a topic is recorded."""
        return (not self.topics or _matches(topic, self.topics)) and not _matches(topic, self.exclude)

    def file(self, path: Path, number: int) -> Path:
        """Return the name of a file of the recording, with its number from 0 if it may have several."""
        return path.with_name(f"{path.stem}_{number}{path.suffix}") if self.splits else path

    def unused(self, names: Iterable[str]) -> list[str]:
        """Return a sentence for each pattern that matches no topic, with the nearest name.

        Args:
            names: names of all topics.
        """
        existing = list(names)
        ends = {f"*/{name.rpartition('/')[2]}" for name in existing}
        return [
            f"no topic matches `{pattern}`"
            f"{did_you_mean(absolute(pattern), existing) or did_you_mean(f'*{absolute(pattern)}', sorted(ends))}"
            for pattern in (*self.topics, *self.exclude)
            if not any(_matches(name, (pattern,)) for name in existing)
        ]


def _matches(topic: str, patterns: Iterable[str]) -> bool:
    return any(fnmatchcase(topic, absolute(pattern)) for pattern in patterns)


def parse_split(text: str) -> dict[str, float]:
    """Return `split_duration` or `split_size` for a text such as ``30s``, ``5min``, ``500MB`` or ``2GB``.

    Raises:
        UsageError: it has another form, or is zero.
    """
    found = _SPLIT.fullmatch(text.strip())
    if found is None or not float(found[1]):
        raise UsageError(f"`{text}` is not a duration or size greater than 0, such as 30s, 5min, 500MB or 2GB")
    value = float(found[1]) * _UNITS[found[2]]
    return {"split_duration" if found[2] in ("s", "min") else "split_size": value}
