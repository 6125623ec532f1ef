// One page: choose or paste a machine, edit it, optimise, look.

import { get } from "./api.js";
import { choices } from "./beginning.js";
import { byId } from "./dom.js";
import { Drawings } from "./drawing/views.js";
import { Embedding } from "./embed.js";
import { fileName, saveJson } from "./files.js";
import { Form } from "./form/form.js";
import { Opening } from "./opening.js";
import { accuracy } from "./panels/accuracy.js";
import { counterweights } from "./panels/counterweights.js";
import { cranks } from "./panels/cranks.js";
import { flywheel, mainBearings, rodLoads, torque } from "./panels/dynamics.js";
import { hodographs, orders, overAngle } from "./panels/first_order.js";
import { foundation } from "./panels/foundation.js";
import { match } from "./panels/match.js";
import { missing, offered, Panels } from "./panels/panels.js";
import { pareto } from "./panels/pareto.js";
import { bearingCurves, indicator, orderHodographs, stageScheme } from "./panels/pictures.js";
import { pins } from "./panels/pins.js";
import { sweep } from "./panels/sweep.js";
import { turning } from "./panels/turning.js";
import { versions } from "./panels/versions.js";
import { whatIf } from "./panels/what_if.js";
import { Run } from "./run.js";
import { schemas } from "./schema.js";
import { starter } from "./starter.js";
import { theme } from "./theme.js";
import { Work } from "./work.js";
import { workbooks } from "./workbook.js";

const MODEL = "OptimizeRequest";
/** @type {{ id: string, title: string, output?: string, [more: string]: any }[]} */
const PANELS = [counterweights, foundation, whatIf, versions, cranks, hodographs, turning, overAngle, orders, orderHodographs, stageScheme, pareto, accuracy, indicator, torque, rodLoads, flywheel, mainBearings, bearingCurves, pins, match, sweep];

const schema = schemas();
const examples = get("v1/examples");
/** @type {any} made when the schema is here */
let form = null;

const panels = new Panels(byId("panels"), PANELS, {
  toggled: () => work.keep(), blamed: (errors) => form?.errors.say(errors),
});
const work = new Work(() => [...panels.wanted]);
const embedding = new Embedding({ take: (request) => take(request, null), request: () => work.request });
const drawings = new Drawings();

// what an answer on this machine can hold, of all panels or of some
const outputs = (of) => ({ machine: given }) => {
  const machine = Object(given);
  return ["residual", ...of.filter((panel) => panel.output && offered(panel, machine) && !missing(panel, machine).length).map((panel) => panel.output)];
};

const run = new Run({
  work, panels, embedding, schema, drawings, examples, form: () => form, outputs: { all: outputs(PANELS), first: outputs([hodographs, orders, foundation]) },
  context: { schema, model: MODEL, keep, adopt: (other) => take(other, null) },
});
const opening = new Opening({ take, complain: (error) => run.complain(error), open: (ids) => panels.open(ids), fresh: () => run.count === 0, work, form: () => form });

function keep(name, value) {
  work.kept[name] = value;
  work.keep();
}

function edited(request, pointer) {
  work.edit(request, pointer);
  changed();
}

// the answer is no longer that of the machine
function changed(why = "Edited: press Optimise.") {
  work.changed();
  embedding.edited();
  byId("results").classList.add("stale");
  byId("progress").textContent = why;
  tools();
  if (!drawings.element.isConnected) byId("answer").append(drawings.element);
  drawings.ask(work.request);
}

function tools() {
  byId("example").value = work.example ?? "";
  byId("undo").disabled = !work.undoable;
  byId("redo").disabled = !work.redoable;
}

function go(which, why) {
  if (!work.go(which)) return;
  form.restore(work.request);
  changed(why);
}

const undo = () => go("undo", "Undone: press Optimise.");
const redo = () => go("redo", "Done again: press Optimise.");

// `push`: Back leads to what was there before
async function take(request, example, kept = {}, { push = true } = {}) {
  const { places } = work;
  if (push && work.unkept && work.request) await work.keep();
  // the reader went elsewhere while that was being packed
  if (places !== work.places) return;
  work.begin(request, example, kept);
  tools();
  work.keep({ push: push && run.count > 0 && parent === self });
  const ran = request.machine?.throws?.length === 0 ? run.begin() : run.ask();
  await schema.then((known) => {
    form ??= new Form(byId("form"), known, MODEL, edited);
    form.show(work.request);
  });
  await ran;
}

// Ctrl+Z in the form undoes what was done to the machine, whatever it was
function keys(event) {
  if (!(event.ctrlKey || event.metaKey) || event.target.closest("dialog, #paste, #results")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) redo(); else undo();
}

function save() {
  saveJson(work.request, fileName(work.request.machine?.name ?? work.example, "machine.json"));
  work.unsaved = false;
}

function listen() {
  byId("form").addEventListener("submit", (event) => { event.preventDefault(); run.ask(); });
  byId("example").addEventListener("change", (event) => event.target.value && opening.example(event.target.value));
  byId("read").addEventListener("click", () => opening.text(byId("json").value));
  byId("write").addEventListener("click", () => { byId("json").value = JSON.stringify(work.request, null, 2); });
  byId("file").addEventListener("change", async (event) => {
    const [file] = event.target.files;
    if (file) await opening.file(file);
    event.target.value = "";
  });
  workbooks(work);
  byId("new").addEventListener("click", () => starter((request, example = null) => take(request, example)));
  byId("undo").addEventListener("click", undo);
  byId("redo").addEventListener("click", redo);
  byId("save").addEventListener("click", save);
  document.addEventListener("keydown", keys);
  document.addEventListener("paste", (event) => opening.pasted(event));
  // a file that is dropped anywhere is opened
  document.addEventListener("dragover", (event) => event.dataTransfer?.types.includes("Files") && event.preventDefault());
  document.addEventListener("drop", (event) => {
    const [file] = event.dataTransfer?.files ?? [];
    if (!file) return;
    event.preventDefault();
    opening.file(file);
  });
  addEventListener("beforeunload", (event) => work.unsaved && parent === self && event.preventDefault());
  // before anything is written: what comes later would be written into the place that was gone to
  addEventListener("popstate", () => {
    work.leave();
    opening.link(location.hash);
  });
}

theme(byId("theme"));
listen();
examples.then((found) => {
  byId("example").replaceChildren(...choices(found.examples));
  tools();
}, (error) => run.complain(error));
opening.link(location.hash);
