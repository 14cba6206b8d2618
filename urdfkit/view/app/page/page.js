// Page: the shared object of all features, with viewport, panels, messages, selection and shortcuts.

export class Page {
  /** @param viewport the 3-D viewport; @param scene its scene; @param panels the panels */
  constructor(viewport, scene, panels) {
    Object.assign(this, { viewport, scene, panels });
    this.mode = null; // "view" or "sim", set by the first message
    this.model = null; // the last message `model`
    this.selected = null; // {link} or {joint}, by name
    this.connection = null;
    this.requests = null; // names of the requests that the server accepts; null for all
    this.shortcuts = [];
    this.handlers = new Map();
    addEventListener("keydown", (event) => this.#key(event));
    addEventListener("refused", ({ detail }) => this.toast(detail, "error"));
  }

  /**
   * Register a handler for a type of message from the server, or for an event of the page:
   * poses (the links have moved), select ({link} or {joint} or null), hover (a link or null), lost, theme, tool, drawn.
   */
  on(type, handler) {
    if (!this.handlers.has(type)) this.handlers.set(type, []);
    this.handlers.get(type).push(handler);
  }

  /** Call all handlers of a message or event; an error in one handler does not affect the others. */
  emit(type, message) {
    for (const handler of this.handlers.get(type) ?? []) {
      try {
        handler(message);
      } catch (error) {
        reportError(error);
      }
    }
  }

  /** Whether the server accepts a request. */
  accepts(request) {
    return this.requests === null || this.requests.includes(request);
  }

  /** Send a message to the server; see docs/protocol.md. */
  send(type, values) {
    this.connection?.send(type, values);
  }

  /** Select a link or a joint by name, or nothing. */
  select(selected) {
    if (JSON.stringify(selected) === JSON.stringify(this.selected)) return;
    this.selected = selected;
    this.emit("select", selected);
  }

  /** Show a message for a few seconds. */
  toast(text, tone = "") {
    const box = document.getElementById("toast");
    box.textContent = text;
    box.dataset.tone = tone;
    box.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (box.hidden = true), 3000 + 40 * text.length);
  }

  /** Show that a request succeeded, with its warnings. */
  done(words, { warnings = [] } = {}) {
    this.toast([words, ...warnings].join("; "), warnings.length ? "warning" : "good");
  }

  /**
   * Add a keyboard shortcut.
   * @param key value of KeyboardEvent.key; @param does description for the help dialog; @param modes modes in which it is active
   * @param run called with the event; @param group heading in the help dialog
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
