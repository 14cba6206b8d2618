// What every feature of the page gets: the stage, the panels, messages in and out, the selection, shortcuts.

export class Page {
  /** @param stage the 3-D view; @param scene what stands on it; @param panels the panels */
  constructor(stage, scene, panels) {
    Object.assign(this, { stage, scene, panels });
    this.mode = null; // "view" or "sim", from the first message on
    this.model = null; // the last message `model`
    this.selected = null; // {link} or {joint}, by name
    this.connection = null;
    this.shortcuts = [];
    this.heard = new Map();
    addEventListener("keydown", (event) => this.#key(event));
    addEventListener("refused", ({ detail }) => this.toast(detail, "error"));
  }

  /**
   * Hear a message of Python by its type, or an event of the page:
   * poses (the links have moved), select ({link} or {joint} or null), hover (a link or null), lost, theme, tool, drawn.
   */
  on(type, listener) {
    if (!this.heard.has(type)) this.heard.set(type, []);
    this.heard.get(type).push(listener);
  }

  /** Hand a message or an event to all who listen; an error in one of them does not keep it from the others. */
  emit(type, message) {
    for (const listener of this.heard.get(type) ?? []) {
      try {
        listener(message);
      } catch (error) {
        reportError(error);
      }
    }
  }

  /** Send a message to Python; see protocol.py for what it takes. */
  send(type, values) {
    this.connection?.send(type, values);
  }

  /** Select a link or a joint by name, or nothing. */
  select(selected) {
    if (JSON.stringify(selected) === JSON.stringify(this.selected)) return;
    this.selected = selected;
    this.emit("select", selected);
  }

  /** Say something for a few seconds. */
  toast(text, tone = "") {
    const box = document.getElementById("toast");
    box.textContent = text;
    box.dataset.tone = tone;
    box.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (box.hidden = true), 3000 + 40 * text.length);
  }

  /** Say that an order was done, and what is to be known about it. */
  done(words, { remarks = [] } = {}) {
    this.toast([words, ...remarks].join("; "), remarks.length ? "warning" : "good");
  }

  /**
   * Add a key.
   * @param key as KeyboardEvent.key; @param does words for the list under ?; @param modes where it works
   * @param run called with the event; @param group heading in the list
   */
  shortcut({ key, does, modes = ["view"], group = "Page", run }) {
    this.shortcuts.push({ key, does, modes, group, run });
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (document.querySelector("dialog[open]")) return;
    const typing = target.closest("input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select");
    if (typing && event.key !== "Escape") return;
    if (typing) typing.blur();
    if ((event.key === " " || event.key === "Enter") && target.closest("button, summary, a, input")) return;
    const found = this.shortcuts.find(({ key, modes }) => key === event.key && modes.includes(this.mode));
    if (!found || found.run(event) === false) return;
    event.preventDefault();
  }

  /** Make something findable at the console (and in tests) as urdfkit.name. */
  expose(name, value) {
    Object.defineProperty(window.urdfkit, name, { value, configurable: true });
  }
}
