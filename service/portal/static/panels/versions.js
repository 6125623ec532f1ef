// Named versions side by side: what was asked differently, and what came of it.

import { h, table } from "../dom.js";
import { saveJson } from "../files.js";
import { figure, share } from "../format.js";
import { called } from "../naming.js";
import { differences, keepVersions, responsesOf, resultOf, versions as kept } from "../versions.js";

const MOST_DIFFERENCES = 60;

export const versions = {
  id: "versions", title: "Versions side by side",
  about: "Kept under a name in this browser; two or more are compared.",
  draw(body, { request, answer, adopt }) {
    const name = h("input", { type: "text", id: "version-name", autocomplete: "off", value: request.machine.name ?? "" });
    const said = h("p", { class: "error", role: "alert" });
    const list = h("div", {});
    const compared = h("div", { class: "compared", "aria-live": "polite" });
    const chosen = new Set();
    const save = (all) => {
      if (!keepVersions(all)) said.textContent = "This browser has no room for another version: export them, and remove some.";
      draw();
    };
    const keep = () => {
      const title = name.value.trim() || "without a name";
      const taken = new Set(kept().map((one) => one.name));
      let free = title;
      for (let count = 2; taken.has(free); count += 1) free = `${title} (${count})`;
      chosen.add(free);
      save([...kept(), { name: free, at: new Date().toISOString(), request: structuredClone(request), result: resultOf(request, answer) }]);
    };
    const read = async (event) => {
      const [file] = event.target.files;
      event.target.value = "";
      try {
        const given = JSON.parse(await file.text());
        const names = new Set(kept().map((one) => one.name));
        save([...kept(), ...given.versions.filter((one) => one.request && one.result && !names.has(one.name))]);
      } catch {
        said.textContent = "This file holds no versions.";
      }
    };
    const draw = () => {
      const all = kept();
      const line = (one) => {
        const box = h("input", { type: "checkbox", "aria-label": `compare ${one.name}`, checked: chosen.has(one.name), change: () => {
          if (box.checked) chosen.add(one.name); else chosen.delete(one.name);
          compare();
        } });
        return h("li", {}, h("label", {}, box, ` ${one.name} `), h("span", { class: "about" }, ` ${new Date(one.at).toLocaleString()} `),
          h("button", { type: "button", class: "small", "aria-label": `Open ${one.name}`, click: () => adopt(structuredClone(one.request)) }, "Open"), " ",
          h("button", { type: "button", class: "small", "aria-label": `Remove ${one.name}`, click: () => { chosen.delete(one.name); save(kept().filter((other) => other.name !== one.name)); } }, "Remove"));
      };
      list.replaceChildren(h("ul", { class: "versions" }, all.map(line)));
      compare();
    };
    const compare = () => {
      const some = kept().filter((one) => chosen.has(one.name));
      compared.replaceChildren(...(some.length > 1 ? [results(some), asked(some)] : []));
    };
    body.replaceChildren(
      h("div", { class: "controls" }, h("div", { class: "choose" }, h("label", { for: "version-name" }, "Name"), name),
        h("button", { type: "button", click: keep }, "Keep this version"),
        h("button", { type: "button", class: "small", click: () => saveJson({ versions: kept() }, "versions.json") }, "Export all"),
        h("label", { class: "button", for: "version-file" }, "Import", h("input", { id: "version-file", type: "file", accept: ".json,application/json", change: read }))),
      said, list, compared);
    draw();
  },
};

function results(some) {
  const webs = [...new Set(some.flatMap(({ result }) => result.counterweights.map((one) => one.web)))];
  const of = (title, value) => [title, ...some.map((one) => value(one.result))];
  const all = new Map(some.flatMap(({ result }) => responsesOf(result)).map(({ name, unit }) => [name, unit]));
  const valueOf = (name) => (result) => responsesOf(result).find((one) => one.name === name)?.value ?? null;
  /** @type {[string, (result: any) => number | null][]} */
  const names = [...[...all].map(([name, unit]) => /** @type {any} */ ([`peak ${name}, ${unit}`.replace("peak root", "root"), valueOf(name)])),
    ["total mass, kg", (result) => result.total_mass_kg]];
  const weight = (web) => (result) => {
    const one = result.counterweights.find((each) => each.web === web);
    return { number: true, text: one ? `${figure(one.mass_kg)} kg at ${figure(one.angle_deg, 4)}°` : "–" };
  };
  return table("What came of them", ["", ...some.map((one) => one.name)], [
    of("status", (result) => result.status), ...names.map(([title, value]) => [title, ...ranked(some.map((one) => value(one.result)))]),
    ...webs.map((web) => of(web, weight(web)))]);
}

// the smallest is marked, and the others say by how much they are above it
function ranked(values) {
  const known = values.filter((value) => value !== null && value !== undefined);
  const best = Math.min(...known);
  const same = (value) => value <= best + 1e-6 * Math.abs(best);
  return values.map((value) => {
    const beside = value === null || value === undefined || known.every(same) ? ""
      : same(value) ? " (best)" : best > 1e-9 * value ? ` (+${share(value / best - 1)})` : ` (+${figure(value - best)})`;
    return { number: true, text: `${figure(value)}${beside}` };
  });
}

function asked(some) {
  const found = differences(some.map((one) => one.request));
  if (!found.length) return h("p", {}, "They ask the same.");
  const said = (value) => (value === undefined ? "–" : String(value));
  return h("div", {}, table("What was asked differently", ["field", ...some.map((one) => one.name)],
    found.slice(0, MOST_DIFFERENCES).map(([pointer, values]) => [called(some[0].request, pointer), ...values.map(said)])),
  found.length > MOST_DIFFERENCES ? h("p", { class: "about" }, `and ${found.length - MOST_DIFFERENCES} more`) : null);
}
