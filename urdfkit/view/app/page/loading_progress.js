// Shows which meshes are being loaded, how many and how large, and which were simplified for the screen.

import { h, short } from "./dom.js";

const DELAY = 400; // ms before anything is shown

export function loading(page) {
  const line = document.getElementById("progress");
  const label = document.getElementById("progress-label");
  const note = h("p.quiet", { id: "simplified", hidden: true });
  page.panels.all.get("show").body.append(note);
  let server = null; // text of the server's progress
  let meshes = null; // text of the meshes that are not loaded yet
  let timer = null;

  function show() {
    timer = null;
    const words = server ?? meshes;
    line.hidden = !words;
    if (label.textContent !== (words ?? "")) label.textContent = words ?? "";
  }
  page.on("progress", (message) => {
    server = message.label;
    show();
  });
  page.scene.downloads.changed = ({ waiting, requested, bytes, link }) => {
    const of = link ? `, now ${link}` : "";
    meshes = waiting ? `Loading meshes: ${requested - waiting} of ${requested}, ${short(bytes / 1e6, 1)} MB${of}` : null;
    if (!waiting) showSimplified();
    if (!line.hidden || !meshes) show();
    else timer ??= setTimeout(show, DELAY);
  };

  function showSimplified() {
    const rows = [...page.scene.simplified].map(([link, [from, to]]) => `${link}: ${to.toLocaleString("en")} of ${from.toLocaleString("en")} triangles`);
    const text = rows.length ? `Simplified for the screen only: ${rows.join("; ")}.` : "";
    if (text && text !== note.textContent) page.toast(text);
    note.textContent = text;
    note.hidden = !text;
  }
}
