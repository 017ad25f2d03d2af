/**
 * Fits src/tables/anisotropic_facets.wesl and writes it: `node scripts/anisotropic.mjs`, seven minutes. Deterministic.
 *
 * The energies of an anisotropic dielectric from outside are sums over facets (src/wgsl/anisotropic.wesl). Where those
 * facets are and what they count is found here, on random interfaces, against sums over 987 facets: weights by linear
 * least squares with their sum held at 1, places by a random search. 3,000 interfaces are for the search, others for the
 * errors that it prints. Facets in steps of the golden ratio are 1.3 times as many for twice the error. Mild anisotropy
 * has facets of its own, since a third of them has the same error there.
 */
import { writeFileSync } from 'node:fs';
import { random } from './random.mjs';

/** The ratio of slopes from which anisotropy is mild: below 0.31 of specular_roughness_anisotropy. */
const MILD = 0.69;
const STEPS = 16_000;

/** An interface and a view, many nearly across the long slopes, where energies change fast; mild ones only, or any. */
function draw(next, mild) {
  const kind = next();
  const eta = kind < 0.8 ? 1.05 + 1.45 * next() : kind < 0.9 ? 1.001 + 0.05 * next() : 1.05 + 2.2 * next();
  // A third of them where sums are hardest: rough, very anisotropic, and seen from low across the long slopes.
  const hard = next() < 0.3;
  const roughness = 0.03 + 0.97 * next() ** (hard ? 0.4 : 1);
  const flat = mild
    ? MILD + (1 - MILD) * next()
    : 1 - (hard ? 0.8 + 0.19 * next() : next() < 0.85 ? 0.1 + 0.89 * next() : next());
  const along = roughness * roughness * Math.sqrt(2 / (1 + flat * flat));
  const mu = hard ? 0.005 + 0.2 * next() ** 2 : next() < 0.5 ? 0.02 + 0.98 * next() : 0.003 + 0.997 * next() ** 2;
  const phi =
    !hard && next() < 0.5
      ? 2 * Math.PI * next()
      : (next() < 0.5 ? 0.5 : -0.5) * Math.PI + (next() < 0.5 ? 0.4 : -0.4) * next() ** (hard ? 4 : 2);
  const sine = Math.sqrt(1 - mu * mu);
  const wo = [sine * Math.cos(phi), sine * Math.sin(phi), mu];
  return frame(eta, [Math.max(along, 1e-4), Math.max(flat * along, 1e-4)], wo);
}

const length2 = (x, y) => Math.sqrt(x * x + y * y);
const length3 = (x, y, z) => Math.sqrt(x * x + y * y + z * z);

/** What the sums share: see openpbr_anisotropic. */
function frame(eta, alpha, wo) {
  const flat = length2(alpha[0] * wo[0], alpha[1] * wo[1]);
  const towards = flat > 1e-10 ? [(alpha[0] * wo[0]) / flat, (alpha[1] * wo[1]) / flat] : [1, 0];
  const so = length2(flat, wo[2]);
  const view = [flat / so, wo[2] / so];
  const p = [alpha[0] * towards[0], alpha[1] * towards[1]];
  const q = [-alpha[0] * towards[1], alpha[1] * towards[0]];
  const over = 1 / (q[0] * q[0] + q[1] * q[1]);
  const min = (alpha[0] * alpha[1]) ** 2 * over;
  const lean = (2 * flat) / wo[2];
  const root = 0.5 * lean + Math.sqrt(0.25 * lean * lean + min);
  const range = [-1 / root, root / min].map((end) => (end * view[1] - view[0]) / length2(end, 1));
  return { eta, alpha, wo, so, view, p, q, over, min, lean, range, skew: (p[0] * q[0] + p[1] * q[1]) * over };
}

function fresnel(eta, c) {
  const g = Math.sqrt((eta - 1) * (eta + 1) + c * c);
  const a = ((eta - 1) * (eta + 1)) / Math.max(g + c, 1e-4) ** 2;
  const b = (c * (g + c) - 1) / (c * (g - c) + 1);
  return Math.min(0.5 * a * a * (1 + b * b), 1);
}

const angle = ({ view }, s) => {
  const rest = Math.sqrt(Math.max(1 - s * s, 0));
  return [s * view[1] + rest * view[0], Math.max(rest * view[1] - s * view[0], 0)];
};

/** A facet, and its cosine to the view. */
function facet({ p, q, wo }, [x, z], out) {
  const along = Math.sqrt(Math.max(1 - out * out, 0));
  const h = [along * x * p[0] + out * q[0], along * x * p[1] + out * q[1], along * z];
  const size = length3(h[0], h[1], h[2]);
  const c = (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]) / size;
  return { along, h: h.map((value) => value / size), c: Math.min(Math.max(c, 0), 1) };
}

