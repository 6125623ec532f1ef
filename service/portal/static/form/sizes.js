// "Standard sizes": the sizes that counterweights are chosen from, as a step or a list, with how many of them and how many pieces.

export const SIZES = "/machine/catalogue";
const PIECES = "/machine/max_counterweights";
const TITLES = {
  [SIZES]: "Standard sizes",
  [`${SIZES}/mass_step_kg`]: "Step of the sizes",
  [`${SIZES}/masses_kg`]: "or a list of sizes",
  [`${SIZES}/angle_step_deg`]: "Step of the angles",
  [`${SIZES}/max_part_numbers`]: "Number of sizes",
  [PIECES]: "Number of pieces",
};
const ORDER = ["mass_step_kg", "masses_kg", "angle_step_deg", "max_part_numbers", "max_counterweights"];

// whether more than the group follows from whether it is there
export const shared = (at) => at === SIZES;

// how a field is called here
export const titled = (at, description) => (at in TITLES ? { ...description, title: TITLES[at] } : description);

// the fields of a group at a pointer: [[name, pointer, schema]], the pieces among the sizes where there are any
export function fieldsAt(pointer, properties, schema, chosen) {
  const own = Object.entries(properties).map(([name, node]) => [name, `${pointer}/${name}`, node]);
  if (pointer === SIZES) {
    const pieces = schema.known.ReciprocatingMachine.properties.max_counterweights;
    return [...own, ["max_counterweights", PIECES, pieces]].sort(([one], [other]) => ORDER.indexOf(one) - ORDER.indexOf(other));
  }
  return own.filter(([, at]) => at !== PIECES || !chosen);
}
