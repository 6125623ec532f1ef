// Workbooks: one to begin with, and one that is optimised and comes back with its answer.

import { ask } from "./api.js";
import { byId } from "./dom.js";
import { named, save } from "./files.js";

const XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

async function fetched(said, method, path, body) {
  said.textContent = "";
  try {
    const answer = await ask(method, path, { body, headers: { Accept: XLSX } });
    save(await answer.blob(), named(answer) ?? "answer.xlsx");
  } catch (error) {
    // errors of a workbook name their cells
    said.textContent = [error.message, ...(error.errors ?? []).map((one) => one.message)].join(" ");
  }
}

/** @param {() => string | null} example what the template holds; null is the first */
export function workbooks(example) {
  const said = byId("json-error");
  byId("template").addEventListener("click", () => fetched(said, "GET", `v1/template.xlsx?example=${encodeURIComponent(example() ?? "2d12")}`));
  byId("workbook").addEventListener("change", async (event) => {
    const [file] = event.target.files;
    if (file) await fetched(said, "POST", "v1/optimize", new Blob([file], { type: XLSX }));
    event.target.value = "";
  });
}
