// The pressure of all cylinders at once: pasted as two columns or dropped as CSV, drawn, and given to the rows in their firing order.

import { h, s } from "../dom.js";
import { figure } from "../format.js";
import { quantity, read } from "../quantity.js";
import { cylindersOf, firing, offsets } from "./firing.js";
import { traceOf } from "./trace.js";

const UNITS = { bar: 1e5, Pa: 1, kPa: 1e3, MPa: 1e6, psi: 6894.757293168361 };
const ATMOSPHERE_PA = 101_325;
// a pressure without a unit is in pascals where it is as large as pascals are
const PASCALS = 5000;
const [WIDTH, HEIGHT, LEFT, BOTTOM] = [420, 150, 40, 24];
const MOST_POINTS = 360;
const MOST_TROUBLES = 3;
// what the service takes of one pressure, of all lists of a request together, and of all turns in all rows, with something to spare
const [MOST, ITEMS, ENTRIES] = [7200, 45_000, 190_000];
const room = (count) => Math.floor(Math.min(MOST, ITEMS / (2 * count), ENTRIES / count ** 2));

// what was typed here outlives the form, which is drawn anew
export const nothing = () => ({ text: "", unit: "", side: "head", bore: "", ambient: "", order: "", offsets: "", every: 1, gauge: false });

/** @param {any} form its `gas` is what was typed here */
export function gasPart(form) {
  const { gas } = form;
  const said = h("div", { class: "said", role: "status" });
  const drawn = h("div", { class: "gas-curve" });
  const input = (name, title, unit, more = {}) => {
    const made = h("input", { type: "text", id: `gas-${name}`, autocomplete: "off", value: gas[name], ...more, input: () => {
      gas[name] = made.value;
      show();
    } });
    return h("div", { class: "field" }, h("label", { for: made.id }, title, unit ? h("span", { class: "unit" }, ` ${unit}`) : null), made);
  };
  const select = (name, title, options) => {
    const made = h("select", { id: `gas-${name}`, change: () => {
      gas[name] = made.value;
      show();
    } }, options.map(([value, words]) => h("option", { value, selected: value === gas[name] }, words)));
    return h("div", { class: "field" }, h("label", { for: made.id }, title), made);
  };
  const changed = () => {
    gas.text = area.value;
    Object.assign(gas, { every: 1, gauge: false });
    show();
  };
  const put = (text) => {
    area.value = text;
    changed();
  };
  // thousands of lines take the browser long to insert, and no time to put in place of what was there
  const area = h("textarea", { rows: 3, id: "gas-text", spellcheck: "false", value: gas.text, input: changed,
    paste: (event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (!text.includes("\n")) return;
      event.preventDefault();
      put(text);
    },
    dragover: (event) => event.preventDefault(),
    drop: async (event) => {
      const [file] = event.dataTransfer?.files ?? [];
      if (!file) return;
      event.preventDefault();
      event.stopPropagation();
      put(await file.text());
    } });
  const units = select("unit", "Unit of the pressures", [["", "as their head says"], ...Object.keys(UNITS).map((unit) => [unit, unit])]);
  const give = h("button", { type: "button", class: "small", click: () => given(form, meaning(form)) });
  const fix = (words, change) => h("button", { type: "button", class: "small", click: () => {
    Object.assign(gas, change);
    show();
  } }, words);
  const show = () => {
    const found = meaning(form);
    const { trace, cylinders, troubles, words } = found;
    give.textContent = `Give it to all ${cylinders.length} cylinders`;
    give.disabled = !trace || troubles.length > 0;
    centres.querySelector("input").placeholder = found.centres?.map((angle) => String(angle)).join(" ") ?? "";
    const more = troubles.length > MOST_TROUBLES ? [`and ${troubles.length - MOST_TROUBLES} more`] : [];
    said.replaceChildren(...words.map((one) => h("p", {}, one)), ...(troubles.length ? [h("p", { class: "error" }, `${[...troubles.slice(0, MOST_TROUBLES), ...more].join("; ")}.`)] : []),
      ...(found.fixes ?? []).map(([text, change]) => fix(text, change)));
    drawn.replaceChildren(...(trace && trace.angles.length > 2 ? [curve(found)] : []));
  };
  const centres = input("offsets", "Each fires at", "deg");
  const body = [
    h("p", { class: "about" }, "One pressure for all cylinders: paste two columns here, the angle after the dead centre and the absolute pressure, or drop the CSV file."),
    h("div", { class: "field" }, h("label", { for: area.id }, "Angle and pressure"), area), said, drawn,
    h("div", { class: "fields" }, units, select("side", "Side of the piston", [["head", "head"], ["crank", "crank"]]), input("bore", "Bore", "m"),
      input("ambient", "Pressure on the open side", "Pa"), input("order", "Firing order", "", { placeholder: "" }), centres),
    h("div", { class: "buttons" }, give)];
  show();
  return body;
}

