// Requests the joint positions of a link from the server, with the solver of `urdfkit ik`; one request at a time.

export class LinkSolver {
  constructor(page) {
    this.page = page;
    this.served = true; // false after an error, such as a missing library: the page solves by itself
    this.busy = false;
    this.next = null; // the newest request that waits
    page.on("robot", () => (this.served = true));
  }

  get ready() {
    return this.served && Boolean(this.page.connection?.open);
  }

  /**
   * Request the joint positions that place a link, or the motions that it loses; the newest request with a pose counts.
   * @param values of the request `ik`, see docs/protocol.md
   * @param answered called with the answer, or with null while the solver is compiled, without numba, or after an error
   */
  request(values, answered) {
    if (this.next && !values.pose) return; // its answer has these motions too
    this.next = { values, answered };
    if (!this.busy) this.#send();
  }

  async #send() {
    this.busy = true;
    for (let one; (one = this.next); ) {
      this.next = null;
      let answer = null;
      try {
        answer = await this.page.connection.request("ik", one.values);
      } catch (error) {
        if (this.page.connection.open) {
          this.served = false;
          this.page.toast(error.message, "error");
        }
      }
      if (answer?.missing) this.served = false;
      one.answered(answer?.ready ? answer : null, answer?.missing);
    }
    this.busy = false;
  }
}
