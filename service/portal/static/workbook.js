// Workbooks: one to begin with, the machine that is worked on, one that is opened, and one that is optimised and comes back
// with its answer.

import { ask, post } from "./api.js";
import { byId } from "./dom.js";
import { fileName, save } from "./files.js";

const XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

const typed = (file) => new Blob([file], { type: XLSX });

// the request that a workbook holds
export const requestIn = (file) => post("v1/convert", typed(file));

// errors of a workbook name their cells
export const told = (error) => [error.message, ...(error.errors ?? []).map((one) => one.message)].join(" ");

async function fetched(said, name, method, path, body) {
  said.textContent = "";
  try {
    const answer = await ask(method, path, { body, headers: { Accept: XLSX } });
    save(await answer.blob(), fileName(name, "xlsx"));
  } catch (error) {
    said.textContent = told(error);
  }
}

/** @param {{ example: string | null, request: any }} work */
export function workbooks(work) {
  const said = byId("json-error");
  byId("template").addEventListener("click", () => fetched(said, "machine", "GET", "v1/template.xlsx?example=empty"));
  // an answer stands in a workbook behind its request
  byId("save-workbook").addEventListener("click", () => fetched(said, work.request.machine?.name ?? work.example, "POST", "v1/optimize", work.request));
  byId("workbook").addEventListener("change", async (event) => {
    const [file] = event.target.files;
    if (file) await fetched(said, `${file.name.replace(/\.xlsx$/i, "")}-answer`, "POST", "v1/optimize", typed(file));
    event.target.value = "";
  });
}
