// The drive pad: drag the knob to drive, release it to stop; for mouse, touch and pen.

export class Pad {
  /** @param moved called with (forward, left), each -1..1 */
  constructor(moved) {
    this.moved = moved;
    this.element = document.getElementById("pad");
    this.knob = document.getElementById("knob");
    this.pointer = null;
    this.element.addEventListener("pointerdown", (event) => this.#down(event));
    this.element.addEventListener("pointermove", (event) => event.pointerId === this.pointer && this.#move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      this.element.addEventListener(end, (event) => event.pointerId === this.pointer && this.release());
    }
    this.element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  release() {
    this.pointer = null;
    delete this.element.dataset.held;
    this.knob.style.transform = "";
    this.moved(0, 0);
  }

  #down(event) {
    if (this.pointer !== null || event.button !== 0) return;
    event.preventDefault();
    this.pointer = event.pointerId;
    this.element.setPointerCapture(event.pointerId);
    this.element.dataset.held = "";
    this.#move(event);
  }

  #move(event) {
    const { left, top, width } = this.element.getBoundingClientRect();
    const reach = width * 0.34;
    let x = (event.clientX - left - width / 2) / reach;
    let y = (event.clientY - top - width / 2) / reach;
    const length = Math.hypot(x, y);
    if (length > 1) (x /= length), (y /= length);
    this.knob.style.transform = `translate(${x * reach}px, ${y * reach}px)`;
    const quiet = (value) => (Math.abs(value) < 0.08 ? 0 : value);
    this.moved(quiet(-y), quiet(-x));
  }
}
