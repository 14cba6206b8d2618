// The worker of the WebSocket: it reads and writes while the page draws, and repeats the driver's input meanwhile.

const PERIOD = 50; // ms between two inputs of the driver
const TRUST = 2000; // ms without a word of the page after which its input is not repeated: the page may hang

let socket = null;
let input = null; // the text of the last input that was not zero
let given = 0; // when the page gave it
let sent = 0;

onmessage = ({ data }) => {
  if (data.open) open(data.open);
  else if (data.close) socket?.close();
  else if (data.drive !== undefined) drive(data.drive);
  else if (socket?.readyState === WebSocket.OPEN) socket.send(data.text);
};

function open(address) {
  input = null;
  socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => postMessage({ event: "open" });
  socket.onclose = () => postMessage({ event: "close" });
  socket.onmessage = ({ data }) => postMessage({ event: "message", data }, typeof data === "string" ? [] : [data]);
}

// `text` is sent now; with `held` it is repeated until the next call.
function drive({ text, held }) {
  given = performance.now();
  input = held ? text : null;
  send(text);
}

function send(text) {
  sent = performance.now();
  if (socket?.readyState === WebSocket.OPEN) socket.send(text);
}

setInterval(() => {
  const now = performance.now();
  if (input !== null && now - given > TRUST) input = null;
  if (input !== null && now - sent >= 0.9 * PERIOD) send(input);
}, PERIOD);
