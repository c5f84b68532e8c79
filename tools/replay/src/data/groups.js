// Blocks that fail together when strength is reduced, by the search that kept this run.

/**
 * [{ factor, blocks (how many), share }], the first to fail first; `share` falls from 1 for these to a third for the
 * last.
 */
export function groupsOf(header) {
  const counts = new Map();
  for (const factor of header.failure?.factor ?? []) if (factor > 0) counts.set(factor, (counts.get(factor) ?? 0) + 1);
  const factors = [...counts.keys()].sort((a, b) => a - b), span = factors.at(-1) - factors[0];
  return factors.map((factor) => ({ factor, blocks: counts.get(factor), share: span > 0 ? 1 - (factor - factors[0]) / span / 1.5 : 1 }));
}

/** Heat of each block's colour: its group's share, 0 for those that the search has not found to fail. */
export function heatOfGroups(header) {
  const shares = new Map(groupsOf(header).map(({ factor, share }) => [factor, share]));
  return Float32Array.from(header.names, (_, b) => shares.get(header.failure?.factor[b]) ?? 0);
}
