// Renders the Markdown of rule pages: headings, paragraphs, lists, code.

import { h } from "./dom.js";

/** Return the elements of a Markdown text. */
export function markdown(text) {
  const found = [];
  const lines = text.split("\n");
  for (let i = 0; i < lines.length; ) {
    const line = lines[i];
    const heading = line.match(/^(#+)\s+(.*)/);
    if (/^```/.test(line.trim())) {
      const code = [];
      for (i++; i < lines.length && !/^```/.test(lines[i].trim()); i++) code.push(lines[i]);
      i++;
      found.push(h("pre.code", { tabindex: "0" }, code.join("\n")));
    } else if (/^ {4}\S/.test(line)) {
      const code = [];
      for (; i < lines.length && (/^ {4}/.test(lines[i]) || (lines[i] === "" && /^ {4}/.test(lines[i + 1] ?? ""))); i++) code.push(lines[i].slice(4));
      found.push(h("pre.code", { tabindex: "0" }, code.join("\n")));
    } else if (heading) {
      found.push(h(heading[1].length === 1 ? "h3" : "h4", {}, inline(heading[2])));
      i++;
    } else if (/^[-*]\s+/.test(line)) {
      const items = [];
      for (; i < lines.length && lines[i].trim(); i++) {
        const item = lines[i].match(/^[-*]\s+(.*)/);
        if (item) items.push(item[1]);
        else items[items.length - 1] += ` ${lines[i].trim()}`;
      }
      found.push(h("ul", {}, items.map((item) => h("li", {}, inline(item)))));
    } else if (line.trim()) {
      const words = [];
      for (; i < lines.length && lines[i].trim() && !/^(#+\s|```|[-*]\s)/.test(lines[i]); i++) words.push(lines[i].trim());
      found.push(h("p", {}, inline(words.join(" "))));
    } else {
      i++;
    }
  }
  return found;
}

/** Return the parts of a line with `code`. */
export function inline(text) {
  return text.split(/(``[^`]+``|`[^`]+`)/).map((part) => (/^`/.test(part) ? h("code", {}, part.replace(/^`+|`+$/g, "")) : part));
}
