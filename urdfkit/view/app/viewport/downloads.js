// Downloads: the meshes that are not loaded yet, and how many bytes were received.

export class Downloads {
  constructor() {
    this.waiting = new Map(); // promise of a requested mesh → name of its link
    this.requested = 0; // meshes, since none was missing
    this.bytes = 0;
    this.changed = null; // is called with {waiting, requested, bytes, link}
  }

  /** @param task promise that resolves, never rejects, when the mesh is shown */
  add(task, link) {
    if (!this.waiting.size) this.requested = this.bytes = 0;
    this.requested += 1;
    this.waiting.set(task, link);
    task.finally(() => {
      this.waiting.delete(task);
      this.#report();
    });
    this.#report();
  }

  received(bytes) {
    this.bytes += bytes;
    this.#report();
  }

  /** Resolves when nothing is missing. */
  async finished() {
    while (this.waiting.size) await Promise.allSettled([...this.waiting.keys()]);
  }

  #report() {
    const [link] = this.waiting.values();
    this.changed?.({ waiting: this.waiting.size, requested: this.requested, bytes: this.bytes, link });
  }
}
