/**
 * Computes the energy tables of @glanz/openpbr and writes src/tables/grid.wesl and encoded.ts: `node scripts/tables.mjs`,
 * about a minute. Deterministic. With `--check` it writes nothing and fails if the file would change.
 *
 * Coordinates, shared with src/cpu/energy.ts and src/wgsl/energy.wesl. Tried and measured against the quadrature at
 * points off the grid (largest error over indices 1.15 to 1.8, roughness 0.01 to 1, cosines 0.001 to 1):
 * - roughness × √cosine, 32 × 32: 1.7 % for the conductor. The dip of masking sits at cosine ≈ α and moves across the
 *   grid. With t = √cosine·(1 + r)/(√cosine + r) it stays in place: 0.15 %.
 * - E of a dielectric itself, 16 × 16 × 16: 0.17 absolute. As the ratio to the Fresnel reflectance at the softened
 *   cosine μ + 0.8 r² (1 − μ), over √ε and √roughness: 0.0014, and exact for a smooth surface.
 * - Energy that single scattering keeps, 24 roughnesses by their root × 17 angles: misses by up to 0.021 seen from
 *   inside, 0.017 from outside near index 1. Linear in the roughness, which needs fewer, 18 × 23 with the angles along
 *   the other axis; from inside at the mean of the coordinate above and that of the critical angle; from outside over
 *   ε^(1/3): 0.008 and 0.0035 at worst; with the nodes centred (see `centred`) 0.0065 and 0.0035, there of rough
 *   surfaces near the normal. From outside with columns that crowd there, 1 - (1 - t)^0.6: 0.0008 at indices 1.2 and 2;
 *   with the power 0.75 0.0027.
 * - From inside, the critical angle has a column of its own, and columns crowd around it: 0.035 at worst, 0.01 mostly.
 *   What is tabulated there is the reflected part of single scattering, which has no dip of masking; bounces are added.
 * - Anisotropic mirrors, over roughness, anisotropy, cosine and azimuth. The round mirror of the same masking is within
 *   0.067; the rest is smooth, and tabulated. At 2500 places with anisotropies to 0.99: 8 roughnesses × 4 anisotropies
 *   × 6 slopes along the view × 17 angles leave 0.009 at worst, 0.0008 in the mean square. Over one by the slope
 *   instead, which few nodes do for: 0.005 and 0.0006. With angles that crowd towards the normal too, where a view
 *   across the long slopes changes fast at hardly any masking, 12 × 6 × 4 × 17: 0.0026 and 0.00035 (0.003 and 0.0005
 *   with the nodes not centred). Twice the nodes along any axis better it by no more than a tenth. Over the azimuth or
 *   its cosine's square instead of the slope 0.013 and 0.025 with 5 × 5 × 5 × 17, 0.012 over the slope. With the
 *   roughness made to fit instead (no table): 0.07.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { fresnelDielectric, gaussLegendre, interfaceAlbedo } from './microfacet.mjs';
import { sheen } from './sheen.mjs';

const MIN_ROUGHNESS = 0.01;
const LAYOUT = {
  angles: 17,
  roughnesses: 24,
  outer: 20,
  outerTotal: 18,
  inner: 12,
  innerTotal: 20,
  anisotropic: 12,
  conductor: 40,
  sheen: 24,
};
const STEP = 2048;
/** Anisotropies of anisotropic mirrors: 1/6, 2/6, … 1. */
const ANISOTROPIC_FLATS = 6;
/** The conductor's losses are tiny where it is smooth. */
const FINE_STEP = 65536;

