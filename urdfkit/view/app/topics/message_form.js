// A form for a message: a field for every value, nested like the message.

import { h } from "../page/dom.js";
import { numberField, readNumber } from "../page/number_field.js";

export class Form {
  /** @param message an empty message, whose values define the types of the fields */
  constructor(message) {
    this.readers = [];
    this.element = h("div.fields", {}, ...this.#fields(message, []));
    this.message = message;
  }

  #fields(message, path) {
    return Object.entries(message).map(([name, value]) => {
      const at = [...path, name];
      if (value !== null && typeof value === "object" && !Array.isArray(value)) {
        return h("fieldset", {}, h("legend", {}, name), ...this.#fields(value, at));
      }
      return this.#field(name, value, at);
    });
  }

  #field(name, value, at) {
    const words = at.join(".");
    let input;
    let read;
    if (typeof value === "boolean") {
      input = h("input", { type: "checkbox", checked: value });
      read = () => input.checked;
    } else if (typeof value === "number") {
      input = numberField({ value });
      read = () => {
        const written = readNumber(input.value);
        if (Number.isNaN(written)) throw new Error(`${words}: “${input.value}” is not a number, such as 0.5`);
        return written;
      };
    } else if (Array.isArray(value)) {
      input = h("textarea", { rows: 1, spellcheck: "false", placeholder: "[]" });
      input.value = JSON.stringify(value);
      read = () => {
        try {
          return JSON.parse(input.value || "[]");
        } catch {
          input.setAttribute("aria-invalid", "true");
          throw new Error(`${words} is not a list, such as [1, 2]`);
        }
      };
      input.addEventListener("input", () => input.removeAttribute("aria-invalid"));
    } else {
      input = h("input", { type: "text", value: value ?? "" });
      read = () => input.value;
    }
    input.setAttribute("aria-label", words);
    this.readers.push([at, read]);
    return h("label.value", {}, h("span", {}, name), input);
  }

  /** The entered message. */
  get value() {
    const filled = {};
    for (const [path, read] of this.readers) {
      let at = filled;
      for (const name of path.slice(0, -1)) at = at[name] ??= {};
      at[path.at(-1)] = read();
    }
    return filled;
  }
}
