// Blocks that go together when strength is reduced, as the search found them that kept this run.

/** [{ factor, blocks (how many), share }], the first to go first; `share` is 1 for those and falls to a third for the last. */
export function groupsOf(header) {
  const counts = new Map();
  for (const factor of header.failure?.factor ?? []) if (factor > 0) counts.set(factor, (counts.get(factor) ?? 0) + 1);
  const factors = [...counts.keys()].sort((a, b) => a - b), span = factors.at(-1) - factors[0];
  return factors.map((factor) => ({ factor, blocks: counts.get(factor), share: span > 0 ? 1 - (factor - factors[0]) / span / 1.5 : 1 }));
}

/** How hot each block is drawn: its group's share, 0 for those that stand as far as the search went. */
export function heatOfGroups(header) {
  const shares = new Map(groupsOf(header).map(({ factor, share }) => [factor, share]));
  return Float32Array.from(header.names, (_, b) => shares.get(header.failure?.factor[b]) ?? 0);
}
