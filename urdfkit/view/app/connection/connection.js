// The connection to the server: connects, reconnects, sends requests and reports its state. A worker has its socket.

import { WorkerSocket } from "./worker_socket.js";

const SILENCE = 6000; // ms without a message from the server after which the connection counts as lost
const POSES = 0x01;
const SENSED = 0x02;
const FILE = 0x03;
const ANSWER = 10000; // ms after which a request counts as unanswered

export class Connection {
  /** @param on {state(name, text), text(message), poses(frame), sensed(frame), command(bytes), file(name, bytes)} */
  constructor(on) {
    this.on = on;
    this.tries = 0;
    this.received = 0;
    this.number = 0;
    this.waiting = new Map(); // number of a request → {resolve, reject, timer}
    this.subscriptions = new Map(); // key → number of subscribers on this page
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

  /** Send the input of the driver; while it is not zero, it is repeated even while the page is drawn. */
  drive(values) {
    if (this.open) this.socket.drive(JSON.stringify({ type: "axes", ...values }), values.axes.some(Boolean));
  }

  /** Send a request. Resolves with the values of the answer; rejects with its error. */
  request(name, values = {}) {
    if (!this.open) return Promise.reject(new Error("not connected"));
    const number = (this.number = (this.number + 1) >>> 0);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => this.#answered({ number, error: `no answer to the request “${name}”` }), ANSWER);
      this.waiting.set(number, { resolve, reject, timer });
      this.send("request", { number, name, values });
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

  /** Subscribe to the messages of a key, or unsubscribe; several parts of the page may subscribe to the same key. */
  subscribe(key, on) {
    const count = (this.subscriptions.get(key) ?? 0) + (on ? 1 : -1);
    if (count > 0) this.subscriptions.set(key, count);
    else this.subscriptions.delete(key);
    this.scheduled ??= requestAnimationFrame(() => this.#sendSubscriptions());
  }

  #sendSubscriptions() {
    this.scheduled = null;
    this.send("subscribe", { keys: [...this.subscriptions.keys()].slice(0, 64) });
  }

  connect() {
    clearTimeout(this.timer);
    this.on.state("connecting", this.tries ? "reconnecting" : "connecting");
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = (this.socket = new WorkerSocket(`${scheme}://${location.host}/ws${location.search}`));
    socket.onopen = () => {
      this.tries = 0;
      this.received = performance.now();
      this.on.state("connected", "connected");
      this.#sendSubscriptions();
    };
    socket.onmessage = ({ data }) => {
      this.received = performance.now();
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

  // Save a file with the downloads of the browser.
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
    for (const number of [...this.waiting.keys()]) this.#answered({ number, error: "connection lost" });
    this.on.state("lost", "connection lost");
    this.tries += 1;
    this.timer = setTimeout(() => this.connect(), Math.min(4000, 250 * 2 ** this.tries));
    this.#findReason();
  }

  // A WebSocket does not report why it was rejected; a plain request does.
  async #findReason() {
    try {
      const answer = await fetch(location.pathname + location.search, { method: "GET", cache: "no-store" });
      if (answer.status === 403) this.on.state("lost", "urdfkit was restarted: open its new address");
    } catch {
      this.on.state("lost", "urdfkit is not running");
    }
  }

  #retryNow() {
    if (this.socket?.readyState === WebSocket.CLOSED) this.connect();
  }

  // Two checks in a row: after a slow frame, this may run before waiting messages are processed.
  #watch() {
    const silent = this.open && performance.now() - this.received > SILENCE && !document.hidden;
    if (silent && this.silent) this.socket.close();
    this.silent = silent;
  }
}
