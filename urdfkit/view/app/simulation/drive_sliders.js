// Drive sliders that keep their value, gamepad input, and the selection of the driven robot.

import { h } from "../page/dom.js";
import { offer } from "../page/edited_fields.js";

const DEAD = 0.12; // dead zone of a stick, as a fraction of its range

/** Sliders like those of rqt_robot_steering; they keep their value until Stop. */
export function steering(page, drive, host) {
  const make = (id, words, low, high) => {
    const output = h("output", { for: id }, "0 %");
    const input = h("input", { id, type: "range", min: -100, max: 100, step: 1, value: 0 });
    const ends = h("div.ends.quiet", { "aria-hidden": "true" }, h("span", {}, low), h("span", {}, high));
    host.append(h("label.field", { for: id }, `${words} `, output, input), ends);
    return { input, output };
  };
  const forward = make("steer-forward", "Forward", "backward", "forward");
  const turn = make("steer-turn", "Turn", "right", "left");
  const sides = make("steer-sides", "Sideways", "right", "left");
  const all = [forward, turn, sides];
  const value = ({ input }) => input.valueAsNumber / 100;
  const changed = () => {
    for (const { input, output } of all) output.textContent = `${input.value} %`;
    drive.hold("steering", [value(forward), value(sides), 0, value(turn)]);
  };
  for (const { input } of all) {
    input.addEventListener("input", changed);
    input.addEventListener("dblclick", () => ((input.value = 0), changed()));
  }
  const reset = () => {
    for (const each of all) each.input.value = 0;
    for (const { output } of all) output.textContent = "0 %";
  };
  host.append(h("button.wide", { type: "button", id: "steer-stop", onclick: () => drive.stop() }, "Stop"));
  drive.released = reset;
}

/** The sticks of a gamepad: the left one drives, and strafes with the left trigger held; the right one turns. */
export function gamepad(page, drive, host) {
  const line = h("p.quiet", { id: "gamepad" }, "To drive with a gamepad, press one of its buttons.");
  host.append(line);
  let running = false;
  const stick = (value) => (Math.abs(value ?? 0) < DEAD ? 0 : -(value - Math.sign(value) * DEAD) / (1 - DEAD));
  function look() {
    const pad = [...(navigator.getGamepads?.() ?? [])].find((each) => each?.connected);
    if (!pad) {
      running = false;
      drive.hold("gamepad", [0, 0, 0, 0]);
      line.textContent = "To drive with a gamepad, press one of its buttons.";
      return;
    }
    line.textContent = `Gamepad: ${pad.id.replace(/\(.*/, "").trim() || "connected"}. Left stick drives, right stick turns, trigger left + stick strafes.`;
    const strafe = pad.buttons[6]?.pressed || pad.buttons[4]?.pressed;
    const [across, ahead, right] = [stick(pad.axes[0]), stick(pad.axes[1]), stick(pad.axes[2])];
    const turn = Math.max(-1, Math.min(1, right + (strafe ? 0 : across)));
    if (document.hasFocus() || !document.hidden) drive.hold("gamepad", [ahead, strafe ? across : 0, 0, turn]);
    requestAnimationFrame(look);
  }
  const start = () => {
    if (running) return;
    running = true;
    look();
  };
  addEventListener("gamepadconnected", start);
  if ([...(navigator.getGamepads?.() ?? [])].some((each) => each?.connected)) start();
}

/** Select the driven robot if there are several; the view follows it. */
export function chooser(page, drive, host) {
  const select = h("select", { id: "driven", "aria-label": "Robot to drive" });
  const field = h("label.field", { hidden: true }, "Robot ", select);
  host.prepend(field);
  let robots = [];
  const take = () => {
    const first = select.selectedIndex <= 0;
    drive.take(first ? "" : select.value);
    page.driven = select.value;
    const root = first ? -1 : (page.model?.nodes ?? []).findIndex((path) => path.includes(`/world%2F${select.value}::`));
    page.followed = root < 0 ? undefined : root;
  };
  select.addEventListener("change", () => {
    take();
    select.blur();
  });
  page.on("teleop", (message) => {
    robots = message.robots.filter((robot) => robot.drives);
    offer(select, robots.map(({ name }) => [name, name]), take);
    field.hidden = robots.length < 2;
    take();
  });
  page.on("model", take);
}
