// Fields for numbers: a decimal comma is as good as a point; what is no number, or out of bounds, is said and not taken.

import { h } from "./dom.js";

const PLAIN = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The number that a person wrote, NaN where it is none: 0.5 and 0,5 are the same, 1,234.5 is neither. */
export function readNumber(text) {
  const written = text.trim().replace("−", "-").replaceAll(/\s/g, "");
  const plain = /^[^.,]*,[^.,]*$/.test(written) ? written.replace(",", ".") : written;
  return PLAIN.test(plain) ? Number(plain) : NaN;
}

/** What is wrong with a number that was written, in words; nothing where it is fine. */
export function wrong(text, { min = null, max = null, unit = "", whole = false } = {}) {
  const value = readNumber(text);
  const with_ = unit ? ` ${unit}` : "";
  if (text.trim() === "") return "a number is missing";
  if (Number.isNaN(value)) return `“${text.trim()}” is no number, such as 0.5`;
  if (whole && !Number.isInteger(value)) return `${value} is no whole number: ${Math.floor(value)} or ${Math.ceil(value)}`;
  if (min !== null && value < min) return `${value}${with_} is too little; the least is ${Number(min.toPrecision(6))}${with_}`;
  if (max !== null && value > max) return `${value}${with_} is too much; the most is ${Number(max.toPrecision(6))}${with_}`;
  return "";
}

/**
 * Make a field for a number. It has `valueAsNumber`; its listeners of "change" hear of numbers only.
 * @param bounds {min, max, step, unit, whole} and what else an input takes; "aria-label" says what it is
 */
export function numberField({ min = null, max = null, step = null, unit = "", whole = false, ...attributes } = {}) {
  const input = h("input.number", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", ...attributes });
  const bounds = { min, max, unit, whole };
  input.bounds = bounds; // whoever made it may change them
  let good = input.value; // what stood there before a person began to write
  let writing = false;
  Object.defineProperty(input, "valueAsNumber", { get: () => readNumber(input.value) });
  let marked = null; // until when it is marked as refused
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
    if (input.form) return; // it stays, so that the form is not sent without it
    input.value = good;
    marked = setTimeout(clear, 4000);
  };
  // Typing says so before the text changes; what writes otherwise (pasting by script, some keyboards) does not.
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
  // As fields of the browser's own do; where there is no step it is a tenth of the size of the number.
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

// "mass of chassis [kg]" → "mass of chassis: …"
function named(input, words) {
  const name = (input.getAttribute("aria-label") ?? input.labels?.[0]?.firstChild?.textContent ?? "").replace(/\s*\[[^\]]*\]$/, "").trim();
  return name ? `${name}: ${words}` : words;
}
