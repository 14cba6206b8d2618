// Findings of the linter and repairs: badges on the links, and a list with source lines, rule and fix.

import { h, icon } from "../page/dom.js";
import { excerpt, source } from "./inspector.js";
import { refill } from "../page/edited_fields.js";
import { inline, markdown } from "../page/markdown.js";

const SHIELD = "M12 3l8 3v6c0 4.5-3.3 7.8-8 9-4.7-1.2-8-4.5-8-9V6zM12 8v5M12 16v.1";
const TONES = ["error", "warning", "note"];

const worst = (findings) => TONES.find((tone) => findings.some((finding) => finding.severity === tone)) ?? "";

export function findings(page) {
  const panel = page.panels.add({ id: "findings", title: "Findings", icon: SHIELD, modes: ["view", "sim"], order: 50 });
  const summary = h("p.quiet", { role: "status" }, "Checking …");
  const all = h("button.chip", { type: "button", hidden: true }, "Show all");
  const list = h("ol.findings");
  panel.body.append(h("div.row", {}, summary, all), list);
  let known = [];
  let rules = {};
  let only = null; // a link
  let badges = [];
  const open = new Set(); // codes and locations of expanded rule pages

  page.on("findings", (message) => {
    known = message.findings.map((finding) => ({ ...finding, at: finding.link ?? page.childOf(finding.joint) }));
    for (const finding of known) finding.links = finding.about.length ? [...new Set(finding.about.map(({ link, joint }) => link ?? page.childOf(joint)))] : everywhere(page, finding);
    rules = message.rules;
    page.findings = known;
    page.panels.available("findings", page.mode === "view" || known.length > 0);
    panel.badge(known.length ? String(known.length) : null, worst(known));
    if (only && !known.some((finding) => finding.links.includes(only))) only = null;
    draw(message.fault);
    mark();
  });
  page.on("hello", ({ mode }) => page.panels.available("findings", mode === "view"));
  page.on("robot", mark);
  all.addEventListener("click", () => ((only = null), draw(null)));

  function draw(fault) {
    const shown = only ? known.filter((finding) => finding.links.includes(only)) : known;
    summary.textContent = fault ?? (known.length === 0 ? "No findings." : only ? `${shown.length} about ${only}` : words(known));
    all.hidden = only === null;
    refill(list, shown.map(card));
  }

  function mark() {
    for (const badge of badges) page.labels.remove(badge);
    const links = new Map();
    for (const finding of known) for (const link of finding.links) links.set(link, [...(links.get(link) ?? []), finding]);
    badges = [...links].filter(([link]) => page.scene.byLink.has(link)).map(([link, found]) => {
      const words = `${found.length} finding${found.length > 1 ? "s" : ""} on ${link}`;
      const badge = h("button.badge", { type: "button", title: words, "aria-label": words }, h("span", { "data-tone": worst(found) }, String(found.length)));
      Object.assign(badge.dataset, { link, count: found.length, words, tone: worst(found) });
      badge.addEventListener("click", () => about(link));
      return page.labels.add(badge, () => middle(page, link));
    });
    for (const entry of document.querySelectorAll(".tree .link-entry")) entry.dataset.tone = links.has(entry.dataset.link) ? worst(links.get(entry.dataset.link)) : "";
  }

  function about(link) {
    only = link;
    page.select({ link });
    draw(null);
    page.panels.open("findings");
  }

  function card(finding) {
    const key = `${finding.code} ${finding.file}:${finding.line}`;
    const rule = h("details.rule", { open: open.has(key) }, h("summary", {}, "Rule"), h("div.prose", {}, markdown(rules[finding.code] ?? "")));
    rule.addEventListener("toggle", () => (rule.open ? open.add(key) : open.delete(key)));
    const tone = h("span.tone", {}, finding.severity);
    tone.dataset.tone = finding.severity;
    const place = { ...finding, chain: finding.chains[0] ?? [] };
    const copies = finding.chains.length > 1 ? h("p.quiet", {}, `… and in ${finding.chains.length - 1} more of its expansions`) : null;
    return h(
      "li.finding",
      {},
      h("div.finding-head", {}, tone, h("code", {}, finding.code), h("span.quiet", {}, finding.name)),
      h("p.finding-message", {}, inline(finding.message)),
      finding.links.length ? h("div.chips", {}, finding.links.map((link) => h("button.chip", { type: "button", onclick: () => page.select({ link }) }, link))) : null,
      finding.file ? source(place) : null,
      copies,
      finding.lines.length ? excerpt(finding.lines, finding.line) : null,
      finding.repair && finding.repair !== finding.message ? h("p.help", {}, h("strong", {}, "Repaired: "), inline(finding.repair)) : null,
      finding.help ? h("p.help", {}, inline(finding.help)) : null,
      finding.fix ? fixPanel(finding) : null,
      rules[finding.code] ? rule : null,
    );
  }

  function fixPanel(finding) {
    const { title, safety, diff, may } = finding.fix;
    const lines = diff.filter((line) => !line.startsWith("@@")).map((line) => {
      const row = h("span.code-line", {}, `${line}\n`);
      row.dataset.change = line[0] === "+" ? "in" : "out";
      return row;
    });
    const button = h("button.apply", { type: "button" }, "Apply fix");
    button.addEventListener("click", async () => {
      button.disabled = true;
      try {
        const { done } = await page.connection.request("fix", { finding: finding.number });
        page.toast(`Fixed ${done}`, "good");
      } catch (error) {
        button.disabled = false;
        page.toast(error.message, "error");
      }
    });
    const how = h("p.quiet", {}, safety === "safe" ? "Apply it with " : "This fix is unsafe; review it and apply it with ", h("code", {}, `urdfkit lint --fix${safety === "safe" ? "" : " --unsafe-fixes"}`));
    return h("div.fix", {}, h("p", {}, h("strong", {}, "Fix: "), inline(title)), lines.length ? h("pre.code.diff", { tabindex: "0" }, lines) : null, may ? button : how);
  }
}

function words(findings) {
  const names = { error: ["error", "errors"], warning: ["warning", "warnings"], note: ["note", "notes"] };
  return TONES.map((tone) => [findings.filter((finding) => finding.severity === tone).length, names[tone]])
    .filter(([count]) => count)
    .map(([count, [one, many]]) => `${count} ${count === 1 ? one : many}`)
    .join(", ");
}

/** The links of a finding; in a macro, one per call with the finding. */
function everywhere(page, { at, chains }) {
  if (!at) return [];
  const place = ({ source: { file, line, column } }) => `${file}:${line}:${column}`;
  const first = page.robot?.links.get(at);
  if (!first || chains.length < 2) return [at];
  const wanted = chains.map((chain) => JSON.stringify(chain.map(({ macro, file, line }) => [macro, file, line])));
  const called = (link) => JSON.stringify(link.source.chain.map(({ macro, file, line }) => [macro, file, line]));
  const others = [...page.robot.links.values()].filter((link) => link !== first && place(link) === place(first) && wanted.includes(called(link)));
  return [at, ...others.map((link) => link.name)];
}

/** The centre of the shapes of a link, or the origin of its frame, in the world. */
function middle(page, link) {
  const node = page.scene.byLink.get(link);
  if (!node) return null;
  node.userData.middle ??= page.scene.middle(link);
  node.updateWorldMatrix(true, false);
  return node.localToWorld(node.userData.middle.clone());
}
