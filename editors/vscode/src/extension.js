// The extension: starts `urdfkit lsp`, and shows the page of `urdfkit view` beside the file.
"use strict";

const { spawn } = require("child_process");
const path = require("path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { addressIn, commandLine, previewPage, serverWords } = require("./commands");

let client;
const previews = new Map();

function settings() {
  return vscode.workspace.getConfiguration("urdfkit");
}

async function startClient() {
  const { program, words } = commandLine(settings().get("command"), ...serverWords(settings().get("target")));
  const pattern = "**/*.{urdf,xacro,srdf}";
  client = new LanguageClient(
    "urdfkit",
    "urdfkit",
    { command: program, args: words },
    {
      documentSelector: [{ scheme: "file", language: "urdf" }, { scheme: "file", language: "xacro" }, { scheme: "file", pattern }],
      synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/*.{urdf,xacro,srdf,yaml,launch,py,xml}") },
    },
  );
  try {
    await client.start();
  } catch (error) {
    const install = "pip install 'urdfkit[lsp,view]'";
    vscode.window.showErrorMessage(`urdfkit does not start (${error.message}): run ${install}, or set urdfkit.command`);
  }
}

function currentFile() {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined || editor.document.uri.scheme !== "file") {
    vscode.window.showErrorMessage("open a .urdf or .xacro file first");
    return undefined;
  }
  return editor.document.uri.fsPath;
}

function showPreview() {
  const file = currentFile();
  if (file === undefined) return;
  const shown = previews.get(file);
  if (shown !== undefined) {
    shown.reveal(vscode.ViewColumn.Beside, true);
    return;
  }
  const panel = vscode.window.createWebviewPanel(
    "urdfkit.preview",
    `Preview ${path.basename(file)}`,
    { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
    { enableScripts: true, retainContextWhenHidden: true },
  );
  previews.set(file, panel);
  const { program, words } = commandLine(settings().get("command"), "view", file, "--no-browser", "--port", "0");
  const server = spawn(program, words, { cwd: path.dirname(file) });
  let output = "";
  let errors = "";
  server.stdout.on("data", (data) => {
    output += data;
    const address = addressIn(output);
    if (address !== null && !panel.urdfkitAddress) {
      panel.urdfkitAddress = address;
      panel.webview.html = previewPage(address);
    }
  });
  server.stderr.on("data", (data) => (errors += data));
  const fail = (reason) => {
    if (previews.get(file) !== panel) return;
    vscode.window.showErrorMessage(reason);
    panel.dispose();
  };
  server.on("error", (error) => fail(`urdfkit does not start: ${error.message}`));
  server.on("exit", (code) => code !== 0 && code !== null && fail(errors.trim().split("\n").pop() || `exit status ${code}`));
  panel.onDidDispose(() => {
    previews.delete(file);
    server.kill("SIGINT");
  });
}

function inTerminal(...words) {
  const { program, words: all } = commandLine(settings().get("command"), ...words);
  const execution = new vscode.ProcessExecution(program, all);
  const scope = vscode.workspace.workspaceFolders ? vscode.workspace.workspaceFolders[0] : vscode.TaskScope.Workspace;
  return vscode.tasks.executeTask(new vscode.Task({ type: "urdfkit" }, scope, words[0], "urdfkit", execution));
}

async function fixFile() {
  const file = currentFile();
  if (file === undefined) return;
  await vscode.window.activeTextEditor.document.save();
  await inTerminal("lint", "--fix", file);
}

exports.activate = async function activate(context) {
  const commands = {
    "urdfkit.preview": showPreview,
    "urdfkit.lint": () => inTerminal("lint"),
    "urdfkit.fix": fixFile,
    "urdfkit.view": () => currentFile() !== undefined && inTerminal("view", currentFile()),
    "urdfkit.restart": async () => {
      if (client !== undefined) await client.stop();
      await startClient();
    },
  };
  for (const [name, run] of Object.entries(commands)) {
    context.subscriptions.push(vscode.commands.registerCommand(name, run));
  }
  await startClient();
};

exports.deactivate = async function deactivate() {
  for (const panel of previews.values()) panel.dispose();
  if (client !== undefined) await client.stop();
};
