// A WebSocket in a worker, with the interface of a WebSocket: slow drawing does not delay its messages.

export class WorkerSocket {
  readyState = WebSocket.CONNECTING;

  constructor(address) {
    this.worker = new Worker("/app/connection/socket_worker.js");
    this.worker.onmessage = ({ data }) => this.#event(data);
    this.worker.onerror = () => this.#event({ event: "close" });
    this.worker.postMessage({ open: address });
  }

  #event({ event, data }) {
    if (event === "message") return this.onmessage({ data });
    this.readyState = event === "open" ? WebSocket.OPEN : WebSocket.CLOSED;
    if (event === "open") return this.onopen();
    this.worker.terminate();
    this.onclose();
  }

  send(text) {
    this.worker.postMessage({ text });
  }

  /** Send the input of a driver; with `held` the worker repeats it until the next call. */
  drive(text, held) {
    this.worker.postMessage({ drive: { text, held } });
  }

  close() {
    this.readyState = WebSocket.CLOSING;
    this.worker.postMessage({ close: true });
  }
}
