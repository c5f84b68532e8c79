// Settings in the address, so that a report can link to a moment: page.html#t=0.2&colour=role&joints&select=c1r1s1.

export function readAddress(replay, hash) {
  const asked = new URLSearchParams(hash.slice(1));
  const { look, player } = replay;
  const colour = asked.get("colour");
  if (replay.map) {
    if (replay.map.quantities[colour]) look.colouring = colour;
  } else if (["displacement", "velocity", "rotation", "role", "factor"].includes(colour) && (colour !== "factor" || replay.groups.length > 0)) look.colouring = colour;
  for (const layer of ["water", "forces", "joints", "edges", "fixed", "paths"])
    if (asked.has(layer)) look[layer] = !["0", "no"].includes(asked.get(layer));
  if (asked.get("joints") === "pressure") look.jointColouring = "pressure";
  const times = Number(asked.get("exaggerate"));
  if (times >= 1) look.exaggeration = Math.min(times, 1e4);
  const [axis, share] = (asked.get("section") ?? "").split(":"); // section=y:0.5
  if (["x", "y", "z"].includes(axis)) Object.assign(look.section, { axis, share: Math.min(1, Math.max(0, Number(share ?? 0.5))) || 0 });
  if (asked.get("t") === "end") player.seek(player.last);
  else if (asked.has("t") && Number.isFinite(Number(asked.get("t")))) player.seek(Number(asked.get("t")));
  const view = ["iso", "front", "toe", "top"].includes(asked.get("view")) ? asked.get("view") : replay.view;
  if (asked.has("t") || view !== replay.view) replay.home(view, asked.has("t") ? player.between().a : null);
  if (replay.header.names.includes(asked.get("select"))) replay.select(asked.get("select"));
  if (asked.has("play")) player.play();
}
