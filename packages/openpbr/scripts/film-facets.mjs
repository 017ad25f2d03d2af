/**
 * Fits src/tables/film_facets.wesl and writes it: `node scripts/film-facets.mjs`, ten minutes. Deterministic.
 *
 * What a thin film changes of an interface's albedos is summed over facets (src/wgsl/thin_film/film_sums.wesl). Where
 * those facets are and what they count is found here by a random search, for films of up to 3 µm on random dielectrics,
 * against sums over 24 by 32 facets.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { gaussLegendre } from './microfacet.mjs';
import { random } from './random.mjs';

const FILMS = 6000;
const STEPS = 5000;

/** The bands of the spectrum that the shader has. */
const text = readFileSync(new URL('../src/tables/film_bands.wesl', import.meta.url), 'utf8');
const rowsOf = (name) =>
  [
    ...text
      .slice(text.indexOf(`const ${name} =`))
      .split(';', 1)[0]
      .matchAll(/vec4f\(([^)]*)\)/g),
  ].map((row) => row[1].split(',').map(Number));
const [BANDS] = rowsOf('OPENPBR_FILM_BANDS');
const WEIGHTS = rowsOf('OPENPBR_FILM_WEIGHTS');
const SINES = rowsOf('OPENPBR_FILM_SINES');
const WIDTH = Number(/OPENPBR_FILM_WIDTH = ([\d.]+)/.exec(text)[1]);

const length3 = (x, y, z) => Math.sqrt(x * x + y * y + z * z);

function fresnel(eta, c) {
  const square = (eta - 1) * (eta + 1) + c * c;
  if (square <= 0) return 1;
  const g = Math.sqrt(square);
  const a = ((eta - 1) * (eta + 1)) / Math.max(g + c, 1e-6) ** 2;
  const b = (c * (g + c) - 1) / (c * (g - c) + 1);
  return Math.min(0.5 * a * a * (1 + b * b), 1);
}

/** Airy's sum for a film on a dielectric, as filmReflectance of src/cpu/film.ts: red, green and blue. */
function reflectance({ index, base, path, inside }, c) {
  const tangential = (1 - c * c) * (inside ? base * base : Math.min(1, index * index));
  const [square2, square3] = [index * index, base * base];
  if (Math.min(1, square2, square3) <= tangential) return [1, 1, 1];
  const q1 = Math.sqrt(1 - tangential);
  const q2 = Math.sqrt(square2 - tangential);
  const q3 = Math.sqrt(square3 - tangential);
  const faces = [
    [(q1 - q2) / (q1 + q2), (q2 - q3) / (q2 + q3)],
    [(square2 * q1 - q2) / (square2 * q1 + q2), (square3 * q2 - square2 * q3) / (square3 * q2 + square2 * q3)],
  ];
  const coherence = Math.exp(-WIDTH * path * q2);
  const color = [0, 0, 0];
  for (let band = 0; band < 4; band++) {
    const phase = 2 * Math.PI * path * q2 * BANDS[band];
    const cos = Math.cos(phase);
    const sin = Math.sin(phase);
    let [now, later] = [0, 0];
    for (const [r12, r23] of faces) {
      const [a, b] = [r12 * r12, r23 * r23];
      const contrast = Math.max(1 - a * b, 1e-7);
      const fade = coherence * coherence * a * b;
      const turn = coherence * r12 * r23;
      const share = 0.5 / (contrast * (1 + fade + 2 * turn * cos));
      now += share * ((a + b) * (1 - fade) - 2 * a * b * (1 - coherence * coherence) + 2 * contrast * turn * cos);
      later += share * 2 * (1 - a) * (1 - b) * turn * sin;
    }
    for (let k = 0; k < 3; k++) color[k] += WEIGHTS[k][band] * now + SINES[k][band] * later;
  }
  return color.map((value) => Math.min(Math.max(value, 0), 1));
}

