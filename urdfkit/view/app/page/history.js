// Undo and redo of changes by the user: joints, poses, insertions, deletions, walls, parameters.

import { h, icon } from "./dom.js";

const UNDO = "M9 14L4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3";
const REDO = "M15 14l5-5-5-5M20 9H10a6 6 0 0 0 0 12h3";
const MOST = 200; // changes that are kept
const MERGE = 1000; // ms within which changes with the same key are one

export class History {
  constructor(page) {
    this.page = page;
    this.done = [];
    this.undone = [];
    this.queue = Promise.resolve(); // steps that are requested quickly follow each other
    const button = (id, path, run) => h("button.bare", { type: "button", id, onclick: run }, icon(path));
    this.buttons = { undo: button("undo", UNDO, () => this.undo()), redo: button("redo", REDO, () => this.redo()) };
    document.querySelector(".bar .space").before(this.buttons.undo, this.buttons.redo);
    addEventListener("keydown", (event) => this.#key(event));
    this.#show();
  }

  /**
   * Add a change that was made.
   * @param words the change, such as "moved box"; @param undo, redo functions that send requests and may return a promise
   * @param key changes with the same key in a row become one
   */
  add({ words, undo, redo, key = null }) {
    const now = performance.now();
    const last = this.done.at(-1);
    if (key !== null && last?.key === key && now - last.time < MERGE && this.undone.length === 0) Object.assign(last, { redo, time: now });
    else this.done.push({ words, undo, redo, key, time: now });
    this.done.splice(0, this.done.length - MOST);
    this.undone = [];
    this.#show();
  }

  undo() {
    return (this.queue = this.queue.then(() => this.#step(this.done, this.undone, "undo")));
  }

  redo() {
    return (this.queue = this.queue.then(() => this.#step(this.undone, this.done, "redo")));
  }

  async #step(from, to, name) {
    const change = from.at(-1);
    if (!change) return;
    try {
      await change[name]();
      to.push(from.pop());
      this.page.toast(`${name === "undo" ? "Undone" : "Redone"}: ${change.words}`);
    } catch (error) {
      this.page.toast(error.message, "error");
    }
    this.#show();
  }

  #show() {
    for (const [name, list] of [["undo", this.done], ["redo", this.undone]]) {
      const change = list.at(-1);
      const verb = name === "undo" ? "Undo" : "Redo";
      const words = change ? `${verb}: ${change.words}` : verb;
      const button = this.buttons[name];
      button.disabled = !change;
      button.title = `${words} (${name === "undo" ? "Ctrl+Z" : "Ctrl+Shift+Z"})`;
      button.setAttribute("aria-label", words);
    }
  }

  #key(event) {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || document.querySelector("dialog[open]")) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    // A text field that was changed has its own undo.
    const field = event.target instanceof Element && event.target.closest("input[type=search], input[type=text], textarea");
    if (field && field.value !== field.defaultValue) return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.redo();
    else this.undo();
  }
}

export function history(page) {
  page.history = new History(page);
  page.expose("history", page.history);
}