const albedo = interfaceAlbedo(160, 128);
const MIN_ROOT = Math.sqrt(MIN_ROUGHNESS);
/** √roughness is linear along the rows. */
const roughness = (j, count) => (MIN_ROOT + ((1 - MIN_ROOT) * j) / (count - 1)) ** 2;
const etaOf = (epsilon) => (1 + epsilon) / (1 - epsilon);
/** √|ε| is linear along the slices; the ends are limits that no formula reaches. */
const epsilonOf = (k, count) => Math.min(0.999, Math.max(1e-3, (k / (count - 1)) ** 2));
/** The same over ε^(1/3), for what changes most near index 1. */
const cubicEpsilonOf = (k, count) => Math.min(0.999, Math.max(1e-3, (k / (count - 1)) ** 3));
/** Cosine at angle coordinate t, for roughness r. */
const cosineOf = (t, r) => Math.max(1e-9, ((t * r) / (1 + r - t)) ** 2);
const softened = (mu, r) => mu + 0.8 * r * r * (1 - mu);
/** Cosine at angle coordinate t inside of the denser medium: the critical angle sits at t = 1/2. */
function innerCosineOf(t, eta) {
  const critical = Math.sqrt(Math.max(0, 1 - eta * eta));
  const below = (2 * t) ** 2;
  return t <= 0.5
    ? Math.max(1e-6, (critical * below) / (below + (1 - 2 * t) ** 2))
    : critical + (1 - critical) * (2 * t - 1) ** 2;
}
const innerPosition = (mu, critical) =>
  mu <= critical
    ? (0.5 * Math.sqrt(mu)) / (Math.sqrt(mu) + Math.sqrt(critical - mu))
    : 0.5 + 0.5 * Math.sqrt((mu - critical) / (1 - critical));
/** Cosine-weighted mean of the Fresnel transmittance, about; from inside it follows from reciprocity. */
function meanThrough(epsilon) {
  const e = Math.abs(epsilon);
  return (1 - (2 * e) / (5.0864 - 3.085 * e)) * (epsilon > 0 ? 1 : etaOf(epsilon) ** 2);
}
/**
 * What lies below a reflection gets the rest of the light over its mean, and what metal loses comes back over the mean
 * loss. Shares and means are tabulated a little high, by as much as interpolation can miss, so that no surface gives
 * back more than it gets; but for the mean from inside, which misses by as little to either side as its sums do.
 */
const MARGIN = { lost: (r) => 1.001 + 0.02 * (1 - r), share: 1.0015, outer: 1.0015 };

const { nodes, weights } = gaussLegendre(256);
/** 2 ∫ E(μ) μ dμ. */
const average = (energy) => nodes.reduce((sum, x, i) => sum + weights[i] * 4 * x ** 3 * energy(x * x), 0);
const interpolate = (row, t) => {
  const at = Math.min(Math.max(t, 0), 1) * (row.length - 1);
  const i = Math.min(Math.floor(at), row.length - 2);
  return row[i] + (row[i + 1] - row[i]) * (at - i);
};

/** Energy that single scattering keeps. */
function kept(epsilon, r, mu) {
  const { reflect, transmit } = albedo([r * r, r * r], etaOf(epsilon), mu);
  return reflect + transmit;
}
/**
 * Where the totals of a cosine lie: columns crowd towards the normal; from inside, half of them around the critical
 * angle.
 */
function totalPosition(epsilon, mu, r) {
  const t = Math.min((Math.sqrt(mu) * (1 + r)) / (Math.sqrt(mu) + r), 1);
  return epsilon > 0 ? 1 - (1 - t) ** 0.6 : 0.5 * (t + innerPosition(mu, Math.sqrt(1 - etaOf(epsilon) ** 2)));
}
function totalCosineOf(epsilon, t, r) {
  let [low, high] = [0, 1];
  for (let i = 0; i < 60; i++) {
    const middle = (low + high) / 2;
    if (totalPosition(epsilon, middle, r) < t) low = middle;
    else high = middle;
  }
  return Math.max(high, 1e-9);
}

/**
 * Linear interpolation of what is curved misses to one side, by an eighth of the second difference in the middle
 * between two nodes. Values a sixteenth off at the nodes miss by half as much, to either side: in three dimensions 0.6
 * of the error in the mean square.
 *
 * @param {number[][][]} grid Rows in columns in slices; any number of nodes along each.
 * @param {number} [edge] A node along the rows where what is tabulated has an edge.
 * @param {boolean} [last] Whether the rows' last node is moved too, as if they went on evenly.
 */
