// Writes results/openpbr.md and results/openpbr.json from the measurements of the tests:
//   GLANZ_RESULTS=$PWD/out/openpbr GLANZ_FULL=1 npx vitest run --project openpbr test/proofs.test.ts
//   test/furnace.test.ts test/oracle.test.ts
//   node apps/docs/scripts/openpbr-results.mjs out/openpbr
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const folder = process.argv[2];
if (!folder) {
  process.stderr.write('openpbr-results: pass the folder that GLANZ_RESULTS named\n');
  process.exit(1);
}
// Where the folder lacks a file, the page keeps its former values.
const before = existsSync(at('../results/openpbr.json'))
  ? JSON.parse(readFileSync(at('../results/openpbr.json'), 'utf8'))
  : {};
const read = (name) =>
  existsSync(join(folder, `${name}.json`))
    ? JSON.parse(readFileSync(join(folder, `${name}.json`), 'utf8'))
    : (before[name] ?? {});
const data = { oracle: read('oracle'), furnace: read('furnace'), proofs: read('proofs') };

/**
 * White furnace tests of other implementations, run with their own code: three-gpu-pathtracer 0.0.26 by rendering,
 * openpbr-bsdf a29da96 by the mean weight of its samples.
 */
const OTHERS = {
  metal: ['−3.5 %', '0.997 to 1.003'],
  diffuse: ['', '0.997 to 1.003'],
  'dielectric over diffuse': ['', '0.997 to 1.003'],
  glass: ['+1.2 to +1.6 %', '0.997 to 1.003'],
  subsurface: ['no lobe', '0.997 to 1.003'],
  'thin glass': ['', '0.42 to 1.23'],
  paper: ['no lobe', 'up to 1.087'],
  'coat over diffuse': ['', 'up to 1.018'],
  'coat over glass': ['', 'up to 1.027'],
  'fuzz over diffuse': ['−3.2 %', '0.997 to 1.003'],
  'film over diffuse': ['tinted', 'up to 1.068'],
  'film over metal': ['tinted', '0.991 to 0.996'],
  'anisotropic metal, anisotropy 0.9': ['−23 %', '0.994 to 1.029'],
  'anisotropic glass, anisotropy 0.9': ['', '0.962 to 1.000, anisotropy 0.8'],
};
/** The name of a test as the page shows it. */
const label = (name) => name.replace('(ours by choice)', '(deliberate)').replace(/^paper$/, 'thin-walled diffuse');
const number = (value, digits = 4) => (value === undefined ? '' : value.toFixed(digits));
const percent = (value) => `${(100 * value).toFixed(1)} %`;
const table = (head, rows) =>
  [
    `| ${head.join(' | ')} |`,
    `|${head.map(() => '---').join('|')}|`,
    ...rows.map((row) => `| ${row.join(' | ')} |`),
  ].join('\n');

const furnace = table(
  ['surface', 'min', 'max', 'three-gpu-pathtracer', 'openpbr-bsdf'],
  Object.entries(data.furnace).map(([name, { min, max }]) => [
    label(name),
    number(min),
    number(max),
    ...(OTHERS[name] ?? ['', '']),
  ]),
);
const sizes = Object.values(data.furnace)[0];
const chi = Object.entries(data.proofs).filter(([name]) => name.startsWith('chi-squared: '));
const densities = Object.entries(data.proofs).filter(([name]) => name.startsWith('density: '));
const percentOf = (value) => `${(100 * value).toFixed(2)} %`;
const oracle = table(
  ['setting', 'class', 'pairs', 'median', '90th percentile', 'worst', 'limit'],
  Object.entries(data.oracle)
    .filter(([name]) => !name.startsWith('albedo: '))
    .map(([name, row]) => [
      label(name),
      row.class,
      row.pairs,
      row.median === undefined ? '' : percent(row.median),
      row.p90 === undefined
        ? row.part === undefined
          ? ''
          : `${percent(row.part)} of the pairs within`
        : percent(row.p90),
      percent(row.worst),
      row.class === 'I'
        ? `${percent(row.limit[0])}, ${percent(row.limit[1])}`
        : `${percent(row.limit[0])} or ${row.limit[1]}`,
    ]),
);
const albedos = Object.entries(data.oracle).filter(([name]) => name.startsWith('albedo: '));
const { finite, materials, reciprocity } = data.proofs;

