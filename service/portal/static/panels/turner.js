// The shaft angle of a moving picture: a slider, and a button that turns the shaft until it is pressed again.

import { h } from "../dom.js";
import { figure } from "../format.js";

const SECONDS_A_TURN = 6;
const STEP_DEG = 30;

/**
 * @param {string} id of the slider
 * @param {number[]} angles deg, one a picture
 * @param {(step: number) => void} show draws one of them
 * @param {() => boolean} seen whether anybody sees it: what is closed needs no frames
 */
export function turner(id, angles, show, seen) {
  const count = angles.length;
  const slider = h("input", { id, type: "range", min: 0, max: count - 1, step: 1, value: 0, input: () => { stop(); go(Number(slider.value)); } });
  const shown = h("output", { for: id });
  // who asks for less motion turns it by hand
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  let running = 0;
  const go = (step) => {
    show(step);
    slider.value = step;
    shown.textContent = `${figure(angles[step])}°`;
  };
  const stop = () => {
    cancelAnimationFrame(running);
    running = 0;
    if (still) return;
    button.setAttribute("aria-pressed", "false");
    button.textContent = "Turn";
  };
  const start = () => {
    const from = Number(slider.value);
    let began = 0;
    const step = (now) => {
      if (!seen()) return stop();
      began ||= now;
      go(Math.floor(from + (count * (now - began)) / (1000 * SECONDS_A_TURN)) % count);
      running = requestAnimationFrame(step);
      return undefined;
    };
    button.setAttribute("aria-pressed", "true");
    button.textContent = "Stop";
    running = requestAnimationFrame(step);
  };
  const further = () => {
    const next = angles.findIndex((angle) => angle >= angles[Number(slider.value)] + STEP_DEG);
    go(Math.max(0, next));
  };
  const button = still ? h("button", { type: "button", click: further }, `Turn by ${STEP_DEG}°`)
    : h("button", { type: "button", "aria-pressed": "false", click: () => (running ? stop() : start()) }, "Turn");
  go(0);
  return h("div", { class: "slide" }, button, h("label", { for: id }, "Shaft angle"), slider, shown);
}
