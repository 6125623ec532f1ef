// The word that was meant.

function distance(one, other) {
  let row = Array.from({ length: other.length + 1 }, (_, index) => index);
  for (let i = 1; i <= one.length; i += 1) {
    const next = [i];
    for (let j = 1; j <= other.length; j += 1) {
      next[j] = Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (one[i - 1] === other[j - 1] ? 0 : 1));
    }
    row = next;
  }
  return row[other.length];
}

const bare = (word) => word.toLowerCase().replace(/[^a-z0-9]/g, "");

// the known word that is nearest, null where none is near; speed is near to speed_rpm, angle to crank angle
export function nearest(word, known) {
  const given = bare(word);
  if (!given) return null;
  const far = (other) => {
    const name = bare(other);
    if (name.startsWith(given) || given.startsWith(name)) return 0.5;
    return name.includes(given) ? 0.75 : distance(given, name);
  };
  const found = known.map((other) => [far(other), other]).sort((one, other) => one[0] - other[0])[0];
  return found && found[0] <= Math.max(1, given.length / 3) ? found[1] : null;
}