/** A film and a view: a quarter of them thick ones, half with an anisotropic highlight. */
function draw(next, i, inside) {
  const thickness = i % 4 === 3 ? 1 + 2 * next() : 0.05 + 0.95 * next();
  const base = 1.3 + 0.9 * next();
  const index = 1.15 + 1.4 * next();
  const flat = 1 - (i % 2 === 0 ? 0.95 * next() : 0);
  const along = next() ** 2 * Math.sqrt(2 / (1 + flat * flat));
  const alpha = [Math.max(along, 1e-4), Math.max(flat * along, 1e-4)];
  const mu = 0.05 + 0.95 * next();
  const azimuth = 2 * Math.PI * next();
  const sine = Math.sqrt(1 - mu * mu);
  const wo = [sine * Math.cos(azimuth), sine * Math.sin(azimuth), mu];
  const slope = [alpha[0] * wo[0], alpha[1] * wo[1]];
  const so = length3(...slope, mu);
  const flatness = length3(...slope, 0);
  const towards = flatness > 1e-10 ? slope.map((value) => value / flatness) : [1, 0];
  return { index, base, inside, path: 2 * thickness, alpha, wo, so, towards, view: [...slope, mu].map((v) => v / so) };
}

/** At a facet: how much of what it reflects is seen, what it reflects without the film, and red, green and blue with. */
function facet(film, [up, cos, sin]) {
  const { alpha, wo, so, towards, view, base, inside } = film;
  const z = up * (1 + view[2]) - view[2];
  const radius = Math.sqrt(Math.max(1 - z * z, 0));
  const x = alpha[0] * (radius * (cos * towards[0] - sin * towards[1]) + view[0]);
  const y = alpha[1] * (radius * (cos * towards[1] + sin * towards[0]) + view[1]);
  const size = length3(x, y, Math.max(z + view[2], 1e-7));
  const h = [x / size, y / size, Math.max(z + view[2], 1e-7) / size];
  const c = Math.min(Math.max(wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2], 0), 1);
  const wi = h.map((value, i) => 2 * c * value - wo[i]);
  const masked = wo[2] * length3(alpha[0] * wi[0], alpha[1] * wi[1], wi[2]) + wi[2] * so;
  const seen = wi[2] > 0 ? (wi[2] * (wo[2] + so)) / masked : 0;
  return [seen, fresnel(inside ? 1 / base : base, c), ...reflectance(film, c)];
}

/**
 * What `facets` [values of facet, weight] say: what the film adds to the reflection of mirrors, times `kept`, and what it
 * takes of the transmission. That is relative from outside; from inside, where it may be that nothing gets through, not.
 */
function change(facets, inside, kept) {
  const [more, taken] = [
    [0, 0, 0],
    [0, 0, 0],
  ];
  let [through, mirrored] = [0, 1e-20];
  for (const [at, offset, weight] of facets) {
    const seen = weight * at[offset];
    const clear = at[offset + 1];
    mirrored += seen;
    through += weight * (1 - clear);
    for (let k = 0; k < 3; k++) {
      const added = at[offset + 2 + k] - clear;
      more[k] += seen * added;
      taken[k] += weight * added;
    }
  }
  const scale = (kept ?? mirrored) / mirrored;
  return {
    more: more.map((value) => value * scale),
    taken: inside ? taken : taken.map((value) => value / Math.max(through, 1e-5)),
    mirrored,
  };
}

const { nodes, weights } = gaussLegendre(24);
const AROUND = 32;

/** Films with what 768 facets say of them. */
function sample(seed, inside) {
  const next = random(seed);
  return Array.from({ length: FILMS }, (_, i) => {
    const film = draw(next, i, inside);
    const facets = [...nodes].flatMap((node, ring) =>
      Array.from({ length: AROUND }, (_, k) => {
        const turn = (2 * Math.PI * (k + 0.5)) / AROUND;
        return [facet(film, [node, Math.cos(turn), Math.sin(turn)]), 0, weights[ring] / AROUND];
      }),
    );
    return { film, exact: change(facets, inside) };
  });
}

/** Values of facet for all films, five each. */
const column = (films, [up, angle]) => {
  const values = new Float64Array(5 * films.length);
  films.forEach(({ film }, i) => values.set(facet(film, [up, Math.cos(angle), Math.sin(angle)]), 5 * i));
  return values;
};

