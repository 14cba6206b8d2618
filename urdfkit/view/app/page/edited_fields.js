// Fields and buttons that the user has reached while messages arrive: a message replaces no text that is not complete, and
// the focus stays where it is.

import { h } from "./dom.js";

const waiting = new Map(); // element → its newest drawing that is not done yet

/** Whether a field in an element, or the element itself, has the focus. Checkboxes have no incomplete state. */
export function edited(element) {
  const { activeElement: field } = document;
  return element.contains(field) && field.matches("select, textarea, input:not([type=checkbox], [type=radio])");
}

/** Draw the change of a message in an element: now or, while the user edits it, when the focus leaves it. */
export function redraw(element, draw) {
  waiting.delete(element);
  if (edited(element)) waiting.set(element, draw);
  else draw();
}

/** Offer choices in a select, [[value, words]]. The value is kept if it is among them. `done` is called after a change. */
export function offer(select, choices, done = null) {
  redraw(select, () => {
    const { value: before, options } = select;
    if (choices.length === options.length && choices.every(([value, words], i) => value === options[i].value && words === options[i].text)) return;
    select.replaceChildren(...choices.map(([value, words]) => h("option", { value }, words)));
    if (choices.some(([value]) => value === before)) select.value = before;
    done?.();
  });
}

/** Replace the children of a list. The focus goes to the button or field with the same words, else to the next one. */
export function refill(list, items) {
  const all = () => [...list.querySelectorAll("button, input, select, summary, [tabindex]")];
  const words = (element) => element.getAttribute("aria-label") ?? element.textContent;
  const { activeElement: focused } = document;
  const at = all().indexOf(focused);
  list.replaceChildren(...items);
  if (at < 0) return;
  const now = all();
  (now.find((each) => words(each) === words(focused)) ?? now[Math.min(at, now.length - 1)])?.focus({ preventScroll: true });
}

// A typed number is newer than the messages before it.
addEventListener("change", ({ target }) => waiting.delete(target), { capture: true });
addEventListener("focusout", ({ relatedTarget: next }) => {
  for (const [element, draw] of waiting) if (!element.contains(next)) waiting.delete(element), draw();
});
