// What is on the page, kept by the browser: in the tab, to be there after a reload, and beyond it, to be offered again.

const TAB = "counterweight-session";
const LAST = "counterweight-last";

/** @param {{ request: any, example: string | null }} now */
export function store(now) {
  const text = JSON.stringify({ ...now, hash: location.hash, at: Date.now() });
  // a browser may keep nothing, or have no room: the link and the file remain
  for (const [place, name] of /** @type {[Storage, string][]} */ ([[sessionStorage, TAB], ...(now.example !== null ? [] : [[localStorage, LAST]])])) {
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

// of this tab, at this address
export function ofTab() {
  const found = read(sessionStorage, TAB);
  return found && found.hash === location.hash ? found : null;
}

export const last = () => read(localStorage, LAST);
export const forget = () => localStorage.removeItem(LAST);
