// What is on the page, kept at every edit: in the tab, to be there after a reload, and in the browser, to be offered again.

const TAB = "counterweight-session";
const LAST = "counterweight-last";
const LATER_MS = 300;

/** @type {(() => { request: any, example: string | null } | null)} */
let current = () => null;
let timer = 0;

function write() {
  clearTimeout(timer);
  timer = 0;
  const now = current();
  if (!now) return;
  const text = JSON.stringify({ ...now, hash: location.hash, at: Date.now() });
  // a browser may keep nothing, or have no room: the link and the file remain
  for (const [place, name] of /** @type {[Storage, string][]} */ ([[sessionStorage, TAB], ...(now.example ? [] : [[localStorage, LAST]])])) {
    try {
      place.setItem(name, text);
    } catch {
      place.removeItem(name);
    }
  }
}

const read = (place, name) => {
  try {
    const found = JSON.parse(place.getItem(name) ?? "null");
    return found && typeof found.request === "object" ? found : null;
  } catch {
    return null;
  }
};

export function session(now) {
  current = now;
  addEventListener("pagehide", () => timer && write());
  document.addEventListener("visibilitychange", () => document.hidden && timer && write());
}

export function keepSession() {
  if (!timer) timer = setTimeout(write, LATER_MS);
}

// of this tab, at this address
export function ofTab() {
  const found = read(sessionStorage, TAB);
  return found && found.hash === location.hash ? found : null;
}

export const last = () => read(localStorage, LAST);
export const forget = () => localStorage.removeItem(LAST);
