// The panel of topics: rates, the last message of the selected topic, a form to publish.

import { h, short } from "../page/dom.js";
import { Form } from "./message_form.js";

const TOPICS = "M4 6h10M4 12h16M4 18h7M18 4l2 2-2 2M15 16l2 2-2 2";

export class Topics {
  constructor(page) {
    this.page = page;
    this.rows = new Map();
    this.chosen = null;
    this.panel = page.panels.add({ id: "topics", title: "Topics", icon: TOPICS, modes: ["sim"], order: 25 });
    this.filter = h("input", { type: "search", id: "topic-filter", placeholder: "Filter topics", "aria-label": "Filter topics", autocomplete: "off", spellcheck: "false" });
    this.filter.addEventListener("input", () => this.#filter());
    this.list = h("ul.bare-list.topics", { "aria-label": "Topics" });
    this.detail = h("section.topic-detail", { hidden: true });
    const other = h("button.wide", { type: "button", id: "publish-new", onclick: () => this.#other() }, "Publish to another topic …");
    this.panel.body.append(this.filter, this.list, other, this.detail);
    page.on("topics", (message) => this.#take(message.rows));
    page.on("echo", (message) => this.#echo(message));
    page.on("hello", () => page.whileOpen(this.panel, "topics"));
  }

  #take(rows) {
    const seen = new Set();
    for (const [name, type, count, rate, subscribers] of rows) {
      seen.add(name);
      const row = this.rows.get(name) ?? this.#row(name, type);
      row.rate.textContent = rate > 0 ? `${short(rate, rate < 10 ? 1 : 0)} Hz` : count ? "silent" : "never";
      row.item.title = `${type}\n${count} messages, ${subscribers} subscribers`;
      row.item.dataset.silent = rate === 0;
    }
    for (const [name, { item }] of this.rows) if (!seen.has(name)) item.remove(), this.rows.delete(name);
    this.#filter();
  }

  #row(name, type) {
    const rate = h("span.rate.quiet", {}, "");
    const button = h("button.topic", { type: "button" }, h("span.name", {}, ...name.split(/(?<=\/)/).flatMap((part) => [h("wbr"), part])), rate);
    button.addEventListener("click", () => this.choose(this.chosen?.name === name ? null : { name, type }));
    const row = { item: h("li", { "data-topic": name }, button), rate, type };
    this.rows.set(name, row);
    this.list.append(row.item);
    return row;
  }

  #filter() {
    const words = this.filter.value.toLowerCase();
    for (const [name, { item, type }] of this.rows) item.hidden = !`${name} ${type}`.toLowerCase().includes(words);
  }

  /** Show a topic: its last message, the form, its numbers to plot. */
  async choose(topic) {
    if (this.chosen) this.page.connection.subscribe(`echo:${this.chosen.name}`, false);
    this.chosen = topic;
    for (const [name, { item }] of this.rows) item.toggleAttribute("data-chosen", name === topic?.name);
    this.detail.hidden = !topic;
    if (!topic) return;
    this.page.connection.subscribe(`echo:${topic.name}`, true);
    this.message = h("pre.message", { tabindex: 0, "aria-label": `Last message of ${topic.name}` }, "no message yet");
    this.count = h("span.quiet");
    const publish = h("details.publish", { id: "publish", hidden: !this.page.accepts("publish") }, h("summary", {}, "Publish"));
    const plot = h("details.numbers", { id: "numbers" }, h("summary", {}, "Plot a number"));
    const head = h("div.row", {}, h("h3", {}, topic.name), h("span.space"), this.count);
    this.detail.replaceChildren(head, h("p.quiet.type", {}, topic.type), this.message, plot, publish);
    for (const each of [this.rows.get(topic.name)?.item, this.detail]) each?.scrollIntoView({ block: "nearest" });
    try {
      const { message, numbers } = await this.page.connection.request("form", { topic: topic.name, type: topic.type });
      if (this.chosen !== topic) return;
      publish.append(this.#form(topic, message));
      plot.append(this.#numbers(topic, numbers));
    } catch (error) {
      publish.append(h("p.quiet", {}, error.message));
    }
  }

  #form(topic, message) {
    const form = new Form(message);
    const send = h("button.main", { type: "submit" }, "Publish");
    const body = h("form", { "aria-label": `Publish to ${topic.name}` }, form.element, send);
    body.addEventListener("submit", (event) => {
      event.preventDefault();
      new Promise((done) => done(form.value))
        .then((message) => this.page.connection.request("publish", { topic: topic.name, type: topic.type, message }))
        .then(() => this.page.toast(`published to ${topic.name}`, "good"))
        .catch((error) => this.page.toast(error.message, "error"));
    });
    return body;
  }

  #numbers(topic, numbers) {
    const list = h("ul.bare-list.paths");
    for (const path of numbers) {
      const button = h("button.bare", { type: "button", title: `Plot ${path}` }, path);
      button.addEventListener("click", () => this.page.plots.add(topic.name, path));
      list.append(h("li", {}, button));
    }
    return numbers.length ? list : h("p.quiet", {}, "The message has no numbers.");
  }

  #other() {
    const topic = h("input", { placeholder: "/topic", "aria-label": "Topic", required: true });
    const type = h("input", { placeholder: "geometry_msgs/msg/Twist", "aria-label": "Type", required: true });
    const go = h("form.other", {}, topic, type, h("button.main", { type: "submit" }, "Create the form"));
    go.addEventListener("submit", (event) => {
      event.preventDefault();
      this.choose({ name: topic.value, type: type.value });
    });
    this.detail.replaceChildren(go);
    this.detail.hidden = false;
  }

  #echo({ topic, count, message }) {
    if (topic !== this.chosen?.name) return;
    this.count.textContent = `${count}`;
    if (getSelection()?.containsNode(this.message, true) && !getSelection().isCollapsed) return; // the user has selected text to copy
    this.message.textContent = message === null ? "no message yet" : yaml(message);
  }
}

/** Format a message like ROS, nested by indentation. */
export function yaml(value, depth = 0) {
  const pad = "  ".repeat(depth);
  if (Array.isArray(value)) {
    if (value.every((entry) => typeof entry !== "object")) return ` [${value.map((entry) => (typeof entry === "number" ? short(entry, 5) : entry)).join(", ")}]`;
    return value.map((entry) => `\n${pad}-${typeof entry === "object" ? yaml(entry, depth + 1) : ` ${entry}`}`).join("");
  }
  if (value === null || typeof value !== "object") return ` ${typeof value === "number" ? short(value, 6) : value}`;
  const lines = Object.entries(value).map(([name, entry]) => `${pad}${name}:${yaml(entry, depth + 1)}`);
  return (depth ? "\n" : "") + lines.join("\n");
}

export function topics(page) {
  page.topics = new Topics(page);
  page.expose("topics", page.topics);
}
