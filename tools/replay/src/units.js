// Numbers with units: a prefix that keeps them between 1 and 1000, four significant digits.

const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

const digits = (value, count) => {
  const text = value.toPrecision(count);
  return text.includes("e") ? String(Number(text)) : text;
};

/** 0.00123 m -> "1.230 mm". `smallest` is what counts as zero. */
export function quantity(value, unit, count = 4, smallest = 1e-12) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return (value < 0 ? "−∞ " : "∞ ") + unit;
  const size = Math.abs(value);
  if (size < smallest) return `0 ${unit}`;
  const [factor, prefix] = prefixes.find(([least]) => size >= least * 0.9999) ?? prefixes.at(-1);
  return `${digits(value / factor, count)} ${prefix}${unit}`.replace("-", "−");
}

/** Areas have no handy prefixes: m² or cm². */
export const area = (value) =>
  Math.abs(value) >= 0.1 || value === 0 ? `${digits(value, 4)} m²` : `${digits(value * 1e4, 4)} cm²`;
export const degrees = (radians) => (radians * 180) / Math.PI;
export const angle = (radians, count = 3) =>
  Math.abs(degrees(radians)) < 5e-7 ? "0°" : `${digits(degrees(radians), count)}°`.replace("-", "−");
export const percent = (share) => `${(share * 100).toFixed(share < 0.1 && share > 0 ? 1 : 0)} %`;
export const ratio = (value) =>
  (value === 0 ? "0" : Math.abs(value) < 1e-3 ? value.toExponential(1) : digits(value, 3)).replace("-", "−");

/** Axis ticks: about `count` round values over [low, high]. */
export function ticks(low, high, count) {
  const rough = (high - low) / Math.max(1, count);
  if (!(rough > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((size) => size >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) found.push(k * step);
  return found;
}

/** The largest of 1, 2, 5 times a power of ten that is not above `value`. */
export function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].map((k) => k * power).find((size) => size <= value * 1.0001) ?? power;
}
