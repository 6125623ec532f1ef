// Work that waits until nobody types: what is asked for several times is done once, when the page has nothing else to do.

const LATEST_MS = 1_000;
// not every browser tells when it is idle
const idle = globalThis.requestIdleCallback ?? ((work) => setTimeout(work, 1));
const busy = globalThis.cancelIdleCallback ?? clearTimeout;

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
