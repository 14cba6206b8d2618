// Number fields that accept a decimal comma or point, and reject invalid and out-of-range input with a message.

import { h } from "./dom.js";

const PLAIN = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** Parse a number, NaN if invalid: 0.5 and 0,5 are equal, 1,234.5 is invalid. */
export function readNumber(text) {
  const written = text.trim().replace("−", "-").replaceAll(/\s/g, "");
  const plain = /^[^.,]*,[^.,]*$/.test(written) ? written.replace(",", ".") : written;
  return PLAIN.test(plain) ? Number(plain) : NaN;
}

/** Return the error message for the text of a number field; empty if it is valid. */
export function wrong(text, { min = null, max = null, unit = "", whole = false } = {}) {
  const value = readNumber(text);
  const with_ = unit ? ` ${unit}` : "";
  if (text.trim() === "") return "enter a number";
  if (Number.isNaN(value)) return `“${text.trim()}” is not a number, such as 0.5`;
  if (whole && !Number.isInteger(value)) return `${value} is not an integer; enter ${Math.floor(value)} or ${Math.ceil(value)}`;
  if (min !== null && value < min) return `${value}${with_} is too small; the minimum is ${Number(min.toPrecision(6))}${with_}`;
  if (max !== null && value > max) return `${value}${with_} is too large; the maximum is ${Number(max.toPrecision(6))}${with_}`;
  return "";
}

/**
 * Create a number field with `valueAsNumber`; "change" events are only delivered for valid numbers.
 * @param bounds {min, max, step, unit, whole} and attributes of the input; "aria-label" is its name
 */
export function numberField({ min = null, max = null, step = null, unit = "", whole = false, ...attributes } = {}) {
  const input = h("input.number", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", ...attributes });
  const bounds = { min, max, unit, whole };
  input.bounds = bounds; // may be changed by the caller
  let good = input.value; // the last valid text
  let writing = false; // whether the user is typing
  Object.defineProperty(input, "valueAsNumber", { get: () => readNumber(input.value) });
  let marked = null; // timer that removes the mark of a rejected value
  const clear = () => {
    clearTimeout(marked);
    input.removeAttribute("aria-invalid");
  };
  const refuse = (event, words) => {
    event.stopImmediatePropagation();
    clearTimeout(marked);
    input.setAttribute("aria-invalid", "true");
    input.dispatchEvent(new CustomEvent("refused", { bubbles: true, detail: words }));
    writing = false;
    if (input.form) return; // keep the text, so that the form is not sent without it
    input.value = good;
    marked = setTimeout(clear, 4000);
  };
  // Typing fires "beforeinput"; scripts and some keyboards change the text without it.
  input.addEventListener("focus", () => {
    if (!wrong(input.value, bounds)) good = input.value;
  });
  input.addEventListener("beforeinput", () => {
    if (!writing && !wrong(input.value, bounds)) good = input.value;
    writing = true;
  });
  input.addEventListener("change", (event) => {
    const words = wrong(input.value, bounds);
    if (words) return refuse(event, named(input, words));
    clear();
    good = input.value = String(readNumber(input.value));
    writing = false;
  });
  // Arrow keys step the value like a native number field; the default step is a tenth of its magnitude.
  input.addEventListener("keydown", (event) => {
    const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const now = readNumber(input.value);
    if (!sign || Number.isNaN(now)) return;
    event.preventDefault();
    const by = step ?? 10 ** (Math.floor(Math.log10(Math.abs(now) || 1)) - 1);
    const next = Math.min(bounds.max ?? Infinity, Math.max(bounds.min ?? -Infinity, now + sign * by));
    input.value = String(Number(next.toPrecision(12)));
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  return input;
}

/** Create a number field below its name and unit. @returns [input, label] */
export function unitField(words, { unit, ...attributes }) {
  const input = numberField({ unit, ...attributes });
  return [input, h("label", {}, `${words} `, input, h("span.unit", {}, unit))];
}

/** Create a form; `run` is called when it is submitted and its numbers are valid. `form.valid()` reports an invalid one. */
export function numberForm(attributes, run, ...children) {
  const form = h("form", { novalidate: true, ...attributes }, ...children);
  form.valid = () => {
    const refused = [...form.querySelectorAll("input.number")].find((input) => wrong(input.value, input.bounds));
    refused?.focus();
    refused?.dispatchEvent(new Event("change", { bubbles: true })); // reports it
    return !refused;
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (form.valid()) run();
  });
  return form;
}

// "mass of chassis [kg]" → "mass of chassis: …"
function named(input, words) {
  const name = (input.getAttribute("aria-label") ?? input.labels?.[0]?.firstChild?.textContent ?? "").replace(/\s*\[[^\]]*\]$/, "").trim();
  return name ? `${name}: ${words}` : words;
}
