// Makes the copy button of a console block copy its commands, without prompts and output.

"use strict";

// Returns the commands of a console block, one per line; empty for a block without prompts.
function commandsOf(text) {
  const commands = [];
  let continues = false;
  for (const line of text.split("\n")) {
    if (continues) commands.push(line.replace(/^> ?/, ""));
    else if (line.startsWith("$ ")) commands.push(line.slice(2));
    else continue;
    continues = line.endsWith("\\");
  }
  return commands.join("\n");
}

if (typeof document !== "undefined") {
  // In the capturing phase, before the handler of the theme; buttons that the theme adds later need no further setup.
  document.addEventListener("click", (event) => {
    const button = event.target.closest(".language-console [data-clipboard-target]");
    const code = button && document.querySelector(button.dataset.clipboardTarget);
    const commands = code && commandsOf(code.textContent);
    if (commands) button.dataset.clipboardText = commands;
  }, true);
} else {
  module.exports = { commandsOf };
}