/** What a facet lets through, of those that are seen. */
function through(surface, [place, out]) {
  const { eta, alpha, wo, view } = surface;
  const { h, c } = facet(surface, angle(surface, (1 + view[1]) * place - 1), out);
  const bend = c - Math.sqrt((eta - 1) * (eta + 1) + c * c);
  const [x, y, z] = h.map((value, i) => bend * value - wo[i]);
  const down = Math.max(-z, 0);
  return ((1 - fresnel(eta, c)) * 2 * down) / (down + length3(alpha[0] * x, alpha[1] * y, z));
}

/** How much a facet mirrors upwards, of those that do, and its reflectance. */
function mirrored(surface, [place, out]) {
  const { eta, alpha, wo, so, range, lean, min, over, skew } = surface;
  const [x, z] = angle(surface, range[0] + (range[1] - range[0]) * place);
  const width = Math.sqrt(Math.max(z * (lean * x + z) - min * x * x, 0) * over);
  const [left, right] = [-width - skew * x, width - skew * x].map((tangent) => tangent / length2(tangent, 1));
  const { along, h, c } = facet(surface, [x, z], left + (right - left) * out);
  const wi = h.map((value, i) => 2 * c * value - wo[i]);
  if (wi[2] <= 0) return [0, 0];
  const shadow = wo[2] * length3(alpha[0] * wi[0], alpha[1] * wi[1], wi[2]) + wi[2] * so;
  return [((right - left) * along * wi[2]) / shadow, fresnel(eta, c)];
}

const smooth = (u) => u * u * (3 - 2 * u);
const lattice = (count) =>
  Array.from({ length: count }, (_, i) => [(i + 0.5) / count, (i * 0.6180339887498949 + 0.25) % 1]);

/** With the energies of 987 facets. */
function exactly(surface) {
  let [sum, all, reflected, mirrors] = [0, 0, 0, 0];
  for (const [u, v] of lattice(987)) {
    const out = 2 * smooth(v) - 1;
    const weight = u * (1 - u) * v * (1 - v);
    const seen = weight * Math.sqrt(1 - out * out);
    sum += seen * through(surface, [smooth(u), out]);
    all += seen;
    const [mirror, reflectance] = mirrored(surface, [smooth(u), smooth(v)]);
    reflected += weight * mirror * reflectance;
    mirrors += weight * mirror;
  }
  return { surface, through: sum / all, reflectance: reflected / mirrors, mirrors: (36 * mirrors) / 987 };
}

const sample = (seed, mild) => {
  const next = random(seed);
  return Array.from({ length: 3000 }, () => exactly(draw(next, mild)));
};

/** Weights that add up to 1, by least squares of the errors in `columns`, one for each facet. */
function weigh(columns) {
  const n = columns.length;
  const count = columns[0].length;
  const rows = Array.from({ length: n + 1 }, () => new Float64Array(n + 2));
  for (let i = 0; i < n; i++) {
    for (let j = i; j < n; j++) {
      let sum = 0;
      for (let k = 0; k < count; k++) sum += columns[i][k] * columns[j][k];
      rows[i][j] = rows[j][i] = sum / count;
    }
    rows[i][i] += 1e-5;
    rows[i][n + 1] = 1e-5 / n;
    rows[i][n] = rows[n][i] = 1;
  }
  rows[n][n + 1] = 1;
  for (let i = 0; i <= n; i++) {
    let pivot = i;
    for (let k = i + 1; k <= n; k++) if (Math.abs(rows[k][i]) > Math.abs(rows[pivot][i])) pivot = k;
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    for (let k = i + 1; k <= n; k++) {
      const factor = rows[k][i] / rows[i][i];
      for (let j = i; j <= n + 1; j++) rows[k][j] -= factor * rows[i][j];
    }
  }
  const result = new Float64Array(n + 1);
  for (let i = n; i >= 0; i--) {
    let sum = rows[i][n + 1];
    for (let j = i + 1; j <= n; j++) sum -= rows[i][j] * result[j];
    result[i] = sum / rows[i][i];
  }
  return Array.from(result.slice(0, n));
}

/** Largest error, root of the mean square, and root of the mean sixth power. */
function errors(columns, weights) {
  let [max, squares, sixth] = [0, 0, 0];
  const count = columns[0].length;
  for (let k = 0; k < count; k++) {
    let error = 0;
    for (let i = 0; i < weights.length; i++) error += weights[i] * columns[i][k];
    max = Math.max(max, Math.abs(error));
    squares += error * error;
    sixth += error ** 6;
  }
  return { max, mean: Math.sqrt(squares / count), sixth: (sixth / count) ** (1 / 6) };
}

const columnOf = (error, surfaces, node) => Float64Array.from(surfaces, (surface) => error(surface, node));

