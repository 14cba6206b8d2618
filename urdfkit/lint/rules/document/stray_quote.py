"""E016 stray-quote-or-markdown."""

import re

from urdfkit.description.xml.element import Element
from urdfkit.lint.fix_builders import new_text, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_BACKTICKS = "`\u2018\u2019\u201c\u201d"
_QUOTES = "\"'"
_INVISIBLE = "[\u00a0\u200b-\u200f\u2060\ufeff]"
_BLANKS = bytes(code for code in range(128) if chr(code).isspace())
_ONE_QUOTE = bytes.maketrans(b"'", b'"')
_STRAY = f"[{_BACKTICKS}]|{_INVISIBLE}"


class StrayQuote(RobotRule):
    """A value contains a stray quote, a backtick or an invisible character.

    ## What it does
    Checks expanded values for a quote on one side only, surrounding backticks or typographic quotes, and invisible
    characters (no-break space, zero-width space).

    ## Why is this bad?
    Such characters often come from text copied from a web page. The name no longer matches, and references to it fail.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="hand"/>
       <joint name="wrist" type="fixed">
         <parent link="base"/>
         <child link="hand"/>
       </joint>
       <gazebo>
         <plugin name="driver" filename="libmy_driver.so">
    -      <joint>"wrist</joint>
    +      <joint>wrist</joint>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: names and numbers never begin or end with these characters.
    """

    code = "E016"
    name = "stray-quote-or-markdown"
    severity = "warning"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each value with a stray character."""
        if not any(_is_suspect(source.text) for source in model.expanded.sources.values()):
            return
        for element in model.robot.element.walk():
            for attribute, value in element.attributes.items():
                clean = _cleaned(value)
                if clean is not None and not model.is_unresolved(element, attribute):
                    fix = new_value(model, element, attribute, clean, "safe")
                    yield self.at(model, element, _message(value, clean), attribute=attribute, fix=fix)
            text = _written(model, element) if element.text and not element.children else ""
            clean = _cleaned(text) if text else None
            if clean is not None and not model.is_unresolved(element):
                fix = new_text(model, element, clean, "safe")
                yield self.at(model, element, f"<{element.tag}>: {_message(text, clean)}", fix=fix)


def _written(model: Model, element: Element) -> str:
    """Return the text of an element as written, including invisible characters that parsing has stripped."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.close is None or tag.children:
        return element.text
    text = model.document(element.origin.position.file).source.text[tag.end : tag.close]
    return text if text.strip() == element.text else element.text


def _is_suspect(text: str) -> bool:
    """Whether a text may contain a stray character; most texts need no regular expression."""
    if "`" in text or ("'" in text and ("'\"" in text or "\"'" in text)) or _has_quotes_outside(text):
        return True
    return not text.isascii() and re.search(_STRAY, text) is not None


def _has_quotes_outside(text: str) -> bool:
    """Whether a quote follows a tag or precedes an end tag, with or without white space between them."""
    # A regular expression takes twenty times as long.
    written = text if text.isascii() else "".join(text.split())
    dense = written.encode(errors="replace").translate(_ONE_QUOTE, _BLANKS)
    return b'"</' in dense or b'>"' in dense


def _cleaned(value: str) -> str | None:
    """Return the value without stray characters, None if it has none."""
    clean = re.sub(_INVISIBLE, "", value).strip(_BACKTICKS)
    if len(clean) > 1 and "\n" not in clean:
        first, last = clean[0], clean[-1]
        if first in _QUOTES and clean.count(first) == 1:
            clean = clean[1:]
        elif last in _QUOTES and clean.count(last) == 1:
            clean = clean[:-1]
    clean = clean.strip()
    return clean if clean and clean != value.strip(" \t\r\n") else None


def _message(value: str, clean: str) -> str:
    invisible = re.search(_INVISIBLE, value)
    if invisible is not None:
        return f"`{clean}` contains an invisible character (U+{ord(invisible[0]):04X})"
    return f"stray quote in `{value.strip()}`; write `{clean}`"