/** Largest error and root of the mean square, of reflection and transmission, and what the search lowers. */
function errors(films, columns, weights, inside) {
  const [max, squares] = [
    [0, 0],
    [0, 0],
  ];
  let twelfth = 0;
  films.forEach(({ exact }, i) => {
    const { more, taken } = change(
      columns.map((values, k) => [values, 5 * i, weights[k]]),
      inside,
      exact.mirrored,
    );
    for (let k = 0; k < 3; k++) {
      const pair = [more[k] - exact.more[k], taken[k] - exact.taken[k]];
      pair.forEach((error, j) => {
        max[j] = Math.max(max[j], Math.abs(error));
        squares[j] += error * error;
      });
      twelfth += (pair[0] / 0.011) ** 12 + (pair[1] / 0.0135) ** 12;
    }
  });
  const count = 3 * films.length;
  const mean = squares.map((value) => Math.sqrt(value / count));
  return { max, mean, rate: (twelfth / count) ** (1 / 12) + 400 * mean[0] + 250 * mean[1] };
}

/** Facets [up, angle, weight]. */
function search(count, inside, known, fresh, starts) {
  let best = { rate: Infinity };
  for (let start = 1; start <= starts; start++) {
    const next = random(start);
    const facets = Array.from({ length: count }, (_, i) => [(i + next()) / count, 2 * Math.PI * next()]);
    const columns = facets.map((node) => column(known, node));
    let weights = facets.map(() => 1 / count);
    let { rate } = errors(known, columns, weights, inside);
    let step = 0.3;
    let better = 0;
    for (let i = 1; i <= STEPS; i++) {
      const at = Math.floor(next() * count);
      const [node, kept] = [facets[at], columns[at]];
      const tried = [...weights];
      if (next() < 0.7) {
        facets[at] = [Math.min(Math.max(node[0] + step * (next() - 0.5), 0), 1), node[1] + 6 * step * (next() - 0.5)];
        columns[at] = column(known, facets[at]);
      }
      const other = Math.floor(next() * count);
      const moved = 0.3 * step * (next() - 0.5);
      if (next() < 0.7 && other !== at && Math.min(tried[at] + moved, tried[other] - moved) > 0.01) {
        tried[at] += moved;
        tried[other] -= moved;
      }
      const found = errors(known, columns, tried, inside);
      if (found.rate < rate) {
        [rate, weights] = [found.rate, tried];
        better++;
      } else [facets[at], columns[at]] = [node, kept];
      if (i % 150 > 0) continue;
      if (better < 10) step *= 0.75;
      better = 0;
    }
    if (rate < best.rate) best = { rate, facets: facets.map((node, k) => [...node, weights[k]]) };
  }
  const { max, mean } = errors(
    fresh,
    best.facets.map((node) => column(fresh, node)),
    best.facets.map((node) => node[2]),
    inside,
  );
  const figure = (k) => `${max[k].toFixed(4)} (${mean[k].toFixed(5)})`;
  process.stdout.write(`${count} facets: reflection ${figure(0)}, transmission ${figure(1)}\n`);
  return best.facets;
}

const fit = (count, inside, starts) => search(count, inside, sample(101, inside), sample(202, inside), starts);
const [outer, inner] = [fit(5, false, 6), fit(12, true, 2)];

/** Five digits; the last weight is such that they add up to 1. */
function rows(facets) {
  const rounded = facets.map(([up, angle, weight]) =>
    [up, Math.cos(angle), Math.sin(angle), weight].map((value) => +value.toFixed(5)),
  );
  const rest = rounded.slice(0, -1).reduce((sum, row) => sum - row[3], 1);
  rounded.at(-1)[3] = +rest.toFixed(5);
  return rounded.map((row) => `  vec4f(${row.join(', ')}),\n`).join('');
}
writeFileSync(
  new URL('../src/tables/film_facets.wesl', import.meta.url),
  `// Made by scripts/film-facets.mjs; do not edit.

// Facets that a thin film's changes of an interface's albedos are summed over: how far up the cap of visible normals,
// from 0 to 1, cosine and sine of the angle to the view's azimuth, and the weight. Those for views from outside come
// first, those from inside follow: where the first end, and the second.
const OPENPBR_FILM_FACET_ENDS = vec2u(${outer.length}, ${outer.length + inner.length});
const OPENPBR_FILM_FACETS = array<vec4f, ${outer.length + inner.length}>(
${rows(outer)}${rows(inner)});
`,
);
