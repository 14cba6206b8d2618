"use strict";

const test = require("node:test");
const assert = require("node:assert");
const { addressIn, commandLine, previewPage, serverWords } = require("../src/commands");

test("a command line begins with the words of the setting", () => {
  assert.deepStrictEqual(commandLine(["python3", "-m", "urdfkit"], ...serverWords("ros2")), {
    program: "python3",
    words: ["-m", "urdfkit", "lsp", "--target", "ros2"],
  });
  assert.deepStrictEqual(serverWords(""), ["lsp"]);
  for (const wrong of [[], "urdfkit", [1]]) assert.throws(() => commandLine(wrong), /urdfkit\.command/);
});

test("the address is the line that urdfkit view prints", () => {
  assert.strictEqual(addressIn("http://127.0.0.1:70"), null);
  assert.strictEqual(addressIn("simpleton: http://127.0.0.1:7007/?token=abc\n"), "http://127.0.0.1:7007/?token=abc");
});

test("the preview loads only the address", () => {
  const page = previewPage("http://127.0.0.1:7007/?token=a&c");
  assert.match(page, /frame-src http:\/\/127\.0\.0\.1:7007;/);
  assert.match(page, /default-src 'none'/);
  assert.match(page, /src="http:\/\/127\.0\.0\.1:7007\/frame\?token=a&amp;c"/);
});