function searchFrom(seed, count, low, error, known) {
  const next = random(seed);
  const nodes = lattice(count).map(([u, v]) => [smooth(u), low + (1 - low) * smooth(v)]);
  const columns = nodes.map((node) => columnOf(error, known, node));
  let weights = weigh(columns);
  const rate = (of) => {
    const { mean, sixth } = errors(columns, of);
    return sixth + 0.5 * mean;
  };
  let best = rate(weights);
  const inside = (value, min) => Math.min(Math.max(value, min + 5e-4), 0.9995);
  let step = 0.15;
  let better = 0;
  for (let i = 1; i <= STEPS; i++) {
    const at = Math.floor(next() * count);
    const [node, kept] = [nodes[at], columns[at]];
    const reach = step * (next() < 0.3 ? 3 : 1);
    nodes[at] = [
      inside(node[0] + reach * (next() - 0.5), 0),
      inside(node[1] + (1 - low) * reach * (next() - 0.5), low),
    ];
    columns[at] = columnOf(error, known, nodes[at]);
    const tried = weigh(columns);
    const rated = rate(tried);
    if (rated < best && Math.min(...tried) > 0) {
      [best, weights] = [rated, tried];
      better++;
    } else [nodes[at], columns[at]] = [node, kept];
    if (i % 300 > 0) continue;
    if (better < 20) step *= 0.6;
    better = 0;
  }
  return { best, nodes, weights };
}

/** Facets [place, out, weight]; `error` is that of one facet for one surface, `low` the least "out". Best of `seeds`. */
function search(count, low, error, known, fresh, seeds) {
  let found = { best: Infinity };
  for (const seed of seeds) {
    const tried = searchFrom(seed, count, low, error, known);
    if (tried.best < found.best) found = tried;
  }
  // Three digits of the places, which shaders have as text; the weights are those for them.
  const nodes = found.nodes.map(([place, out]) =>
    [Math.max(place, 0.001), Math.max(out, low + 0.001)].map((value) => +Math.min(value, 0.999).toFixed(3)),
  );
  const weights = weigh(nodes.map((node) => columnOf(error, known, node)));
  const { max, mean } = errors(
    nodes.map((node) => columnOf(error, fresh, node)),
    weights,
  );
  process.stdout.write(`${count} facets: largest error ${max.toFixed(5)}, root mean square ${mean.toFixed(5)}\n`);
  return nodes.map((node, i) => [...node, weights[i]]);
}

function fit(mild, mirrors, facets, seeds) {
  const [known, fresh] = [sample(101, mild), sample(202, mild)];
  return [
    search(
      mirrors,
      0,
      ({ surface, reflectance, mirrors: all }, node) => {
        const [mirror, own] = mirrored(surface, node);
        return (mirror * (own - reflectance)) / all;
      },
      known,
      fresh,
      seeds[0],
    ),
    search(
      facets,
      -1,
      ({ surface, through: exact }, node) => through(surface, node) - exact,
      known,
      fresh,
      seeds[1],
    ).map(([place, out, weight]) => [place, +(out / Math.sqrt(1 - out * out)).toPrecision(4), weight]),
  ];
}

const [any, mild] = [
  fit(false, 16, 26, [[2], [1]]),
  fit(true, 6, 7, [
    [1, 2, 3, 4],
    [1, 2, 3, 4],
  ]),
];

/** The last weight is such that they add up to 1. */
function rows(list) {
  const rounded = list.map((row) => row.map((value) => +value.toFixed(4)));
  const rest = rounded.slice(0, -1).reduce((sum, row) => sum - row.at(-1), 1);
  rounded.at(-1).splice(-1, 1, +rest.toFixed(4));
  return rounded.map((row) => `  vec${row.length}f(${row.join(', ')}),\n`).join('');
}
const table = (which) =>
  `array<vec3f, ${any[which].length + mild[which].length}>(\n${rows(any[which])}${rows(mild[which])})`;
const ends = [any[0].length, any[0].length + mild[0].length, any[1].length, any[1].length + mild[1].length];
writeFileSync(
  new URL('../src/tables/anisotropic_facets.wesl', import.meta.url),
  `// Made by scripts/anisotropic.mjs; do not edit.

// Facets that an anisotropic dielectric's energies from outside are summed over: where they are along the view and
// across it, and the weight.

// The ratio of slopes from which anisotropy is mild. Facets for any anisotropy come first, those for mild ones follow:
// where the first end, and the second, of either table.
const OPENPBR_ANISOTROPIC_MILD = ${MILD};
const OPENPBR_ANISOTROPIC_ENDS = vec4u(${ends.join(', ')});
// Of those that mirror upwards: places within their bounds, from 0 to 1.
const OPENPBR_ANISOTROPIC_MIRRORS = ${table(0)};
// Of all: the place across is tan χ.
const OPENPBR_ANISOTROPIC_FACETS = ${table(1)};
`,
);