function centred(grid, edge = -1, last = false) {
  const second = (before, at, after) => (before === undefined || after === undefined ? 0 : before - 2 * at + after);
  return grid.map((slice, k) =>
    slice.map((row, j) =>
      row.map(
        (value, i) =>
          value -
          (second(grid[k - 1]?.[j][i], value, grid[k + 1]?.[j][i]) +
            second(slice[j - 1]?.[i], value, slice[j + 1]?.[i]) +
            (i === edge
              ? 0
              : last && i === row.length - 1
                ? second(row[i - 2], row[i - 1], value)
                : second(row[i - 1], value, row[i + 1]))) /
            16,
      ),
    ),
  );
}

function dielectric() {
  const { angles, roughnesses, outer, outerTotal, inner, innerTotal } = LAYOUT;
  const values = [];
  // Rows of angles, then their mean.
  const slices = (count, sign, position, measure, mean, edge) => {
    const places = Array.from({ length: count }, (_, k) =>
      Array.from({ length: roughnesses }, (__, j) => [sign * epsilonOf(k, count), roughness(j, roughnesses)]),
    );
    const rows = places.map((slice) =>
      slice.map(([epsilon, r]) => {
        const bounced = bounce(epsilon, r);
        return Array.from({ length: angles }, (_, i) =>
          measure(epsilon, r, position(i / (angles - 1), epsilon, r), bounced),
        );
      }),
    );
    centred(rows, edge).forEach((slice, k) =>
      slice.forEach((row, j) => values.push(...row, mean(...places[k][j], row, k, j))),
    );
  };
  // What is lost: it is tiny where surfaces are smooth, and 1 less it would have few digits. Roughness along the rows,
  // linear; angles down the columns, the mean in the last row.
  const totals = (count, epsilonAt) => {
    const rough = Array.from({ length: angles + 1 }, (_, i) => MIN_ROUGHNESS + ((1 - MIN_ROUGHNESS) * i) / angles);
    const epsilons = Array.from({ length: count }, (_, k) => epsilonAt(k, count));
    const columns = epsilons.map((epsilon) =>
      rough.map((r) =>
        Array.from({ length: roughnesses - 1 }, (_, j) =>
          kept(epsilon, r, totalCosineOf(epsilon, j / (roughnesses - 2), r)),
        ),
      ),
    );
    centred(columns, -1, epsilons[0] > 0).forEach((slice, k) => {
      const whole = slice.map((column, i) => [
        ...column,
        average((mu) => interpolate(column, totalPosition(epsilons[k], mu, rough[i]))),
      ]);
      for (let j = 0; j < roughnesses; j++) values.push(...whole.map((column) => 1 - column[j]));
    });
  };
  const sample = (position, measure) => Array.from({ length: angles }, (_, i) => measure(position(i / (angles - 1))));
  const total = (epsilon, r) => {
    const row = sample(
      (t) => cosineOf(t, r),
      (mu) => kept(epsilon, r, mu),
    );
    return [...row, average((mu) => interpolate(row, (Math.sqrt(mu) * (1 + r)) / (Math.sqrt(mu) + r)))];
  };
  // What single scattering loses bounces on among the facets and has forgotten where it came from. Seen from the
  // thinner medium, the mean reflectance's part of it is reflected; from inside, such that as much goes through to
  // either side.
  const bounce = (epsilon, r) => {
    if (epsilon > 0) return 1 - meanThrough(epsilon);
    const [outside, inside] = [-epsilon, epsilon].map((e) => 1 - total(e, r).at(-1));
    return Math.min(Math.max(1 - (meanThrough(-epsilon) * outside) / Math.max(inside, 1e-4), 0), 1);
  };
  const share = (epsilon, r, mu, bounced) => {
    const { reflect, transmit } = albedo([r * r, r * r], etaOf(epsilon), mu);
    return reflect + (1 - reflect - transmit) * bounced;
  };
  const split = (epsilon, r, mu) => {
    const { reflect, transmit } = albedo([r * r, r * r], etaOf(epsilon), mu);
    return reflect / (reflect + transmit);
  };
  slices(
    outer,
    1,
    (t, _, r) => cosineOf(t, r),
    (epsilon, r, mu, bounced) =>
      (MARGIN.share * share(epsilon, r, mu, bounced)) / fresnelDielectric(etaOf(epsilon), softened(mu, r)),
    (epsilon, r, row) => {
      const mean = average(
        (mu) =>
          interpolate(row, (Math.sqrt(mu) * (1 + r)) / (Math.sqrt(mu) + r)) *
          fresnelDielectric(etaOf(epsilon), softened(mu, r)),
      );
      return (MARGIN.outer * (1 - mean)) / meanThrough(epsilon);
    },
  );
  totals(outerTotal, cubicEpsilonOf);
  // What goes through from inside, over a power of the index; on either side of the critical angle, where it has an
  // edge. No margin: interpolation misses by less, to either side.
  const halves = gaussLegendre(8);
  const through = centred(
    Array.from({ length: inner }, (_, k) =>
      Array.from({ length: roughnesses }, (__, j) => {
        const [epsilon, r] = [-epsilonOf(k, inner), roughness(j, roughnesses)];
        const eta = etaOf(epsilon);
        const critical = Math.sqrt(1 - eta * eta);
        const bounced = bounce(epsilon, r);
        const sum = halves.nodes.reduce((total, x, i) => {
          const at = (mu, step) => (1 - share(epsilon, r, mu, bounced)) * mu * step * 2 * x * halves.weights[i];
          return total + at(critical * (1 - x * x), critical) + at(critical + (1 - critical) * x * x, 1 - critical);
        }, 0);
        return [(2 * sum) / eta ** (2 - r)];
      }),
    ),
  );
  slices(
    inner,
    -1,
    (t, epsilon) => innerCosineOf(t, etaOf(epsilon)),
    split,
    (epsilon, r, row, k, j) => through[k][j][0],
    (angles - 1) / 2,
  );
  totals(innerTotal, (k, count) => -epsilonOf(k, count));
  values.push(...anisotropic());
  return {
    width: angles + 1,
    height: roughnesses,
    depth: outer + outerTotal + inner + innerTotal + LAYOUT.anisotropic,
    values,
  };
}

