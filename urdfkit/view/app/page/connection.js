// The websocket: connects, comes back when the line breaks, orders things, and says how it stands.

const SILENCE = 6000; // ms without a word from the server after which the line counts as dead
const POSES = 0x01;
const SENSED = 0x02;
const FILE = 0x03;
const ANSWER = 10000; // ms after which an order counts as unanswered

export class Connection {
  /** @param on {state(name, text), text(message), poses(frame), sensed(frame), command(bytes), file(name, bytes)} */
  constructor(on) {
    this.on = on;
    this.tries = 0;
    this.heard = 0;
    this.number = 0;
    this.waiting = new Map(); // number of an order → {resolve, reject, timer}
    this.wanted = new Map(); // key → how many want it
    setInterval(() => this.#watch(), 1000);
    addEventListener("online", () => this.#retryNow());
    document.addEventListener("visibilitychange", () => document.hidden || this.#retryNow());
    this.connect();
  }

  get open() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  send(type, values) {
    if (this.open) this.socket.send(JSON.stringify({ type, ...values }));
  }

  /** Have something done. Resolves with the answer's values; rejects with the reason why it was not done. */
  order(order, values = {}) {
    if (!this.open) return Promise.reject(new Error("the connection is lost"));
    const number = (this.number = (this.number + 1) >>> 0);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => this.#answered({ number, error: `no answer to ${order}` }), ANSWER);
      this.waiting.set(number, { resolve, reject, timer });
      this.send("do", { number, order, values });
    });
  }

  #answered({ number, error, values }) {
    const waiting = this.waiting.get(number);
    if (!waiting) return;
    this.waiting.delete(number);
    clearTimeout(waiting.timer);
    if (error) waiting.reject(new Error(error));
    else waiting.resolve(values);
  }

  /** Want what is sent under a key, or no longer; several parts of the page may want the same. */
  want(key, wanted) {
    const count = (this.wanted.get(key) ?? 0) + (wanted ? 1 : -1);
    if (count > 0) this.wanted.set(key, count);
    else this.wanted.delete(key);
    this.wishes ??= requestAnimationFrame(() => this.#wish());
  }

  #wish() {
    this.wishes = null;
    this.send("watch", { wanted: [...this.wanted.keys()].slice(0, 64) });
  }

  connect() {
    clearTimeout(this.timer);
    this.on.state("connecting", this.tries ? "reconnecting" : "connecting");
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = (this.socket = new WebSocket(`${scheme}://${location.host}/ws${location.search}`));
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.tries = 0;
      this.heard = performance.now();
      this.on.state("connected", "connected");
      this.#wish();
    };
    socket.onmessage = ({ data }) => {
      this.heard = performance.now();
      if (typeof data === "string") this.#text(JSON.parse(data));
      else this.#binary(data, new Uint8Array(data, 0, 1)[0]);
    };
    socket.onclose = () => socket === this.socket && this.#lost();
  }

  #text(message) {
    if (message.type === "answer") this.#answered(message);
    else this.on.text(message);
  }

  #binary(data, mark) {
    if (mark === POSES) this.on.poses(data);
    else if (mark === SENSED) this.on.sensed(data);
    else if (mark === FILE) this.#file(data);
    else this.on.command(new Uint8Array(data));
  }

  // A file to keep: hand it to the browser's downloads.
  #file(data) {
    const length = new DataView(data).getUint16(2, true);
    const name = new TextDecoder().decode(new Uint8Array(data, 16, length));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([new Uint8Array(data, 16 + length)]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  #lost() {
    for (const number of [...this.waiting.keys()]) this.#answered({ number, error: "the connection was lost" });
    this.on.state("lost", "connection lost");
    this.tries += 1;
    this.timer = setTimeout(() => this.connect(), Math.min(4000, 250 * 2 ** this.tries));
    this.#askWhy();
  }

  // A websocket does not say why it was refused; a plain request does.
  async #askWhy() {
    try {
      const answer = await fetch(location.pathname + location.search, { method: "GET", cache: "no-store" });
      if (answer.status === 403) this.on.state("lost", "urdfkit was started anew: open its new address");
    } catch {
      this.on.state("lost", "urdfkit is not running");
    }
  }

  #retryNow() {
    if (this.socket?.readyState === WebSocket.CLOSED) this.connect();
  }

  // Twice in a row: after a long picture this may run before what has come meanwhile is heard.
  #watch() {
    const silent = this.open && performance.now() - this.heard > SILENCE && !document.hidden;
    if (silent && this.silent) this.socket.close();
    this.silent = silent;
  }
}
