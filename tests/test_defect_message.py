"""Messages that keep their parts."""

import pickle

import pytest

from urdfkit.defect_message import DefectMessage, Suggestion, with_effect
from urdfkit.errors import did_you_mean


def test_a_suggestion_is_kept_with_the_name_in_its_place() -> None:
    message = DefectMessage.of("no joint `elbw`" + did_you_mean("elbw", ["elbow", "wrist"]))
    assert message == "no joint `elbw`; did you mean `elbow`?"
    assert (message.defect, message.suggestion) == ("no joint `elbw`", "; did you mean `elbow`?")
    assert message.suggestion is not None
    assert (message.suggestion.meant, message.suggestion.written) == ("elbow", "elbw")


def test_without_a_similar_name_the_text_stays_as_it_is() -> None:
    message = "no joint `elbw`" + did_you_mean("elbw", ["wheel"])
    assert message == "no joint `elbw`"
    assert DefectMessage.of(message).suggestion is None


@pytest.mark.parametrize("name", ["elbow", "a; did you mean `b`?", "`"])
def test_an_effect_comes_before_the_suggestion_whatever_the_name(name: str) -> None:
    message = with_effect("no joint `elbw`" + Suggestion(name), "it is left out")
    assert message == f"no joint `elbw`; it is left out; did you mean `{name}`?"
    assert message.suggestion is not None
    assert (message.effect, message.suggestion.meant) == ("it is left out", name)


def test_texts_around_a_message_keep_its_parts() -> None:
    message = "macro `m`: " + with_effect("no <boxx>" + Suggestion("<box>"), "it is ignored") + " (in `m`)"
    assert message == "macro `m`: no <boxx>; it is ignored; did you mean <box>? (in `m`)"
    parts = DefectMessage.of(message)
    assert (parts.defect, parts.effect, parts.tail) == ("macro `m`: no <boxx>", "it is ignored", " (in `m`)")
    assert parts.without_effect == "macro `m`: no <boxx>; did you mean <box>? (in `m`)"
    assert parts.inserted(" (twice)") == "macro `m`: no <boxx>; it is ignored (twice); did you mean <box>? (in `m`)"


def test_an_effect_of_a_message_with_a_tail_and_no_suggestion_comes_last() -> None:
    assert with_effect(with_effect("defect", "first") + " (in `m`)", "second") == "defect; first (in `m`); second"


def test_a_message_stays_one_in_another_process() -> None:
    message = with_effect("defect" + Suggestion("name", "nmae"), "effect")
    copy = pickle.loads(pickle.dumps(message))
    assert (copy, copy.effect, copy.suggestion.written) == (message, "effect", "nmae")
