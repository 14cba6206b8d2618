// The dialog with the keyboard shortcuts (?).

import { h, icon } from "./dom.js";

const QUESTION = "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.1-1.5 2.4M12 17.5v.1M12 3a9 9 0 1 0 0 18a9 9 0 0 0 0-18z";
const NAMES = { " ": "Space", Escape: "Esc", ArrowLeft: "←", ArrowRight: "→" };

export function help(page) {
  const body = h("div.keys");
  const close = h("button", { type: "button", onclick: () => dialog.close() }, "Close");
  const dialog = h("dialog#help", { "aria-labelledby": "help-title" }, h("div.dialog-head", {}, h("h2#help-title", {}, "Keys"), close), body);
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.body.append(dialog);
  const button = h("button.bare#help-open", { type: "button", title: "Keys (?)", "aria-label": "Keys" }, icon(QUESTION));
  button.addEventListener("click", open);
  document.querySelector(".bar").append(button);
  page.shortcut({ key: "?", does: "show the keyboard shortcuts", modes: ["view", "sim"], run: open });
  page.shortcut({ key: "Escape", does: "deactivate the tool, then clear the selection", modes: ["view", "sim"], run: cancel });

  function open() {
    const groups = new Map();
    for (const shortcut of page.shortcuts) {
      if (!shortcut.modes.includes(page.mode)) continue;
      groups.set(shortcut.group, [...(groups.get(shortcut.group) ?? []), shortcut]);
    }
    const lists = [...groups].map(([name, shortcuts]) => h("section", {}, h("h3", {}, name), h("dl", {}, shortcuts.map(row))));
    const mouse = ["drag: rotate the view", "right drag or two fingers: pan the view", "wheel or pinch: zoom", "click: select a link", "double click: centre the view on a point"];
    lists.push(h("section", {}, h("h3", {}, "Mouse and touch"), h("ul.plain", {}, mouse.map((line) => h("li", {}, line)))));
    body.replaceChildren(...lists);
    dialog.showModal();
  }

  function cancel() {
    if (page.tools.held) page.tools.hold(null);
    else page.select(null);
  }
}

function row({ key, does }) {
  return h("div", {}, h("dt", {}, h("kbd", {}, NAMES[key] ?? key)), h("dd", {}, does));
}
