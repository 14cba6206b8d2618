// Zoom and pan of a plot with wheel, pinch, drag and keyboard.

const STEP = 1.25; // zoom of one press of a key
const SHIFT = 0.1; // fraction of the window per arrow key
const DRAG = 3; // pixels after which a press is a drag

export class Grip {
  /** @param plot {canvas, left, below, zoom(factor, at), scale(factor, at), shift(part), raise(part), follow()}; `at` and `part` are fractions of the window, 0..1 */
  constructor(plot) {
    this.plot = plot;
    this.fingers = new Map(); // pointer → {x, y}
    const { canvas } = plot;
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.#up(event));
    canvas.addEventListener("pointerleave", () => plot.look(null));
    canvas.addEventListener("dblclick", () => plot.follow());
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Position in the window: 0..1 from the left, 0..1 from the top; negative on the scale at the left. */
  #part({ x, y }) {
    const { canvas, left, below } = this.plot;
    const box = canvas.getBoundingClientRect();
    return [(x - box.left - left) / (box.width - left), (y - box.top) / (box.height - below)];
  }

  #wheel(event) {
    event.preventDefault();
    const factor = Math.exp(event.deltaY * 0.0015);
    const [across, down] = this.#part(event);
    if (event.shiftKey || across < 0) this.plot.scale(factor, down);
    else this.plot.zoom(factor, across);
  }

  #down(event) {
    this.plot.canvas.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.from = event.clientX; // until the pointer has moved by `DRAG`
  }

  #up(event) {
    this.fingers.delete(event.pointerId);
    this.from = null;
  }

  #move(event) {
    const now = { x: event.clientX, y: event.clientY };
    const before = this.fingers.get(event.pointerId);
    const box = this.plot.canvas.getBoundingClientRect();
    this.plot.look({ x: now.x - box.left, y: now.y - box.top });
    if (!before) return;
    if (this.fingers.size === 1 && this.from !== null && Math.abs(now.x - this.from) <= DRAG && !event.shiftKey) return;
    this.fingers.set(event.pointerId, now);
    if (this.fingers.size === 2) return this.#pinch(event.pointerId, before, now);
    this.from = null;
    const [[x, y], [a, b]] = [this.#part(before), this.#part(now)];
    this.plot.shift(x - a);
    if (event.shiftKey) this.plot.raise(b - y);
  }

  // Two fingers: a horizontal pinch zooms in time, a vertical one in value.
  #pinch(pointer, before, now) {
    const [, still] = [...this.fingers].find(([other]) => other !== pointer);
    const apart = (place) => [Math.abs(place.x - still.x), Math.abs(place.y - still.y)];
    const [[wide, tall], [wider, taller]] = [apart(before), apart(now)];
    const [x, y] = this.#part({ x: (now.x + still.x) / 2, y: (now.y + still.y) / 2 });
    if (wider >= taller) this.plot.zoom(Math.max(wide, 10) / Math.max(wider, 10), x);
    else this.plot.scale(Math.max(tall, 10) / Math.max(taller, 10), y);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = {
      "+": () => this.plot.zoom(1 / STEP, 1),
      "-": () => this.plot.zoom(STEP, 1),
      ArrowLeft: () => this.plot.shift(-SHIFT),
      ArrowRight: () => this.plot.shift(SHIFT),
      ArrowUp: () => this.plot.scale(1 / STEP, 0.5),
      ArrowDown: () => this.plot.scale(STEP, 0.5),
      Home: () => this.plot.follow(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation(); // the arrow keys would drive the robot
    act();
  }
}