/** Slopes for a roughness and an anisotropy, as openpbr_alpha. */
const slopes = (r, anisotropy) => {
  const along = r * r * Math.sqrt(2 / (1 + (1 - anisotropy) ** 2));
  return [along, Math.max((1 - anisotropy) * along, 1e-3 * along)];
};

/** What anisotropic mirrors keep by single scattering, less what the round one with the same masking does. */
function anisotropic() {
  const flats = ANISOTROPIC_FLATS;
  const views = LAYOUT.roughnesses / flats;
  const columns = LAYOUT.angles;
  const mirror = interfaceAlbedo(80, 96);
  const roughnesses = Array.from(
    { length: LAYOUT.anisotropic },
    (_, j) => MIN_ROUGHNESS + ((1 - MIN_ROUGHNESS) * j) / (LAYOUT.anisotropic - 1),
  );
  const grid = roughnesses.map((r) => {
    const cosines = Array.from({ length: columns }, (__, i) =>
      Math.min(cosineOf(1 - (1 - i / (columns - 1)) ** (4 / 3), r), 1),
    );
    const round = cosines.map((mu) => mirror([r * r, r * r], 1.5, mu).mirror);
    return Array.from({ length: flats }, (__, k) => {
      const alpha = slopes(r, (k + 1) / flats);
      return Array.from({ length: views }, (___, row) => {
        const slope = 1 / (1 / alpha[0] + (1 / alpha[1] - 1 / alpha[0]) * (row / (views - 1)));
        const phi = Math.acos(
          Math.sqrt(Math.min(Math.max((slope ** 2 - alpha[1] ** 2) / (alpha[0] ** 2 - alpha[1] ** 2), 0), 1)),
        );
        return cosines.map((masked, i) => {
          // The view with that masking: its tangent times its slope is the round one's.
          const tangent = ((Math.sqrt(1 - masked * masked) / masked) * r * r) / slope;
          return mirror(alpha, 1.5, Math.max(1 / Math.hypot(1, tangent), 1e-9), phi).mirror - round[i];
        });
      });
    });
  });
  // As `centred`, over four dimensions; at anisotropy 0 there is no more.
  const at = (j, k, row, i) => (k < 0 ? 0 : (grid[j]?.[k]?.[row]?.[i] ?? NaN));
  const second = (value, before, after) => (Number.isNaN(before + after) ? 0 : before - 2 * value + after);
  const even = grid.map((blocks, j) =>
    blocks.map((rows, k) =>
      rows.map((values, row) =>
        values.map((value, i) => {
          const places =
            second(value, at(j - 1, k, row, i), at(j + 1, k, row, i)) +
            second(value, at(j, k - 1, row, i), at(j, k + 1, row, i));
          return (
            value -
            (places +
              second(value, at(j, k, row - 1, i), at(j, k, row + 1, i)) +
              second(value, at(j, k, row, i - 1), at(j, k, row, i + 1))) /
              16
          );
        }),
      ),
    ),
  );
  return even.flatMap((blocks, j) =>
    blocks.flatMap((rows, k) => {
      const less = lessLost(Math.max(j, 1), k);
      return rows.flatMap((row) => [...row, less]);
    }),
  );

  // By how much of the round mirror's the mean loss is less, of what is interpolated between whole steps: that is what
  // has to come out. Where it is smooth the loss is tiny, and the ratio that of the next roughness.
  function lessLost(j, k) {
    const r = roughnesses[j];
    const [ax, ay] = slopes(r, (k + 1) / flats);
    const steps = even[j][k].map((row) => row.map((value) => Math.round(value * STEP) / STEP));
    const fine = Array.from(
      { length: 401 },
      (__, i) => 1 - mirror([r * r, r * r], 1.5, Math.min(cosineOf(i / 400, r), 1)).mirror,
    );
    const { nodes: places, weights: parts } = gaussLegendre(64);
    let [lost, round] = [0, 0];
    // Angles as the columns lie, azimuths closer to where the slopes are steepest across the view.
    places.forEach((t, m) => {
      const mu = cosineOf(t, r);
      const part = (parts[m] * 4 * mu * Math.sqrt(mu) * r * (1 + r)) / (1 + r - t) ** 2;
      round += part * interpolate(fine, t);
      for (let i = 0; i < 48; i++) {
        const rest = 1 - (i + 0.5) / 48;
        const phi = (1 - rest * rest) * (Math.PI / 2);
        const slope = Math.hypot(ax * Math.cos(phi), ay * Math.sin(phi));
        const masked = mu / Math.hypot(mu, (slope * Math.sqrt(1 - mu * mu)) / (r * r));
        const angle = Math.min((Math.sqrt(masked) * (1 + r)) / (Math.sqrt(masked) + r), 1);
        const more = interpolate(
          steps.map((row) => interpolate(row, 1 - (1 - angle) ** 0.75)),
          (ay * (ax - slope)) / (slope * (ax - ay)),
        );
        lost += ((part * 2 * rest) / 48) * Math.max(interpolate(fine, angle) - more, 0);
      }
    });
    // Interpolation misses to either side here: a quarter of the round one's margin is enough.
    return 1 - (1 - 0.015 * (1 - r)) * (lost / round);
  }
}

