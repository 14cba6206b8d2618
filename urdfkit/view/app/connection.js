// The websocket: connects, comes back when the line breaks, and says how it stands.

const SILENCE = 6000; // ms without a word from the server after which the line counts as dead
const POSES = 0x01;
const SENSED = 0x02;

export class Connection {
  /** @param on {state(name, text), text(message), poses(frame), sensed(frame), command(bytes)} */
  constructor(on) {
    this.on = on;
    this.tries = 0;
    this.heard = 0;
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

  connect() {
    clearTimeout(this.timer);
    this.on.state("connecting", this.tries ? "reconnecting" : "connecting");
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = (this.socket = new WebSocket(`${scheme}://${location.host}/ws`));
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.tries = 0;
      this.heard = performance.now();
      this.on.state("connected", "connected");
    };
    socket.onmessage = ({ data }) => {
      this.heard = performance.now();
      if (typeof data === "string") this.on.text(JSON.parse(data));
      else if (new Uint8Array(data, 0, 1)[0] === POSES) this.on.poses(data);
      else if (new Uint8Array(data, 0, 1)[0] === SENSED) this.on.sensed(data);
      else this.on.command(new Uint8Array(data));
    };
    socket.onclose = () => socket === this.socket && this.#lost();
  }

  #lost() {
    this.on.state("lost", "connection lost");
    this.tries += 1;
    this.timer = setTimeout(() => this.connect(), Math.min(4000, 250 * 2 ** this.tries));
    this.#askWhy();
  }

  // A websocket does not say why it was refused; a plain request does.
  async #askWhy() {
    try {
      const answer = await fetch("/", { method: "GET", cache: "no-store" });
      if (answer.status === 403) this.on.state("lost", "urdfkit was started anew: open its new address");
    } catch {
      this.on.state("lost", "urdfkit is not running");
    }
  }

  #retryNow() {
    if (this.socket?.readyState === WebSocket.CLOSED) this.connect();
  }

  #watch() {
    if (this.open && performance.now() - this.heard > SILENCE && !document.hidden) this.socket.close();
  }
}
