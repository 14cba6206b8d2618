// Parameters that can be changed during the simulation: gravity, friction, masses, gains.

import { h, short } from "../page/dom.js";
import { redraw } from "../page/edited_fields.js";
import { numberField } from "../page/number_field.js";

const SCREW = "M12 3v6M9 3h6M9 9h6l-1 9-2 3-2-3zM9.4 12h5.2M9.8 15h4.4";
const PLANETS = { Earth: -9.81, Mars: -3.72, Moon: -1.62, none: 0 };

export function liveParameters(page) {
  const panel = page.panels.add({ id: "physics", title: "Physics", icon: SCREW, modes: ["sim"], order: 35 });
  const filter = h("input", { type: "search", id: "parameter-filter", placeholder: "Filter links, models, controllers", "aria-label": "Filter parameters", autocomplete: "off" });
  const gravity = h("div.row.gravity");
  const table = h("table.parameters");
  const gains = h("div.gains");
  panel.body.append(h("h3", {}, "Gravity [m/s²]"), gravity, h("h3", {}, "Mass and friction"), filter, table, gains);
  let state = null;

  /** @param before values of the same request that restore the present state */
  function request(name, values, before, input) {
    const put = (each) => () => page.connection.request(name, each);
    return page.connection.request(name, values).then(
      () => {
        input?.classList.add("done");
        const what = [values.name, values.link, values.path].filter(Boolean).join("/");
        page.history.add({ words: `changed ${name}${what ? ` of ${what}` : ""}`, undo: put(before), redo: put(values) });
      },
      (error) => {
        page.toast(error.message, "error");
        draw();
      },
    );
  }

  function number(value, label, changed, bounds = { min: 0 }) {
    const input = numberField({ ...bounds, value: short(value, 6), "aria-label": label });
    input.addEventListener("change", () => changed(input.valueAsNumber, input));
    input.addEventListener("keydown", (event) => event.key === "Enter" && input.blur());
    return input;
  }

  function gravityRow() {
    const inputs = [..."xyz"].map((axis, i) => {
      const input = number(state.gravity[i], `gravity along ${axis}`, () => {
        const values = inputs.map(({ valueAsNumber }) => valueAsNumber);
        request("gravity", { gravity: values }, { gravity: state.gravity }, input);
      }, { min: -1e4, max: 1e4, unit: "m/s²" });
      return input;
    });
    const pick = h("select", { "aria-label": "Gravity of a planet", id: "planet" }, h("option", { value: "" }, "other"));
    const [x, y, z] = state.gravity;
    for (const [name, g] of Object.entries(PLANETS)) {
      const is = x === 0 && y === 0 && Math.abs(z - g) < 0.01;
      pick.append(h("option", { value: g, selected: is }, name));
    }
    pick.addEventListener("change", () => {
      pick.blur(); // so that the fields are updated
      if (pick.value) request("gravity", { gravity: [0, 0, Number(pick.value)] }, { gravity: state.gravity });
    });
    gravity.replaceChildren(...inputs, pick);
  }

  function row({ name, link, mass, mu }) {
    const words = link || name;
    const where = link ? { name, link } : { name };
    const cell = (value, label, send, bounds) => h("td", {}, value === null ? h("span.quiet", {}, "–") : number(value, `${label} of ${words}`, send, bounds));
    return h(
      "tr",
      { "data-of": link ? `${name}/${link}` : name },
      h("th", { scope: "row", title: link ? `${name}: ${link}` : name }, words),
      cell(mass, "mass", (value, input) => request("mass", { ...where, mass: value }, { ...where, mass }, input), { min: 1e-6, max: 1e6, unit: "kg" }),
      cell(mu, "mu", (value, input) => request("mu", { ...where, mu: value }, { ...where, mu }, input), { min: 0, max: 1e4 }),
    );
  }

  function gain({ path, p, i, d, clamp }) {
    const values = { p, i, d, clamp };
    const entry = (name) =>
      h("label", {}, name === "clamp" ? "i clamp" : name, number(values[name], `${name} of ${path}`, (value, input) => {
        const before = { path, ...values };
        values[name] = value;
        request("gains", { path, ...values }, before, input);
      }));
    return h("fieldset", { "data-of": path }, h("legend", {}, path.split("/").slice(1).join(" · ")), ...Object.keys(values).map(entry));
  }

  function draw() {
    if (!state) return;
    const words = filter.value.toLowerCase();
    const fits = (text) => text.toLowerCase().includes(words);
    redraw(gravity, gravityRow);
    redraw(table, () => {
      const head = h("thead", {}, h("tr", {}, h("th", {}, "body"), h("th", {}, "mass [kg]"), h("th", {}, "mu")));
      const rows = state.rows.filter(({ name, link }) => fits(`${name} ${link}`));
      table.replaceChildren(head, h("tbody", {}, ...rows.map(row)));
    });
    redraw(gains, () => {
      const shown = state.gains.filter(({ path }) => fits(path));
      gains.replaceChildren(...(shown.length ? [h("h3", {}, "Gains"), ...shown.map(gain)] : []));
    });
  }

  filter.addEventListener("input", draw);
  page.on("parameters", (message) => {
    state = message;
    draw();
  });
}
