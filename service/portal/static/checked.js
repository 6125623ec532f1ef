// What the independent checker makes of an answer, once it is shown: how many of its claims were looked at, and which not.

import { post, Problem } from "./api.js";
import { h } from "./dom.js";

const SHOWN = 6;

// "main_bearings bearings * load_N" of /answer/main_bearings/bearings/*/load_N
const words = (pointer) => pointer.split("/").slice(2).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~")).join(" ");

function sentences({ verdict, leaves, checked, claims, not_covered: missed }) {
  const count = `checked: ${checked} of ${leaves} claims`;
  const broken = claims.filter((one) => one.verdict === "broken");
  if (verdict === "broken") return [`${count}. Broken: ${broken.map((one) => `${one.claim} (${words(one.where)})`).join(", ")}.`];
  if (verdict === "held") return [`${count}, and every one holds.`];
  const names = [...new Set([...claims.filter((one) => one.verdict === "not covered").map((one) => one.where), ...missed])];
  const rest = names.length > SHOWN ? ` and ${names.length - SHOWN} more` : "";
  return [`${count}; nothing is broken. Not covered: ${names.slice(0, SHOWN).map(words).join(", ")}${rest}.`];
}

export async function showChecked(place, request, answer, signal) {
  const note = h("p", { class: "checked", role: "status" }, "The answer is being checked …");
  place.append(note);
  try {
    const found = await post("v1/verify", { request, answer }, { signal });
    note.dataset.verdict = found.verdict;
    note.replaceChildren(...sentences(found));
  } catch (error) {
    if (error.name === "AbortError") note.remove();
    else if (error instanceof Problem) note.replaceChildren(`The answer was not checked: ${error.message}`);
    else throw error;
  }
}