const page = `---
title: OpenPBR, measured
---

<!-- Written by scripts/openpbr-results.mjs from the measurements of the tests of @glanz/openpbr; do not edit. -->

# OpenPBR, measured

<ResultPlot of="openpbr" />

Results of the tests of [\`@glanz/openpbr\`](/packages/openpbr), each with the number of cases tested. They measure the functions [on the CPU](/api/openpbr/cpu), in double precision; other tests compare the shaders with these functions, to within 10⁻⁴.

## White furnace

A white surface in uniform light must reflect all of it: its directional albedo is 1. The table shows the minimum and the maximum of the directional albedo over ${sizes?.roughnesses.length ?? ''} roughnesses from ${sizes?.roughnesses[0] ?? ''} to ${sizes?.roughnesses.at(-1) ?? ''} and ${sizes?.cosines.length ?? ''} viewing angles down to a cosine of ${sizes?.cosines.at(-1) ?? ''}, by deterministic quadrature with an error of up to 0.001. Glass seen from inside along the normal is left out, since the quadrature has an error of 0.012 there; surfaces with an index of refraction below 1 are seen from a cosine of 0.97 instead. Anisotropic metal, glass, and dielectrics over diffuse have quadratures of their own with an error of up to 0.0002, which include glass along the normal; the mean weights of samples agree with them. The other columns are measurements of three-gpu-pathtracer 0.0.26, by rendering, and of Adobe's openpbr-bsdf, by the mean weight of its samples. An empty cell was not measured.

${furnace}

${materials ? `${materials.materials} random white materials with all lobes, without anisotropy and rough diffuse, at 3 angles each: ${number(materials.min)} to ${number(materials.max)}.` : ''}

Anisotropic highlights: the energy that metal loses by single scattering is tabulated over roughness, anisotropy and both angles, and is added as a reciprocal lobe. For dielectrics it is a sum over visible microfacets: from outside over 16 that reflect into the upper hemisphere, in proportion to the tabulated reflection of a mirror, and over 26 of all, with places and weights fitted to larger sums, or over 6 and 7 where the anisotropy is at most 0.31; from inside over 160, within the critical angle and among those that reflect into the upper hemisphere. For an index of refraction below 1 over an opaque base, and near 1 from inside, the sums have 96 terms, for the viewing direction and for the light direction; their mean over all directions is tabulated, which is where the deviations of these rows come from.

## Samples against their density

Chi-squared tests of histograms over 320 cells of equal solid angle, at a significance of 0.01 with Šidák's correction. A lobe fails if the smallest p-value of its settings is below the limit.

${table(
  ['lobe', 'settings', 'samples each', 'smallest p-value', 'limit'],
  chi.map(([name, row]) => [
    label(name.slice(13)),
    row.settings,
    row.samples.toLocaleString('en'),
    row.min.toExponential(1),
    row.limit.toExponential(1),
  ]),
)}

${densities.length ? `For each of these settings, the integral of the density plus the fraction of samples that fail, because a microfacet reflects them below the surface, is 1 to within ${percentOf(Math.max(...densities.map(([, row]) => row.worst)))}.` : ''} In none of the cases above does the density integrate to more than ${number(Math.max(materials?.density ?? 0, ...Object.values(data.furnace).map((row) => row.density ?? 0)))}.

## Reciprocity

${reciprocity ? `Single scattering of opaque materials without coat, fuzz and film: ${reciprocity.pairs.toLocaleString('en')} random materials, each with a random pair of directions; the largest relative difference of f(a, b) and f(b, a) is ${reciprocity.worst.toExponential(1)}.` : ''} Three parts are not reciprocal: multiple scattering of dielectrics, which leaves as a diffuse lobe; coats and fuzz; and the diffuse base below a thin film. The last two scale what is below them by their reflectance for the viewing direction only.

## Finite values

${finite ? `${finite.materials.toLocaleString('en')} random materials with parameters at the ends of their ranges, ${finite.directions} pairs of directions each, down to the horizon: no value, density or weight is NaN, infinite or negative.` : ''}

## Against an independent implementation

Compares f(ω_o, ω_i) · cos θ_i with Adobe's openpbr-bsdf, whose values are converted to height-correlated masking. Rows marked “deliberate” differ by choice, for the reasons below. In class S the specification determines the result, and every pair of directions must be within the limit (relative or absolute). Class R is the model that the specification recommends. Class I is left to the implementation; the limits apply to the median and the 90th percentile of |a − b| / max(a, b, 0.02). The worst values are large where one of the two values is nearly zero.

${oracle}

${
  albedos.length
    ? `The reflected and the transmitted fraction of uniform light are also within the limits for every setting, except these, which differ deliberately:

${table(
  ['setting', 'angles', 'beyond the limit', 'largest difference', 'limit'],
  albedos.map(([name, row]) => [
    name.slice(8),
    row.angles,
    row.beyond,
    number(row.worst, 3),
    `${percent(row.limit[0])} or ${row.limit[1]}`,
  ]),
)}`
    : ''
}

Where the two implementations differ, and why:

- **Multiple scattering** between microfacets leaves as a diffuse lobe in Glanz, and in lobes with little light near the normal in openpbr-bsdf. This is most of the difference for rough metals and glass, and all of it for \`glass_dispersion\`.
- **Thin walls** (\`glass_thin_*\`, \`kitchen_thin\`, deliberate): in openpbr-bsdf rough thin walls lose or gain up to 58 % of the light. In Glanz the transmission lobe is narrower, since the two refractions mostly cancel, and every white thin wall conserves energy. Thin-walled diffuse (\`sss_thin\`): openpbr-bsdf returns up to 9 % more light than arrives.
- **Thin film**: openpbr-bsdf evaluates three wavelengths, Glanz the visible spectrum. Rows without “over the spectrum” evaluate the same three wavelengths. Over the spectrum, the fractions of uniform light differ from those by up to 0.11 (\`film_bubble\` near the horizon), and by less than the limit near the normal.
- **Coat**: Glanz increases the roughness of the base by the rule proposed for the next version of the specification, and computes the darkening from the reflectance at the viewing angle.
- **Fuzz** does not increase the roughness of the coat below it.
- **\`eon_half_weight\`**: in Glanz base_weight scales the EON lobe, as in the specification's text. In openpbr-bsdf it is part of the colour, so that interreflection in the rough surface is darker.
`;
writeFileSync(at('../results/openpbr.json'), `${JSON.stringify(data, undefined, 1)}\n`);
writeFileSync(at('../results/openpbr.md'), page.replace(/\n{3,}/g, '\n\n'));
