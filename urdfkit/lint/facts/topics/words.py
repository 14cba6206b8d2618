"""Words: the names in the related files, the description and the code of their packages."""

import re
from collections import Counter
from collections.abc import Collection
from functools import cached_property
from itertools import islice
from pathlib import Path

from urdfkit.description.packages.related_files import CODE, LAUNCH, package_of
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import code_texts

_NAMING_TOPICS = (*CODE, ".rviz", ".xacro", ".sdf", ".world", ".md", ".lua", ".json")
"""Endings of the other files that can name a topic."""

_NO_TOPIC = r"(?:frame\w*[\"']?\s*(?:[:=>,]|\bvalue=)\s*|\b(?:type|name)=|(?<![\w\"'])type:[ \t]*)[\"']?/?$|<$"
"""Matches the text before a name that is a frame, a type or the name or the tag of an element."""

_MAX_FILES = 400


class Words:
    """Words in the related files, the description and the code of their packages."""

    def __init__(self, model: Model) -> None:
        self._model = model

    def occurs_once(self, word: str) -> bool:
        """Return whether a word occurs in one place of the files, and not in the code of their packages."""
        if self._counts[word] > 1:
            return False
        return not any(re.search(rf"\b{re.escape(word)}\b", text) for text in self._code) and not self._is_cut

    def count_of(self, name: str) -> int:
        """Return how often the rarest part of a name, between underscores, occurs in the files in any name."""
        parts = [part for part in re.split(r"[\W_]+", name) if part]
        counts = Counter(part for word, times in self._counts.items() for part in [*word.split("_")] * times)
        return min((counts[part] for part in parts), default=0)

    def names(self, topic: str, places: Collection[tuple[str, int]], without_rviz: bool = False) -> bool:
        """Return whether a file names a whole topic, apart from places that are known: file and offset.

        Args:
            topic: the topic.
            places: the known places.
            without_rviz: whether RViz files, which only read topics, are ignored.
        """
        pattern = re.compile(rf"(?<![\w/~])(?<!name=[\"'])/?{re.escape(topic)}(?![\w/])")
        model = self._model
        for file, source in {**model.expanded.sources, **model.related_files}.items():
            text = uncommented(source) if file in model.related_files else source.text
            for at in pattern.finditer(text):
                before = source.text[max(source.text.rfind("\n", 0, at.start()), at.start() - 60, 0) : at.start()]
                if (file, at.start()) not in places and not re.search(_NO_TOPIC, before, re.IGNORECASE):
                    return True
        return self.match(pattern.pattern, without_rviz)

    def places_of(self, topic: str) -> int:
        """Return in how many places the files and the code name a whole topic, except as a frame or a type."""
        pattern = re.compile(rf"(?<![\w/~.-])(?:~/|/)?{re.escape(topic)}(?![\w/])")
        sources = {**self._model.expanded.sources, **self._model.related_files}
        texts = [*(source.text for source in sources.values()), *self._code]
        found = ((text, at.start()) for text in texts for at in pattern.finditer(text))
        lines = ((text[max(text.rfind("\n", 0, start), start - 60, 0) : start]) for text, start in found)
        count = sum(not re.search(_NO_TOPIC, before, re.IGNORECASE) for before in lines)
        return count + 1000 * self._is_cut

    def match(self, pattern: str, without_rviz: bool = False) -> bool:
        """Return whether the code, a world or another file besides the related ones matches a pattern."""
        texts = self._code_without_rviz if without_rviz else self._code
        return self._is_cut or any(re.search(pattern, text) for text in texts)

    @cached_property
    def _counts(self) -> Counter[str]:
        sources = {**self._model.expanded.sources, **self._model.related_files}
        return Counter(at for each in sources.values() for at in re.findall(r"\w+", each.text))

    @cached_property
    def _code(self) -> list[str]:
        """Texts of the code and other files that can name a topic, one more than `_MAX_FILES` at most."""
        model = self._model
        folders = {package for file in model.related_files if (package := package_of(Path(file))) is not None}
        read = {str(Path(file).absolute()) for file in model.expanded.sources}
        for folder in folders:
            model.expanded.packages.watch(folder, ".py")
        files = (each for folder in sorted(folders) for each in code_texts(folder, _NAMING_TOPICS, LAUNCH))
        texts = (text for path, text in files if str(path.absolute()) not in read)
        return list(islice(texts, _MAX_FILES + 1))

    @property
    def _code_without_rviz(self) -> list[str]:
        return [text for text in self._code if not text.startswith("Panels:")]

    @property
    def _is_cut(self) -> bool:
        """Whether there is more code than was read, so that every word may occur in it."""
        return len(self._code) > _MAX_FILES
