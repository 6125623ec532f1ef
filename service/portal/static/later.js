// Work that waits until nobody types: what is asked for several times is done once, when the page has nothing else to do.

const LATEST_MS = 1_000;
const HIDDEN_MS = 250;
// not every browser tells when it is idle
const idle = globalThis.requestIdleCallback ?? ((work) => setTimeout(work, 1));
const busy = globalThis.cancelIdleCallback ?? clearTimeout;

// until what was done is on the screen; a page in the background paints nothing and need not wait
export const painted = () => new Promise((resolve) => {
  requestAnimationFrame(() => setTimeout(resolve));
  setTimeout(resolve, HIDDEN_MS);
});

// until the page has nothing else to do
export const spared = () => new Promise((resolve) => idle(() => resolve(null), { timeout: LATEST_MS }));

export class Later {
  #timer = 0;
  #idle = 0;

  /** @param {() => void} work @param {number} after how long nothing must have been asked for, ms */
  constructor(work, after = 0) {
    this.work = work;
    this.after = after;
  }

  ask() {
    this.cancel();
    this.#timer = setTimeout(() => { this.#idle = idle(this.work, { timeout: LATEST_MS }); }, this.after);
  }

  cancel() {
    clearTimeout(this.#timer);
    busy(this.#idle);
  }
}