function conductor() {
  const size = LAYOUT.conductor;
  const values = [];
  for (let j = 0; j < size; j++) {
    const r = roughness(j, size);
    const row = Array.from(
      { length: size },
      (_, i) => 1 - albedo([r * r, r * r], 1.5, cosineOf(i / (size - 1), r)).mirror,
    );
    // The mean falls with the fourth power of the roughness, which interpolation would miss by 8 %: over its third
    // power. Of whole steps, since those are what comes out.
    const steps = row.map((value) => Math.round(value * FINE_STEP) / FINE_STEP);
    values.push(
      ...row,
      (MARGIN.lost(r) * average((mu) => interpolate(steps, (Math.sqrt(mu) * (1 + r)) / (Math.sqrt(mu) + r)))) / r ** 3,
    );
  }
  return { width: size + 1, height: size, depth: 1, values };
}

/** Below the conductor's rows in the same table; in coarser steps, since what it holds is a simulation's. */
function fuzz() {
  const width = LAYOUT.conductor + 1;
  const { albedo: energy, stretch, shear } = sheen(width, LAYOUT.sheen, 40_000);
  return { width, height: 3 * LAYOUT.sheen, depth: 1, values: [...energy, ...stretch, ...shear] };
}

/**
 * Whole steps, each predicted from its left, upper and deeper neighbours (the three-dimensional Lorenzo predictor);
 * the differences are small and compress well as text: one printable character each, or "~" and three for a rare big
 * one.
 */
