// Functions that create DOM elements, without templates or a framework.

const SVG = "http://www.w3.org/2000/svg";

/**
 * Create an element: h("button.quiet#go", { type: "button", onclick: go, "aria-label": "Go" }, icon(GO), "Go").
 * Functions become event handlers; booleans set or omit an attribute; other values become attributes.
 */
export function h(spec, attributes = {}, ...children) {
  const [, tag, rest] = spec.match(/^([\w-]*)(.*)$/);
  const element = document.createElement(tag || "div");
  for (const [, mark, name] of rest.matchAll(/([.#])([\w-]+)/g)) {
    if (mark === ".") element.classList.add(name);
    else element.id = name;
  }
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.replace(/^on/, ""), value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else if (value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** A picture of 24 × 24 from the `d` of a path; `stroke` draws its lines instead of filling it. */
export function icon(d, { stroke = true } = {}) {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  if (stroke) svg.classList.add("lines");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", d);
  svg.append(path);
  return svg;
}

/** Create a checkbox with a label. `changed` is called with its state. */
export function check(words, { id, checked = false, title, changed } = {}) {
  const box = h("input", { type: "checkbox", id, checked });
  box.addEventListener("change", () => changed?.(box.checked));
  return { box, label: h("label.check", { title }, box, ` ${words}`) };
}

/** Format a number with at most `digits` decimals, without trailing zeros and without a negative zero. */
export function short(value, digits = 3) {
  const text = String(Number(value.toFixed(digits)));
  return text === "-0" ? "0" : text;
}

/** Like toFixed, but without a negative zero. */
export function fixed(value, digits) {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}
