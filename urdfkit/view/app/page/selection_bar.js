// The bar at the bottom of the viewport: the selected link or joint and its actions.

import { h, icon } from "./dom.js";

const TARGET = "M12 5a7 7 0 1 0 0 14a7 7 0 0 0 0-14zM12 2v6M12 16v6M2 12h6M16 12h6";
const CARD = "M4 5h16v14H4zM8 9h8M8 12.5h8M8 16h5";
const CUBE = "M12 3l8 4.5v9L12 21l-8-4.5v-9zM12 12l8-4.5M12 12v9M12 12L4 7.5";
const CLOSE = "M6 6l12 12M18 6L6 18";

export function selection(page) {
  const strip = h("div#selection", { role: "group", "aria-label": "Selection", hidden: true });
  document.getElementById("viewport").append(strip);
  page.on("select", show);

  function show(selected) {
    const name = selected?.link ?? selected?.joint;
    strip.hidden = !name;
    if (strip.hidden) return;
    const inWorld = name.startsWith("world/");
    const button = (words, path, run) => h("button.bare", { type: "button", title: words, "aria-label": words, onclick: run }, icon(path));
    strip.replaceChildren(
      h("span.selected-name", { title: name }, h("small", {}, selected.link ? "link" : "joint"), h("bdi", {}, name.replace(/^world\//, ""))),
      inWorld ? button("Move or delete", CUBE, () => page.panels.open("world")) : button("Inspect", CARD, () => page.panels.open("inspect")),
      button("Centre the view", TARGET, () => look(selected)),
      button("Clear the selection", CLOSE, () => page.select(null)),
    );
  }

  function look(selected) {
    const link = selected.link ?? page.childOf(selected.joint);
    page.cameras.look(link);
  }

  page.shortcut({ key: "e", does: "centre the view on the selection", group: "View", run: () => page.selected && look(page.selected) });
}
