// Makes results/openpbr.md and results/openpbr.json of what the tests measured:
//   GLANZ_RESULTS=$PWD/out/openpbr GLANZ_PROOFS=full npx vitest run --project openpbr test/proofs.test.ts
//   test/furnace.test.ts test/oracle.test.ts
//   node apps/docs/scripts/openpbr-results.mjs out/openpbr
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const folder = process.argv[2];
if (!folder) {
  process.stderr.write('openpbr-results: name the folder that GLANZ_RESULTS was\n');
  process.exit(1);
}
// What a folder lacks stays as it was on the page.
const before = existsSync(at('../results/openpbr.json'))
  ? JSON.parse(readFileSync(at('../results/openpbr.json'), 'utf8'))
  : {};
const read = (name) =>
  existsSync(join(folder, `${name}.json`))
    ? JSON.parse(readFileSync(join(folder, `${name}.json`), 'utf8'))
    : (before[name] ?? {});
const data = { oracle: read('oracle'), furnace: read('furnace'), proofs: read('proofs') };

/**
 * White furnaces of others, measured with their own code: three-gpu-pathtracer 0.0.26 in its renderer; openpbr-bsdf
 * a29da96 by sums of its samples' weights.
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
  'stretched metal, anisotropy 0.9': ['−23 %', '0.994 to 1.029'],
  'stretched glass, anisotropy 0.9': ['', '0.962 to 1.000, anisotropy 0.8'],
};
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
    name,
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
      name,
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

<!-- Made by scripts/openpbr-results.mjs of what the tests of @glanz/openpbr measured; do not edit. -->

# OpenPBR, measured

<ResultPlot of="openpbr" />

What the tests of [\`@glanz/openpbr\`](/packages/openpbr) find; how much was tried is said with each. The functions measured are those [on the CPU](/api/openpbr/cpu), in double precision; other tests hold the shaders to them within 10⁻⁴.

## White furnace

White surfaces in uniform light should give back all of it: 1. The minimum and the maximum found, over ${sizes?.roughnesses.length ?? ''} roughnesses from ${sizes?.roughnesses[0] ?? ''} to ${sizes?.roughnesses.at(-1) ?? ''} and ${sizes?.cosines.length ?? ''} angles down to cosine ${sizes?.cosines.at(-1) ?? ''}, by deterministic quadrature that is itself good to 0.001. Seen along the normal from inside of glass the quadrature is good to 0.012 only, and that angle is left out; surfaces of an index below 1 are seen from cosine 0.97 instead. Stretched metal, glass and dielectrics over diffuse have quadratures of their own, good to 0.0002, and glass is seen along the normal there too; the means of samples' weights agree with them. In the other columns what we measured of three-gpu-pathtracer 0.0.26, by rendering, and of Adobe's openpbr-bsdf, by its samples' weights; empty where we did not.

${furnace}

${materials ? `${materials.materials} random white materials of all lobes, without stretched highlights and rough diffuse, 3 angles each: ${number(materials.min)} to ${number(materials.max)}.` : ''}

Stretched highlights: what metal loses by single scattering is tabulated over roughness, anisotropy and both angles, and comes back reciprocally; for dielectrics it is summed over facets as they are seen: from outside over 32 of those that mirror upwards and 40 of all, from inside over 160, within the critical angle and within what mirrors upwards. Indices below 1 over something opaque, and those near 1 from inside, are summed over 96 of those, for the viewer, for the light, and for the mean over all directions at 16 of them.

## Samples against their density

Chi-squared of histograms over 320 equal parts of the sphere, significance 0.01 with Šidák's correction; a lobe fails if its minimum probability falls below the limit.

${table(
  ['lobe', 'settings', 'samples each', 'minimum probability', 'limit'],
  chi.map(([name, row]) => [
    name.slice(13),
    row.settings,
    row.samples.toLocaleString('en'),
    row.min.toExponential(1),
    row.limit.toExponential(1),
  ]),
)}

${densities.length ? `The integral of the density, and the part of the samples that a facet sends to where there is nothing, make 1 within ${percentOf(Math.max(...densities.map(([, row]) => row.worst)))} for each of these settings.` : ''} The density integrates to no more than ${number(Math.max(materials?.density ?? 0, ...Object.values(data.furnace).map((row) => row.density ?? 0)))} anywhere above.

## Reciprocity

${reciprocity ? `Single scattering of opaque materials without coat, fuzz and film: ${reciprocity.pairs.toLocaleString('en')} random materials, each with a random pair of directions; the largest relative difference of f(a, b) and f(b, a) is ${reciprocity.worst.toExponential(1)}.` : ''} What bounces among the facets of dielectrics leaves evenly, and coats, fuzz and diffuse light below a film are scaled by what they reflect towards the viewer: those are not reciprocal.

## Finite

${finite ? `${finite.materials.toLocaleString('en')} random materials with parameters at the ends of their ranges, ${finite.directions} pairs of directions each, down to the horizon: no value, density or weight is NaN, infinite or negative.` : ''}

## Against an independent implementation

Values f(ω_o, ω_i) · cos θ_i of Adobe's openpbr-bsdf, brought to height-correlated masking. Rows that say so differ by choice, for the reasons below. Class S is determined by the specification, and every pair must be within the limit (relative, or absolute); R is its recommended model; I leaves the choice to implementations, and the limits hold for the median and the 90th percentile of |a − b| / max(a, b, 0.02). Large worst values are where one of both is nearly dark.

${oracle}

${
  albedos.length
    ? `The reflected and transmitted parts of uniform light are within the limits too, of every setting, but for these, which differ by choice:

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

Where we differ, and why:

- **Multiple scattering**: the light that bounces among facets leaves by a lobe of its own and evenly, there by lobes that avoid the normal; that is most of the difference of rough metals and glasses, and all of that of \`glass_dispersion\`.
- **Thin walls** (\`glass_thin_*\`, \`kitchen_thin\`, by choice): there rough walls lose or make up to 58 % of the light; here what goes through is a narrower lobe, since two refractions mostly undo each other, and white walls of any kind give back all. Paper (\`sss_thin\`): there it gives back up to 9 % more than it gets.
- **Thin film**: there at three wavelengths; here over the visible spectrum. Rows without a remark are evaluated at the three; over the spectrum the parts of uniform light differ by up to 0.11 from those (\`film_bubble\` near the horizon), and by less than the limit where the view is steep.
- **Coat**: rougher below by the rule proposed for the next version of the specification; darkening by the reflectance at the viewer's angle.
- **Fuzz** does not roughen the coat below it. \`eon_half_weight\`: base_weight is outside of EON, as in the specification's text; there it is part of the colour, and what bounces in the rough surface is darker.
`;
writeFileSync(at('../results/openpbr.json'), `${JSON.stringify(data, undefined, 1)}\n`);
writeFileSync(at('../results/openpbr.md'), page.replace(/\n{3,}/g, '\n\n'));
