// The machine from the front and along its shaft, as the service draws it: of many questions the latest is answered.

import { post, Problem } from "../api.js";
import { h } from "../dom.js";
import { complaint } from "../naming.js";

// what is drawn: all else stays here, however long it is
const DRAWN = ["machine", "counterweights", "fitted", "kind", "rotation", "reference_plane_m", "name", "position_m", "throws", "crank_radius_m", "crank_angle_deg",
  "rows", "axis_deg", "offset_m", "webs", "counterweight_radius_m", "max_mass_kg", "sector", "centre_deg", "half_angle_deg", "envelope", "inner_radius_m",
  "outer_radius_m", "thickness_m", "fixed", "bearings", "orbit_radius_m", "orbiting_position_m", "anti_rotation", "type", "count", "pin_circle_radius_m",
  "balance_shafts", "speed_ratio", "x_m", "y_m", "web", "mass_kg", "angle_deg", "radius_m", "shape", "chord_height_m"];
const FEW = 3;

const objects = (list) => [list ?? []].flat().filter((one) => one !== null && typeof one === "object");

// the question for the views of a machine
export const question = (machine, counterweights, fitted = []) => JSON.parse(
  JSON.stringify({ machine: Object(machine), counterweights, fitted: objects(fitted) }, DRAWN));

// a drawing in the colours of the page
export function view(svg, name) {
  const found = document.importNode(new DOMParser().parseFromString(svg, "image/svg+xml").documentElement, true);
  for (const size of ["width", "height"]) found.removeAttribute(size);
  found.setAttribute("class", `view ${name}`);
  return found;
}

// One question is on its way at a time. What was asked for meanwhile is asked next; an answer that is no longer wanted is dropped.
export class Views {
  /** @type {{ request: any, counterweights: any[], fitted: any[] } | null} */
  #wanted = null;
  /** @type {Promise<void> | null} */
  #running = null;

  /**
   * @param {(found: any, request: any) => void} show
   * @param {(why: string) => void} fail
   */
  constructor(show, fail) {
    this.show = show;
    this.fail = fail;
  }

  // resolves when this is drawn, or what was asked for after it
  ask(request, counterweights = [], fitted = []) {
    this.#wanted = { request, counterweights, fitted };
    this.#running ??= this.#work();
    return this.#running;
  }

  cancel() {
    this.#wanted = null;
  }

  async #work() {
    // several key strokes of one moment are one question
    await null;
    while (this.#wanted) {
      const mine = this.#wanted;
      try {
        const found = await post("v1/layout", question(mine.request.machine, mine.counterweights, mine.fitted), { waiting: this.fail });
        if (mine === this.#wanted) this.show(found, mine.request);
      } catch (error) {
        if (!(error instanceof Problem)) console.error(error);
        if (mine === this.#wanted) this.fail(error.message);
      }
      if (mine === this.#wanted) this.#wanted = null;
    }
    this.#running = null;
  }
}

// Both views of the machine that is worked on. What cannot be drawn anew stays, greyed, with a line that says why.
export class Drawings extends Views {
  element = h("div", { class: "drawings", id: "drawings" });
  #note = h("p", { class: "about", role: "status" });

  constructor() {
    super((found, request) => this.#draw(found, request), (why) => this.#say(`Not drawn anew: ${why}`, true));
  }

  clear() {
    this.cancel();
    this.element.replaceChildren();
    this.#say("", false);
  }

  #say(words, old) {
    this.#note.textContent = words;
    this.element.classList.toggle("old", old);
    this.element.append(this.#note);
  }

  #draw({ front, side, missing }, request) {
    if (front !== null) {
      const [face, along] = [view(front, "front"), view(side, "side")];
      const unknown = face.querySelector(".unknown") ? " A dashed disc stands for a counterweight of unknown shape about its centre of mass." : "";
      const built = face.querySelector(".built") ? " As built: dashed, without a ground." : "";
      this.element.replaceChildren(
        h("figure", {}, face, h("figcaption", {}, `From the front, to scale, shaft angle 0.${unknown}${built}`)),
        h("figure", {}, along, h("figcaption", {}, "Along the shaft, with a scale of its own; what stands towards you is drawn down and to the left.")));
    }
    const reasons = missing.slice(0, FEW).map((one) => complaint(request, one)).join("; ");
    this.#say(missing.length ? `Not drawn yet: ${reasons}${missing.length > FEW ? `; and ${missing.length - FEW} more` : ""}.` : "", front === null);
  }
}
