/**
 * Fits src/tables/film.ts and prints it: `node scripts/film.mjs`, a second. Deterministic.
 *
 * What a film's waves add up to, as red, green and blue, depends on the visible spectrum only through the Fourier
 * transforms of the three sensitivities over wavenumbers, taken at the optical path. A sum of Lorentzian bands has
 * transforms of damped waves; the bands' middles and their common width are found by coordinate search, their weights
 * by linear least squares with each row's sum held at 1. Tried, on films of up to 3 µm over glass, nothing and metals,
 * largest error of the reflectance against the integral over the spectrum: three wavelengths 0.6, five bands 0.06, six
 * 0.04, eight 0.02. Bands of width 0 alias where the film is thick.
 */

/** CIE 1931 observer, the multi-lobe fits of Wyman, Sloan and Shirley 2013; nanometres. */
const lobe = (x, middle, left, right) => Math.exp(-0.5 * ((x - middle) / (x < middle ? left : right)) ** 2);
const observer = (l) => [
  1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) - 0.065 * lobe(l, 501.1, 20.4, 26.2),
  0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1),
  1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8),
];
const TO_SRGB = [
  [3.2404542, -1.5371385, -0.4985314],
  [-0.969266, 1.8760108, 0.041556],
  [0.0556434, -0.2040259, 1.0572252],
];

const PATHS = Array.from({ length: 201 }, (_, i) => 0.04 * i);
/** Short paths count most: there the amplitudes of many orders meet. */
const importance = PATHS.map((x) => (x === 0 ? 30 : 1 / (0.3 + 0.35 * x)));

/** Transforms of red, green and blue, 1 at path 0. */
const targets = [0, 1, 2].map((channel) => {
  let total = 0;
  const sums = PATHS.map(() => [0, 0]);
  for (let l = 380; l <= 780; l++) {
    const xyz = observer(l);
    const s = TO_SRGB[channel].reduce((sum, m, i) => sum + m * xyz[i], 0);
    total += s;
    PATHS.forEach((x, i) => {
      sums[i][0] += s * Math.cos((2000 * Math.PI * x) / l);
      sums[i][1] += s * Math.sin((2000 * Math.PI * x) / l);
    });
  }
  return sums.map(([re, im]) => [re / total, im / total]);
});

function solve(matrix, right) {
  const rows = matrix.map((row, i) => [...row, right[i]]);
  const n = rows.length;
  for (let i = 0; i < n; i++) {
    const pivot = rows
      .slice(i)
      .reduce((best, row, k) => (Math.abs(row[i]) > Math.abs(rows[best][i]) ? i + k : best), i);
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    for (let k = 0; k < n; k++) {
      if (k === i) continue;
      const factor = rows[k][i] / rows[i][i];
      for (let j = i; j <= n; j++) rows[k][j] -= factor * rows[i][j];
    }
  }
  return rows.map((row, i) => row[n] / row[i]);
}

function fit(wavenumbers, width) {
  const n = wavenumbers.length;
  const waves = wavenumbers.map((v) =>
    PATHS.map((x) => [
      Math.exp(-width * x) * Math.cos(2 * Math.PI * x * v),
      Math.exp(-width * x) * Math.sin(2 * Math.PI * x * v),
    ]),
  );
  let error = 0;
  const weights = targets.map((target) => {
    const matrix = Array.from({ length: n - 1 }, (_, i) =>
      Array.from({ length: n - 1 }, (__, j) => (i === j ? 1e-4 : 0)),
    );
    const right = new Array(n - 1).fill(0);
    PATHS.forEach((_, i) => {
      for (const part of [0, 1]) {
        const rest = target[i][part] - waves[n - 1][i][part];
        const change = waves.slice(0, n - 1).map((wave) => wave[i][part] - waves[n - 1][i][part]);
        change.forEach((a, row) => {
          right[row] += importance[i] * a * rest;
          change.forEach((b, column) => (matrix[row][column] += importance[i] * a * b));
        });
      }
    });
    const row = solve(matrix, right);
    row.push(1 - row.reduce((sum, w) => sum + w, 0));
    PATHS.forEach((_, i) => {
      for (const part of [0, 1])
        error +=
          importance[i] * (waves.reduce((sum, wave, k) => sum + row[k] * wave[i][part], 0) - target[i][part]) ** 2;
    });
    return row;
  });
  return { error, weights };
}

const COUNT = 8;
/**
 * The shader adds up phases in whole numbers, so that no digit is lost however thick the film: middles are of whole
 * steps.
 */
const STEPS = 256;
let wavenumbers = Array.from(
  { length: COUNT },
  (_, i) => Math.round((1.48 + (0.87 * i) / (COUNT - 1)) * STEPS) / STEPS,
);
let width = 0.3;
let best = fit(wavenumbers, width);
for (let step = 16; step > 1 / 32;) {
  let better = false;
  for (let k = step < 1 ? COUNT : 0; k <= COUNT; k++) {
    for (const move of [step / STEPS, -step / STEPS]) {
      const moved = wavenumbers.map((v, i) => (i === k ? v + move : v));
      const wider = k === COUNT ? Math.max(width + 2 * move, 0.005) : width;
      const tried = fit(moved, wider);
      if (tried.error < best.error - 1e-12) [best, wavenumbers, width, better] = [tried, moved, wider, true];
    }
  }
  if (!better) step /= 2;
}
/** Five digits, the last number such that they add up to 1. */
const row = (weights) => {
  const rounded = weights.slice(0, -1).map((w) => +w.toFixed(5));
  return [...rounded, +(1 - rounded.reduce((sum, w) => sum + w, 0)).toFixed(5)];
};
process.stdout.write(
  `${JSON.stringify({ wavenumbers, width: +width.toFixed(5), weights: best.weights.map(row), error: best.error })}\n`,
);
