// What an answer puts on all shafts of a machine, those of balance shafts behind that of the crankshaft.

export const carried = ({ counterweights, balance_shafts: shafts }) => [...counterweights, ...(shafts ?? []).flatMap((shaft) => shaft.counterweights)];

// null where there is none to show
export const wholeMass = ({ total_mass_kg: own, balance_shafts_mass_kg: beside }) => (own === null ? null : own + (beside ?? 0));