function encode({ width, height, depth, values }, step) {
  const steps = values.map((value) => Math.round(value * step));
  const at = (x, y, z) => (x < 0 || y < 0 || z < 0 ? 0 : steps[(z * height + y) * width + x]);
  let text = '';
  // Characters from "(" on, without the backslash and the backtick, which need care in source text.
  const digit = (value) => String.fromCharCode(value + 40 + (value >= 52 ? 1 : 0) + (value >= 55 ? 1 : 0));
  for (let z = 0; z < depth; z++) {
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const predicted =
          at(x - 1, y, z) +
          at(x, y - 1, z) +
          at(x, y, z - 1) -
          at(x - 1, y - 1, z) -
          at(x - 1, y, z - 1) -
          at(x, y - 1, z - 1) +
          at(x - 1, y - 1, z - 1);
        const difference = at(x, y, z) - predicted;
        // Zigzag keeps small magnitudes at small codes.
        const code = difference >= 0 ? 2 * difference : -2 * difference - 1;
        // One digit for most; those from 64 on begin two, and "~" three.
        text +=
          code < 64
            ? digit(code)
            : code < 64 + 16 * 80
              ? digit(64 + Math.floor((code - 64) / 80)) + digit((code - 64) % 80)
              : `~${digit(Math.floor(code / 6400))}${digit(Math.floor(code / 80) % 80)}${digit(code % 80)}`;
      }
    }
  }
  return `{ width: ${width}, height: ${height}, depth: ${depth}, step: ${step}, text: '${text}' }`;
}

const note = '// Made by scripts/tables.mjs; do not edit.\n';

// The sizes stand apart from the numbers: code that needs only them does not include 24 kB of text.
const sources = {
  // Written as reals, so that the shaders' quotients are real.
  'grid.wesl': `${note}
// How many angles, roughnesses and slices of indices the tables hold.

${Object.entries(LAYOUT)
  .map(([name, value]) => `const OPENPBR_TABLE_${name.replace(/[A-Z]/g, '_$&').toUpperCase()} = ${value}.0;\n`)
  .join('')}`,
  'encoded.ts': `${note}
// oxfmt-ignore
export const ENCODED_DIELECTRIC = ${encode(dielectric(), STEP)};

// oxfmt-ignore
export const ENCODED_CONDUCTOR = ${encode(conductor(), FINE_STEP)};

// oxfmt-ignore
export const ENCODED_SHEEN = ${encode(fuzz(), STEP)};
`,
};

for (const [name, source] of Object.entries(sources)) {
  const file = new URL(`../src/tables/${name}`, import.meta.url);
  if (!process.argv.includes('--check')) writeFileSync(file, source);
  else if (readFileSync(file, 'utf8') !== source) {
    console.error(`src/tables/${name} is not what scripts/tables.mjs makes; run it again.`);
    process.exitCode = 1;
  }
}
