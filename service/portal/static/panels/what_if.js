// What if: weights as they will be fitted beside the optimum, limits and speed moved, the residual at every key stroke.

import { post } from "../api.js";
import { h, table } from "../dom.js";
import { figure, number, share } from "../format.js";
import { quantity, read } from "../quantity.js";
import { everyWeight, wholeMass } from "./counterweights.js";

// steps that a workshop likes
const STEPS = { mass: "0.5", angle: "5" };

const peaks = (state) => [state.force.peak_N, state.moment.peak_Nm];
const change = (now, was) => (was > 0 ? `${now >= was ? "+" : "−"}${share(Math.abs(now / was - 1))}` : now > 0 ? "from nothing" : "±0 %");

// the newest of calls that overtake one another
function newest() {
  let running = null;
  return async (path, body) => {
    running?.abort();
    const mine = running = new AbortController();
    try {
      return await post(path, body, { signal: mine.signal });
    } catch (error) {
      if (error.name === "AbortError") return null;
      throw error;
    }
  };
}

export const whatIf = {
  id: "what-if", title: "What if: weights as fitted, limits, speed",
  about: "Type the weights as they will be made. The residual is computed at every key stroke.",
  draw(body, context) {
    const { answer } = context;
    if (!everyWeight(answer).length || !answer.residual.after) {
      body.replaceChildren(h("p", {}, "There are no counterweights to change here."));
      return;
    }
    body.replaceChildren(...fitted(context), ...limits(context));
  },
};

function fitted({ request, answer, told }) {
  const { machine } = request;
  const shaped = (one) => (one.shape ? { radius_m: one.radius_m } : {});
  const optimum = everyWeight(answer);
  const weights = optimum.map(({ web, mass_kg: mass, angle_deg: angle, ...more }) => ({ web, mass_kg: mass, angle_deg: angle, ...shaped(more) }));
  const result = h("div", { class: "residual", role: "status" });
  const inputs = [];
  const call = newest();
  const ask = (counterweights) => ({ machine, counterweights: counterweights.filter((one) => one.mass_kg > 0), outputs: ["residual"] });
  const tell = (found) => {
    const [force, moment] = peaks(found.residual.after);
    const [leastForce, leastMoment] = peaks(answer.residual.after);
    const [bareForce, bareMoment] = peaks(answer.residual.before);
    result.replaceChildren(table("What remains", ["", "without", "optimum", "as fitted", "against the optimum"], [
      ["peak force, N", number(bareForce), number(leastForce), number(force), change(force, leastForce)],
      ["peak moment, N m", number(bareMoment), number(leastMoment), number(moment), change(moment, leastMoment)],
      ["total mass, kg", number(null), number(wholeMass(answer)), number(wholeMass(found)), change(wholeMass(found), wholeMass(answer))]]));
    result.dataset.of = JSON.stringify(weights.map((one) => [one.mass_kg, one.angle_deg]));
  };
  const compute = async () => {
    const wrong = inputs.filter(({ input, unit }) => !Number.isFinite(quantity(read(input.value, unit), unit)) || input.value.trim() === "");
    for (const { input } of inputs) input.setAttribute("aria-invalid", String(wrong.some((one) => one.input === input)));
    if (wrong.length) return;
    const question = ask(weights);
    told({ method: "POST", path: "v1/analyze", body: question });
    try {
      const found = await call("v1/analyze", question);
      if (found) tell(found);
    } catch (error) {
      result.replaceChildren(h("p", { class: "error" }, [error.message, ...(error.errors ?? []).map((one) => one.message)].join(" ")));
    }
  };
  const cell = (index, name, unit) => {
    const input = h("input", { type: "text", value: figure(weights[index][name], 6).replace(/\s/g, ""), autocomplete: "off",
      "aria-label": `${name === "mass_kg" ? "mass, kg" : "angle, °"}, ${weights[index].web}, as fitted`, input: () => {
        weights[index][name] = quantity(read(input.value, unit), unit);
        compute();
      } });
    inputs.push({ input, unit, index, name });
    return h("td", { class: "cell is-number" }, input);
  };
  const rows = optimum.map((one, index) => h("tr", {}, h("th", { scope: "row" }, one.web),
    h("td", { class: "number" }, figure(one.mass_kg)), h("td", { class: "number" }, one.mass_kg > 0 ? figure(one.angle_deg) : "–"),
    cell(index, "mass_kg", "kg"), cell(index, "angle_deg", "deg")));
  const put = (masses) => {
    masses.forEach((one, index) => Object.assign(weights[index], one));
    for (const { input, index, name } of inputs) input.value = String(weights[index][name]);
  };
  const said = h("span", { role: "status" });
  const step = (label, value) => h("input", { type: "text", value, autocomplete: "off", size: 5, "aria-label": label });
  const [massStep, angleStep] = [step("step of masses, kg", STEPS.mass), step("step of angles, °", STEPS.angle)];
  // the best of all roundings to these steps, and what they cost
  const suggest = async () => {
    const [mass, angle] = [quantity(read(massStep.value, "kg"), "kg"), quantity(read(angleStep.value, "deg"), "deg")];
    const question = { request: { ...request, outputs: ["residual"] }, mass_step_kg: mass, angle_step_deg: angle };
    told({ method: "POST", path: "v1/round", body: question });
    try {
      const found = await call("v1/round", question);
      if (!found) return;
      if (!found.rounding) {
        said.textContent = found.status_reason;
        return;
      }
      put(everyWeight(found).map((one) => ({ mass_kg: one.mass_kg, angle_deg: one.angle_deg })));
      const { relative_rise: rise, masses_alone_rise: masses, angles_alone_rise: angles } = found.rounding;
      const cost = rise === null ? "" : ` The objective rises by ${share(Math.max(rise, 0))}.`;
      const finer = masses > angles ? "masses" : "angles";
      said.textContent = `Rounded to ${mass} kg and ${angle}°.${cost} The step of the ${finer} costs more.`;
      compute();
    } catch (error) {
      said.textContent = [error.message, ...(error.errors ?? []).map((one) => one.message)].join(" ");
    }
  };
  const back = () => {
    put(optimum.map((one) => ({ mass_kg: one.mass_kg, angle_deg: one.angle_deg })));
    said.textContent = "";
    compute();
  };
  compute();
  return [
    h("div", { class: "grid" }, h("div", { class: "wide" }, h("table", {}, h("caption", {}, "Optimum, and as fitted"),
      h("thead", {}, h("tr", {}, ["web", "mass, kg", "angle, °", "fitted mass, kg", "fitted angle, °"].map((head) => h("th", { scope: "col" }, head)))), h("tbody", {}, rows)))),
    h("div", { class: "buttons" }, h("label", {}, "steps ", massStep, " kg "), h("label", {}, angleStep, "° "),
      h("button", { type: "button", class: "small", click: suggest }, "Suggest a rounding"),
      h("button", { type: "button", class: "small", click: back }, "As the optimum"), said), result];
}

