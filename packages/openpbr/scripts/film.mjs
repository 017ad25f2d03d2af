/**
 * Fits src/tables/film.ts and prints it: `node scripts/film.mjs`, a second. Deterministic.
 *
 * What a film's waves add up to, as red, green and blue, depends on the visible spectrum only through the Fourier
 * transforms of the three sensitivities over wavenumbers, taken at the optical path. A sum of Lorentzian bands has
 * transforms of damped waves; with complex weights, of damped waves of any phase. The bands' middles and their common
 * width are found by coordinate search, their weights by linear least squares with each row's sum held at 1. Tried, on
 * films of up to 3 µm over glass, nothing and metals, largest error of the reflectance against the integral over the
 * spectrum (root mean square): three wavelengths 0.6; with real weights five bands 0.024 (0.0066), six 0.023 (0.0042),
 * eight 0.016 (0.0029); with complex ones four 0.0135 (0.0021), four at equal steps 0.018 (0.0028), four of different
 * widths 0.0048 (0.0013), five 0.0039 (0.0007). Bands of width 0 alias where the film is thick.
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

/** Waves of the bands, and the same a quarter of a turn later, for the imaginary parts of the weights. */
function fit(wavenumbers, width) {
  const n = wavenumbers.length;
  const waves = [1, 0].flatMap((real) =>
    wavenumbers.map((v) =>
      PATHS.map((x) => {
        const amplitude = Math.exp(-width * x);
        const [re, im] = [amplitude * Math.cos(2 * Math.PI * x * v), amplitude * Math.sin(2 * Math.PI * x * v)];
        return real ? [re, im] : [-im, re];
      }),
    ),
  );
  // The last band's weights are what the others leave: real parts add up to 1, imaginary ones to 0.
  const free = waves.map((_, i) => i).filter((i) => i % n !== n - 1);
  const changes = free.map((i) => {
    const last = waves[i < n ? n - 1 : 2 * n - 1];
    return waves[i].map(([re, im], k) => [re - last[k][0], im - last[k][1]]);
  });
  let error = 0;
  const weights = targets.map((target) => {
    const matrix = free.map((_, row) => free.map((__, column) => (row === column ? 1e-4 : 0)));
    const right = free.map(() => 0);
    PATHS.forEach((_, i) => {
      for (const part of [0, 1]) {
        const rest = target[i][part] - waves[n - 1][i][part];
        changes.forEach((a, row) => {
          right[row] += importance[i] * a[i][part] * rest;
          changes.forEach((c, column) => (matrix[row][column] += importance[i] * a[i][part] * c[i][part]));
        });
      }
    });
    const found = solve(matrix, right);
    const [real, imaginary] = [found.slice(0, n - 1), found.slice(n - 1)];
    real.push(1 - real.reduce((sum, w) => sum + w, 0));
    imaginary.push(-imaginary.reduce((sum, w) => sum + w, 0));
    const row = [...real, ...imaginary];
    PATHS.forEach((_, i) => {
      for (const part of [0, 1])
        error +=
          importance[i] * (waves.reduce((sum, wave, k) => sum + row[k] * wave[i][part], 0) - target[i][part]) ** 2;
    });
    return { real, imaginary };
  });
  return { error, weights };
}

const COUNT = 4;
let wavenumbers = Array.from({ length: COUNT }, (_, i) => 1.48 + (0.87 * i) / (COUNT - 1));
let width = 0.5;
let best = fit(wavenumbers, width);
for (let step = 1 / 16; step > 1e-4;) {
  let better = false;
  for (let k = 0; k <= COUNT; k++) {
    for (const move of [step, -step]) {
      const moved = wavenumbers.map((v, i) => (i === k ? v + move : v));
      const wider = k === COUNT ? Math.max(width + 2 * move, 0.005) : width;
      const tried = fit(moved, wider);
      if (tried.error < best.error - 1e-12) [best, wavenumbers, width, better] = [tried, moved, wider, true];
    }
  }
  if (!better) step /= 2;
}
const digits = (x) => +x.toFixed(4);
best = fit(wavenumbers.map(digits), digits(width));
/** Five digits, the last number such that they add up to `total`. */
const row = (weights, total) => {
  const rounded = weights.slice(0, -1).map((w) => +w.toFixed(5));
  return [...rounded, +(total - rounded.reduce((sum, w) => sum + w, 0)).toFixed(5)];
};
process.stdout.write(
  `${JSON.stringify({
    wavenumbers: wavenumbers.map(digits),
    width: digits(width),
    weights: best.weights.map(({ real }) => row(real, 1)),
    // By the sine: what the wave has a quarter of a turn later.
    sines: best.weights.map(({ imaginary }) =>
      row(
        imaginary.map((w) => -w),
        0,
      ),
    ),
    error: best.error,
  })}\n`,
);
