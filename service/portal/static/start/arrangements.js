// Arrangements of machines: the directions of their rows, and the usual angles of their cranks.

const evenly = (count) => Array.from({ length: count }, (_, index) => (360 * index) / count);
const single = (count) => (count === 4 ? [0, 90, 270, 180] : evenly(count));
// opposed throws come in pairs, each half a turn apart
const opposite = (pairs) => pairs.flatMap((angle) => [angle, (angle + 180) % 360]);
const compressor = (count) => opposite(evenly(Math.max(1, count / 2)).map((angle) => (count % 4 ? angle : angle / 2))).slice(0, count);
// the pairs of an engine mirror one another where their number is even, so that little of a couple is left
const boxer = (count) => {
  const pairs = Math.max(1, Math.ceil(count / 2));
  return (pairs === 2 ? [0, 180, 180, 0] : opposite(single(pairs))).slice(0, count);
};
const inTurn = (index) => [index % 2 ? 180 : 0];

/**
 * `axes`: directions of the rows on one throw; `asks`: questions of this arrangement alone.
 * @type {{ [name: string]: { title: string, drawn: number[], axes: (index: number, angle: number) => number[], cranks: (count: number) => number[], asks?: string[] } }}
 */
export const ARRANGEMENTS = {
  vertical: { title: "in line, vertical", drawn: [90], axes: () => [90], cranks: single, asks: ["shafts"] },
  horizontal: { title: "in line, horizontal", drawn: [0], axes: () => [0], cranks: single, asks: ["shafts"] },
  opposed: { title: "opposed compressor", drawn: [0, 180], axes: inTurn, cranks: compressor },
  boxer: { title: "boxer engine", drawn: [0, 180], axes: inTurn, cranks: boxer, asks: ["shafts"] },
  v: { title: "V", drawn: [45, 135], axes: (_, angle) => [90 - angle / 2, 90 + angle / 2], cranks: evenly, asks: ["angle", "split", "offset", "shafts"] },
  w: { title: "W of 60°", drawn: [30, 90, 150], axes: () => [30, 90, 150], cranks: evenly },
};
export const SCROLL = "scroll";
