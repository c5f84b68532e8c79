// Numbers as text.

export const typeset = (text) => text.replace(/^-/, "−");

/** A fixed number of decimals; a rounded zero has no sign. */
export function fixed(value, decimals, signed = false) {
  const rounded = value.toFixed(decimals);
  if (Number(rounded) === 0) return (0).toFixed(decimals);
  return (signed && value > 0 ? "+" : "") + typeset(rounded);
}

/** Four digits that count. */
export function figure(value) {
  if (value === 0) return "0.00";
  const decimals = Math.min(12, Math.max(0, 3 - Math.floor(Math.log10(Math.abs(value)))));
  return fixed(value, decimals);
}

/** A tick or a tip: the shortest text. */
export const short = (value) => typeset(String(Number(value.toPrecision(6))));

export function percent(share) {
  return `${(100 * share).toFixed(share > 0 && share < 0.1 ? 2 : 1)} %`;
}