// all largest masses and the speed, in per cent of what was asked
function limits({ request, answer, adopt }) {
  const call = newest();
  const result = h("div", { class: "moved", role: "status" });
  const slider = (id, title) => {
    const shown = h("output", { for: id }, "100 %");
    const input = h("input", { id, type: "range", min: 50, max: 150, step: 1, value: 100, input: () => {
      shown.textContent = `${input.value} %`;
      compute();
    } });
    return { input, line: h("div", { class: "slide" }, h("label", { for: id }, title), input, shown) };
  };
  const [mass, speed] = [slider("what-mass", "Largest masses"), slider("what-speed", "Speed")];
  const moved = () => {
    const changed = structuredClone(request);
    const [part, pace] = [mass.input, speed.input].map((input) => Number(input.value) / 100);
    const scaled = (value, unit, by) => (value === null || value === undefined ? value : Number((quantity(value, unit) * by).toPrecision(12)));
    const { machine } = changed;
    const webs = [machine, ...(machine.balance_shafts ?? [])].flatMap((shaft) => shaft.webs ?? []);
    if (part !== 1) for (const web of webs) web.max_mass_kg = scaled(web.max_mass_kg, "kg", part);
    if (pace !== 1) {
      machine.speed_rpm = scaled(machine.speed_rpm, "rpm", pace);
      if (machine.overspeed_rpm) machine.overspeed_rpm = scaled(machine.overspeed_rpm, "rpm", pace);
    }
    return changed;
  };
  const compute = async () => {
    try {
      const found = await call("v1/optimize", { ...moved(), outputs: ["residual"] });
      if (found) result.replaceChildren(summary(found, answer));
    } catch (error) {
      result.replaceChildren(h("p", { class: "error" }, error.message));
    }
  };
  return [h("h3", {}, "Limits and speed"), mass.line, speed.line, result,
    h("div", { class: "buttons" }, h("button", { type: "button", class: "small", click: () => adopt(moved()) }, "Take these limits"))];
}

function summary(found, answer) {
  if (!found.residual.after) return h("p", { class: "error" }, "No counterweights meet the ceilings then.");
  const row = (title, now, was) => [title, number(was), number(now), change(now, was)];
  const [was, now] = [answer, found].map(({ residual }) => peaks(residual.after));
  return table("The optimum then", ["", "now", "then", "change"], [row("peak force, N", now[0], was[0]), row("peak moment, N m", now[1], was[1]),
    row("total mass, kg", wholeMass(found), wholeMass(answer))]);
}
