// The tree of links and joints with search; its selection is synchronized with the viewport.

import { h, icon } from "../page/dom.js";

const TREE = "M6 3v14a2 2 0 0 0 2 2h3M6 8h5M13 5.5h7v5h-7zM13 16.5h7v5h-7z";
const OPEN = "M7 10l5 5 5-5";

export function tree(page) {
  const panel = page.panels.add({ id: "tree", title: "Tree", icon: TREE, order: 20 });
  const search = h("input#tree-search", { type: "search", placeholder: "Find a link or joint", "aria-label": "Find a link or joint", autocomplete: "off", spellcheck: "false" });
  const list = h("ul.tree", { role: "tree", "aria-label": "Links and joints" });
  const none = h("p.quiet", { hidden: true }, "No link or joint matches.");
  panel.body.append(search, list, none);
  let rows = [];

  page.on("robot", (robot) => {
    rows = [];
    list.replaceChildren(branch(robot.kinematics, robot.kinematics.root, null));
    filter();
    mark(page.selected);
  });
  page.on("select", mark);
  page.on("findings", () => mark(page.selected));
  search.addEventListener("input", filter);
  search.addEventListener("keydown", take);
  list.addEventListener("keydown", keys);
  page.shortcut({ key: "/", does: "find a link or joint", modes: ["view", "sim"], group: "Panels", run: () => (page.panels.open("tree"), search.focus()) });

  function branch(kinematics, link, joint) {
    const below = kinematics.below.get(link) ?? [];
    const children = h("ul", { role: "group" });
    const item = h("li", { role: "treeitem", "aria-expanded": below.length ? "true" : null });
    const fold = below.length ? h("button.fold", { type: "button", tabindex: "-1", "aria-label": `Collapse ${link}` }, icon(OPEN)) : h("span.fold");
    fold.addEventListener("click", () => item.setAttribute("aria-expanded", item.getAttribute("aria-expanded") !== "true"));
    const linkButton = h("button.entry.link-entry", { type: "button", tabindex: "-1", onclick: () => page.select({ link }) }, link);
    linkButton.dataset.link = link;
    const line = h("div.tree-line", {}, fold, linkButton);
    rows.push({ item, line, button: linkButton, name: link, selected: (s) => s?.link === link });
    if (joint) {
      const text = `${joint.name}`;
      const jointButton = h("button.entry.joint-entry", { type: "button", tabindex: "-1", title: `${joint.type} joint`, onclick: () => page.select({ joint: joint.name }) }, text, h("small", {}, joint.type));
      jointButton.dataset.joint = joint.name;
      item.append(jointButton);
      rows.push({ item, line: jointButton, button: jointButton, name: joint.name, selected: (s) => s?.joint === joint.name });
    }
    item.append(line);
    for (const next of below) children.append(branch(kinematics, next.child, next));
    if (below.length) item.append(children);
    return item;
  }

  function mark(selected) {
    for (const row of rows) {
      const is = row.selected(selected);
      row.button.toggleAttribute("data-selected", is);
      row.button.setAttribute("aria-current", is);
      row.button.tabIndex = is ? 0 : -1;
      if (is && panel.open) row.button.scrollIntoView({ block: "nearest" });
    }
    if (rows.length && !rows.some((row) => row.button.tabIndex === 0)) rows[0].button.tabIndex = 0;
  }

  // Show the matches and their ancestors.
  function filter() {
    const wanted = search.value.trim().toLowerCase();
    const kept = new Set();
    for (const { item, name } of rows) {
      if (!name.toLowerCase().includes(wanted)) continue;
      for (let at = item; at && at !== list; at = at.parentElement) kept.add(at);
    }
    for (const { item, button, name } of rows) {
      item.hidden = !kept.has(item);
      button.toggleAttribute("data-found", wanted !== "" && name.toLowerCase().includes(wanted));
    }
    none.hidden = kept.size > 0 || rows.length === 0;
  }

  // Enter selects the best match; the arrow keys move through all matches while the search field keeps the focus.
  function take(event) {
    const wanted = search.value.trim().toLowerCase();
    const found = rows.filter(({ name }) => wanted !== "" && name.toLowerCase().includes(wanted));
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if ((!step && event.key !== "Enter") || found.length === 0) return;
    event.preventDefault();
    const now = found.findIndex((row) => row.selected(page.selected));
    const exact = found.findIndex(({ name }) => name.toLowerCase() === wanted);
    const first = now >= 0 ? now : Math.max(0, exact);
    const next = !step ? first : now < 0 ? (step > 0 ? 0 : found.length - 1) : (now + step + found.length) % found.length;
    found[next].button.click();
  }

  function keys(event) {
    const buttons = [...list.querySelectorAll(".entry")].filter((button) => button.checkVisibility());
    const at = buttons.indexOf(document.activeElement);
    const item = document.activeElement?.closest("li");
    const steps = { ArrowDown: 1, ArrowUp: -1, Home: -at, End: buttons.length - 1 - at };
    if (event.key in steps) {
      event.preventDefault();
      const next = buttons[Math.max(0, Math.min(buttons.length - 1, at + steps[event.key]))];
      next?.focus();
      next?.click();
    } else if ((event.key === "ArrowLeft" || event.key === "ArrowRight") && item?.hasAttribute("aria-expanded")) {
      event.preventDefault();
      item.setAttribute("aria-expanded", event.key === "ArrowRight");
    }
  }
}
