// A scroll machine from the answers to a few questions. Nothing in it comes from an example.

/**
 * The request; what it lacks is noted in the answers.
 * @param {import("./answers.js").Answers} answers @param {string} device crank_pins or oldham
 */
export function scroll(answers, device) {
  const plane = answers.number("plane", "m");
  const torque = answers.number("torque", "N m", { needed: false });
  const own = answers.number("devicePlane", "m", { needed: false });
  if (!device) answers.wrong.add("device");
  const guides = {
    crank_pins: () => {
      const eccentric = answers.number("eccentric", "kg", { needed: false });
      return { type: device, count: answers.number("pins", ""), pin_circle_radius_m: answers.number("circle", "m"),
        ...(eccentric === null ? {} : { eccentric_mass_kg: eccentric }), position_m: own ?? plane };
    },
    oldham: () => ({ type: device, mass_kg: answers.number("ring", "kg"), axis_deg: answers.number("axis", "deg"), position_m: own ?? plane }),
  };
  const planes = answers.list("planes", "m");
  const webs = planes.map((position_m, index) => ({ name: String(index + 1), position_m,
    counterweight_radius_m: answers.number("scrollRadius", "m"), max_mass_kg: answers.number("scrollMost", "kg", { needed: false }) }));
  return { machine: {
    kind: "scroll", speed_rpm: answers.number("scrollSpeed", "rpm"), orbit_radius_m: answers.number("orbit", "m"), orbiting_mass_kg: answers.number("orbiting", "kg"),
    orbiting_position_m: plane, ...(device ? { anti_rotation: guides[device]() } : {}), ...(device === "crank_pins" && torque !== null ? { rotation_torque_Nm: torque } : {}), webs,
  } };
}
