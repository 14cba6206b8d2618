// Light and dark theme of page and viewport: that of the system, or chosen here.

import { h, icon } from "./dom.js";

const CHOICES = {
  system: ["System", "M4 5h16v11H4zM9 20h6M12 16v4"],
  light: ["Light", "M12 8a4 4 0 1 0 0 8a4 4 0 0 0 0-8zM12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.4 1.4M17.6 17.6L19 19M5 19l1.4-1.4M17.6 6.4L19 5"],
  dark: ["Dark", "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z"],
};
const KEY = "urdfkit-theme";

export function theme(page) {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let choice = read();
  const button = h("button.bare#theme", { type: "button" });
  document.querySelector(".bar").append(button);
  const names = Object.keys(CHOICES);

  function apply() {
    const dark = choice === "system" ? system.matches : choice === "dark";
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    const [words, path] = CHOICES[choice];
    button.replaceChildren(icon(path));
    button.title = `Colours: ${words.toLowerCase()}`;
    button.setAttribute("aria-label", button.title);
    page.viewport.theme(dark);
    page.emit("theme", dark);
  }

  function next() {
    choice = names[(names.indexOf(choice) + 1) % names.length];
    write(choice);
    apply();
  }
  button.addEventListener("click", next);
  system.addEventListener("change", apply);
  page.shortcut({ key: "L", does: "colours: system, light, dark", modes: ["view"], group: "View", run: next });
  apply();
}

// A browser may deny access to its storage.
function read() {
  try {
    const kept = localStorage.getItem(KEY);
    return kept in CHOICES ? kept : "system";
  } catch {
    return "system";
  }
}

function write(choice) {
  try {
    localStorage.setItem(KEY, choice);
  } catch {
    // the choice lasts until the page is closed
  }
}
