// The extension in a stand-in for the editor: activation, and the preview with the real `urdfkit view`.
"use strict";

const test = require("node:test");
const assert = require("node:assert");
const { spawnSync } = require("node:child_process");
const Module = require("node:module");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");

const command = (process.env.URDFKIT_COMMAND || "urdfkit").split("\n");
const missing = spawnSync(command[0], [...command.slice(1), "--version"]).status !== 0;
const skip = missing && `cannot run \`${command.join(" ")} --version\`; install urdfkit, or set URDFKIT_COMMAND`;
const timeout = 120000; // milliseconds
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "urdfkit-"));
const file = path.join(folder, "a.urdf");
fs.writeFileSync(file, '<robot name="a"><link name="b"/></robot>');

const registered = {};
const panels = [];
const errors = [];
const clients = [];
const uri = { scheme: "file", fsPath: file };
const editor = {
  workspace: {
    getConfiguration: () => ({ get: (name) => ({ command, target: "" })[name] }),
    createFileSystemWatcher: () => ({}),
  },
  window: {
    activeTextEditor: { document: { uri } },
    showErrorMessage: (text) => errors.push(text),
    createWebviewPanel: (_, title) => {
      const panel = { title, webview: { html: "" }, closing: [], reveal: () => (panel.revealed = true) };
      panel.onDidDispose = (run) => panel.closing.push(run);
      panel.dispose = () => panel.closing.forEach((run) => run());
      panels.push(panel);
      return panel;
    },
  },
  commands: { registerCommand: (name, run) => (registered[name] = run) },
  ViewColumn: { Beside: 2 },
};
class LanguageClient {
  constructor(_, __, server, options) {
    clients.push({ server, options });
  }
  async start() {}
  async stop() {}
}
const load = Module._load;
Module._load = (name, ...rest) =>
  name === "vscode" ? editor : name === "vscode-languageclient/node" ? { LanguageClient } : load(name, ...rest);
const extension = require("../src/extension");

test.after(() => fs.rmSync(folder, { recursive: true }));

test("activation starts the language server and registers the commands of package.json", async () => {
  await extension.activate({ subscriptions: [] });
  const listed = require("../package.json").contributes.commands.map((each) => each.command);
  assert.deepStrictEqual(Object.keys(registered).sort(), listed.sort());
  assert.deepStrictEqual(clients[0].server, { command: command[0], args: [...command.slice(1), "lsp"] });
});

test("the preview shows the page of urdfkit view, once for a file, and ends with its panel", { skip, timeout }, async () => {
  registered["urdfkit.preview"]();
  registered["urdfkit.preview"]();
  assert.strictEqual(panels.length, 1);
  assert.strictEqual(panels[0].revealed, true);
  while (panels[0].webview.html === "" && errors.length === 0) await new Promise((done) => setTimeout(done, 50));
  assert.deepStrictEqual(errors, []);
  const address = /src="([^"]+)"/.exec(panels[0].webview.html)[1];
  const response = await fetch(address);
  assert.strictEqual(response.status, 200);
  assert.match(response.headers.get("content-security-policy"), /frame-ancestors \*/);
  await extension.deactivate();
  while (await fetch(address).then(() => true, () => false)) await new Promise((done) => setTimeout(done, 50));
});
