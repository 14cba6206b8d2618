// Command lines and addresses: no dependency on the editor, so that `npm test` runs without one.
"use strict";

const ADDRESS = /(http:\/\/127\.0\.0\.1:\d+\/\?\S+)/;

/** Return program and arguments of a command of urdfkit. */
function commandLine(setting, ...words) {
  if (!Array.isArray(setting) || setting.length === 0 || setting.some((word) => typeof word !== "string")) {
    throw new Error("the setting urdfkit.command must be a list of words, such as [\"urdfkit\"]");
  }
  return { program: setting[0], words: [...setting.slice(1), ...words] };
}

/** Return the words that start the language server. */
function serverWords(target) {
  return target ? ["lsp", "--target", target] : ["lsp"];
}

/** Return the address that `urdfkit view` prints, or null before it is complete. */
function addressIn(output) {
  const found = ADDRESS.exec(output);
  return found === null ? null : found[1];
}

/** Return the page around the viewer: the viewer's page for frames, and nothing else may load. */
function previewPage(address) {
  const url = new URL(address);
  url.pathname = "/frame"; // the page at / refuses to be shown in a frame
  const { origin } = url;
  const quoted = url.href.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");
  return `<!doctype html><html><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; frame-src ${origin}; style-src 'unsafe-inline'">
<style>html, body, iframe { margin: 0; padding: 0; border: 0; width: 100%; height: 100vh; overflow: hidden }</style>
</head><body><iframe src="${quoted}" title="Robot"></iframe></body></html>`;
}

module.exports = { commandLine, serverWords, addressIn, previewPage };
