// Numbers for people.

const PREFIXES = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
];
const PREFIXED = /^(m|Pa|N|J|W|s|m\/s|N m|N s|kg m\/s)$/;

/** How values up to `most` are written: a factor, a unit and a number of decimals. */
export function scaleFor(most, units) {
  const bare = units === "1" ? "" : units;
  let factor = 1;
  let prefix = "";
  if (most > 0 && PREFIXED.test(bare) && !bare.startsWith("kg"))
    [factor, prefix] = PREFIXES.find(([size, letter]) => most >= 0.999 * size && !(letter === "k" && bare.startsWith("m"))) ?? PREFIXES.at(-1);
  const written = most / factor;
  const decimals = written > 0 && written < 1e5 ? Math.max(0, 2 - Math.floor(Math.log10(written))) : 0;
  return { factor, units: prefix + bare, decimals: Math.min(decimals, 8) };
}

export function numberText(value, scale, decimals = scale.decimals) {
  const text = (value / scale.factor).toFixed(decimals);
  return text.replace("-", "−");
}

export function valueText(value, scale) {
  return `${numberText(value, scale)} ${scale.units}`.trim();
}

/** How many decimals multiples of a round step have. */
export function decimalsOf(step) {
  let decimals = 0;
  while (decimals < 9 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) decimals++;
  return decimals;
}

/** Round steps that divide a range into about `count` parts. */
export function roundStep(range, count) {
  if (!(range > 0)) return 1;
  const rough = range / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const digit = [1, 2, 2.5, 5, 10].find((d) => d * power >= rough * 0.999);
  return digit * power;
}
