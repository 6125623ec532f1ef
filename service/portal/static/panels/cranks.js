// How much of its own crank each pair of webs balances, which decides what the bearings have to carry.

import { h, table } from "../dom.js";
import { beside, nameOf, number } from "../format.js";

// a share of the rotating mass, in words
function words(rate) {
  if (rate === null) return "nothing turns out of balance";
  if (rate < 0.05) return "bare: the bearings carry all of it";
  if (rate < 0.95) return "in part";
  return rate <= 1.05 ? "balanced by itself" : "more than balanced: for reciprocating masses, or for other throws";
}

export const cranks = {
  id: "cranks", title: "Balance rate of every crank", kind: "reciprocating", open: true,
  about: "Which share of the rotating mass of each throw its own webs balance. What is balanced from the outside alone may leave a crank bare.",
  draw(body, { answer }) {
    const rates = answer.balance_rate ?? [];
    body.replaceChildren(rates.length
      ? table("Balance rates", ["throw", "balance rate", "sideways", "in words"], rates.map((one) => [nameOf(one, one.throw), number(one.rate, 3),
        { number: true, text: one.sideways === null ? "–" : beside(one.sideways, 1) }, words(one.rate)]))
      : h("p", {}, "There are no counterweights to state a balance rate for."));
  },
};