// what was typed as what it means, and what is wrong with it
/** @returns {any} */
function meaning(form) {
  const { gas } = form;
  const cylinders = cylindersOf(form.request.machine ?? {});
  if (!gas.text.trim()) return { cylinders, troubles: [], words: [], trace: null };
  const most = room(cylinders.length || 1);
  const trace = traceOf(gas.text, gas.every, most);
  const troubles = [...trace.troubles];
  /** @type {[string, object][]} */
  const fixes = [];
  const words = [];
  const guess = Math.max(...trace.pressures) >= PASCALS ? "Pa" : "bar";
  const unit = gas.unit || trace.unit || guess;
  const pascals = trace.pressures.map((value) => Number((value * UNITS[unit] + (gas.gauge ? ATMOSPHERE_PA : 0)).toPrecision(8)));
  if (trace.angles.length) {
    words.push(`${trace.lines} lines: ${trace.turns === 2 ? "two revolutions" : "one revolution"}, ${figure(Math.min(...pascals) / 1e5, 4)} to ${figure(Math.max(...pascals) / 1e5, 4)} bar`
      + `${gas.unit || trace.unit ? "" : `; no unit stands beside the pressures: read as ${unit}`}${gas.gauge ? "; 1.013 bar added" : ""}.`);
  }
  if (pascals.some((value) => value <= 0)) {
    troubles.push(`the least pressure is ${figure(Math.min(...pascals) / 1e5, 3)} bar: absolute pressures are above 0`);
    fixes.push(["They are gauge pressures: add 1.013 bar", { gauge: true }]);
  }
  const every = Math.ceil(trace.lines / most);
  if (every > gas.every) fixes.push([`Take one line of ${every}`, { every }]);
  if (!cylinders.length) troubles.push("there are no rows yet that could have cylinders");
  const when = gas.offsets.trim() ? offsets(gas.offsets, cylinders) : firing(gas.order, cylinders, trace.turns);
  if (when.wrong && cylinders.length) troubles.push(when.wrong.replace(/\.$/, ""));
  const bore = gas.bore.trim() ? read(gas.bore, "m") : undefined;
  const ambient = gas.ambient.trim() ? read(gas.ambient, "Pa") : undefined;
  const size = (row) => row?.cylinder?.bore_m ?? row?.cylinder?.head_area_m2;
  if (bore === undefined && cylinders.some(({ row }) => size(row) === undefined)) troubles.push("give the bore");
  else if (bore !== undefined && !Number.isFinite(quantity(bore, "m"))) troubles.push(`“${gas.bore}” is no length`);
  else if (typeof bore === "number" && bore >= 5) troubles.push(`a bore of ${bore} m? Write ${bore} mm if that is meant`);
  if (ambient === undefined && cylinders.some(({ row }) => (row?.cylinder?.ambient_pressure_Pa ?? row?.cylinder?.pressure?.[gas.side === "head" ? "crank" : "head"]) === undefined)) troubles.push("give the pressure on the open side");
  return { cylinders, trace, troubles, fixes, words, pascals, bore, ambient, centres: when.centres ?? null };
}

// into all rows: their own data stay, their pressures go
function given(form, { cylinders, trace, pascals, bore, ambient, centres }) {
  const { side } = form.gas;
  cylinders.forEach(({ pointer, row }, index) => {
    const other = row.cylinder?.pressure?.cycle_turns === trace.turns ? row.cylinder.pressure : {};
    form.put(`${pointer}/cylinder`, {
      ...row.cylinder, ...(bore === undefined ? {} : { bore_m: bore }), ...(ambient === undefined ? {} : { ambient_pressure_Pa: ambient }),
      pressure: { ...other, [side]: { angle_deg: trace.angles, pressure_Pa: pascals }, cycle_turns: trace.turns, ...(trace.turns === 2 ? { dead_centre_deg: centres[index] } : {}) },
    });
  });
  form.refresh();
  form.container.querySelector("#gas-text")?.closest("details")?.querySelector(".said")?.append(h("p", {}, `All ${cylinders.length} cylinders have it.`));
}

// pressure of each cylinder over the cycle of the shaft
function curve({ trace, pascals, centres, cylinders }) {
  const cycle = 360 * trace.turns;
  const most = Math.max(...pascals);
  const x = (angle) => LEFT + (angle / cycle) * (WIDTH - LEFT - 8);
  const y = (value) => HEIGHT - BOTTOM - (value / most) * (HEIGHT - BOTTOM - 16);
  const step = Math.ceil(trace.angles.length / MOST_POINTS);
  const shifts = centres ?? [0];
  const lines = shifts.map((shift, index) => {
    const points = trace.angles.flatMap((angle, k) => (k % step ? [] : [[(angle + shift) % cycle, pascals[k]]])).sort(([one], [other]) => one - other);
    return s("polyline", { class: `series-${(index % 7) + 1}`, points: points.map(([angle, value]) => `${x(angle).toFixed(1)},${y(value).toFixed(1)}`).join(" ") },
      s("title", {}, centres ? `cylinder ${cylinders[index].name} fires at ${figure(shift)}°` : "pressure"));
  });
  const names = centres ? placesOf(centres) : [];
  return s("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img",
    "aria-label": `Pressure up to ${figure(most / 1e5, 4)} bar over ${cycle}°${centres ? `; fires at ${centres.map((angle, index) => `${figure(angle)}° (${cylinders[index].name})`).join(", ")}` : ""}.` },
  s("line", { x1: LEFT, y1: HEIGHT - BOTTOM, x2: WIDTH - 8, y2: HEIGHT - BOTTOM }), lines,
  Array.from({ length: cycle / 180 + 1 }, (_, index) => s("text", { x: x(180 * index), y: HEIGHT - 10, class: "centred" }, `${180 * index}°`)),
  s("text", { x: LEFT - 4, y: y(most) + 4, class: "end" }, `${figure(most / 1e5, 3)} bar`),
  names.map(([angle, text]) => s("text", { x: x(angle), y: 11, class: "centred" }, text)));
}

// those that fire together share a label
function placesOf(centres) {
  const places = new Map();
  centres.forEach((angle, index) => places.set(angle, [...(places.get(angle) ?? []), index + 1]));
  return [...places].map(([angle, names]) => [angle, names.join(", ")]);
}
