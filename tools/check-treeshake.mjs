// node tools/check-treeshake.mjs — a page that uses one symbol pays for that symbol.
//
// Each package is bundled twice: `import '@glanz/x'` alone must leave nothing, also when the bundler does not believe
// `sideEffects: false`; and one symbol imported must not bring the text of unrelated features.
import { PEERS, bundle } from './pipeline/bundle.mjs';
import { installPacked } from './pipeline/packed.mjs';
import { Verdicts, columns, runAlone } from './pipeline/report.mjs';
import { NODE_PACKAGES, entriesOf } from './pipeline/workspace.mjs';

/**
 * One symbol per line: what its bundle must hold (else the test would prove nothing) and what it must not, though the
 * same entry exports it.
 */
const SYMBOLS = [
  {
    from: '@glanz/wgsl',
    symbol: 'struct',
    has: ['wgsl/unknown-field'],
    lacks: ['wgsl/unbalanced-gate', 'getCompilationInfo'],
  },
  {
    from: '@glanz/wgsl',
    symbol: 'compose',
    has: ['wgsl/unbalanced-gate'],
    lacks: ['wgsl/field-length', 'getCompilationInfo'],
  },
  { from: '@glanz/scene', symbol: 'SceneError', has: ['extends'], lacks: ['scene/empty', 'yfov'] },
  { from: '@glanz/bvh', symbol: 'buildBlas', has: ['bvh/positions'], lacks: ['bvh/transform'] },
  {
    from: '@glanz/bvh/wgsl',
    symbol: 'bvhOffset',
    has: ['fn bvh_offset'],
    lacks: ['fn bvh_intersect_triangle', 'fn bvh_enter_box'],
  },
  { from: '@glanz/openpbr', symbol: 'OPENPBR_PARAMETERS', has: ['specular_roughness'], lacks: ['fn openpbr_'] },
  {
    from: '@glanz/openpbr',
    symbol: 'OPENPBR_PARAMETER_SPECS',
    has: ['specular_roughness'],
    lacks: ['Albedo of the diffuse lobe'],
  },
  { from: '@glanz/openpbr', symbol: 'openPbrStruct', has: ['base_color'], lacks: ['fn openpbr_sample'] },
  {
    from: '@glanz/tonemap',
    symbol: 'tonemapAgx',
    has: ['fn tonemap_agx'],
    lacks: ['fn tonemap_aces', 'createRenderPipeline', 'fn tonemap_neutral'],
  },
  { from: '@glanz/tonemap', symbol: 'toneMap', has: ['agx'], lacks: ['createRenderPipeline'] },
  { from: '@glanz/image', symbol: 'decodeHdr', has: ['32-bit_rle_rgbe'], lacks: ['IHDR', 'chlist'] },
  {
    from: '@glanz/gltf',
    symbol: 'GltfError',
    has: ['extends'],
    lacks: ['KHR_lights_punctual', 'KHR_materials_emissive_strength'],
  },
  {
    from: '@glanz/three',
    symbol: 'fromThree',
    has: ['three/no-triangles'],
    lacks: ['three/destroyed', 'createRenderPipeline'],
  },
  {
    from: '@glanz/three/compat',
    symbol: 'PhysicalCamera',
    has: ['apertureBlades'],
    lacks: ['three/destroyed', 'createComputePipeline', 'renderDelay'],
  },
  {
    from: '@glanz/renderer',
    symbol: 'requestDevice',
    has: ['renderer/no-adapter'],
    lacks: ['@compute', 'fn bvh_', 'fn openpbr_'],
  },
];

export async function checkTreeShaking() {
  const verdicts = new Verdicts();
  const consumer = await installPacked();
  const rows = [];
  for (const p of consumer.packages) {
    if (NODE_PACKAGES.includes(p.short)) continue;
    for (const { path, specifier, conditions } of entriesOf(p)) {
      // One that is there for its effect must keep it.
      if (p.manifest.sideEffects?.includes?.(conditions.default)) {
        await verdicts.attempt(`import '${specifier}'`, async () => {
          const { text } = await bundle(consumer, `import '${specifier}';`, { external: PEERS });
          verdicts.expect(text.includes('customElements.define'), `import '${specifier}' has lost its effect.`);
        });
        continue;
      }
      // A worker's file is loaded for what it does.
      if (path === './node' || path === './worker') continue;
      await verdicts.attempt(`import '${specifier}'`, async () => {
        const trusting = await bundle(consumer, `import '${specifier}';`, { external: PEERS });
        verdicts.expect(
          trusting.text.trim() === '',
          `import '${specifier}' leaves ${trusting.bytes} bytes: ${trusting.text.slice(0, 160)}`,
        );
        // Without believing sideEffects, what other people's dependencies leave is theirs; ours must be gone.
        const { inputs, text } = await bundle(consumer, `import '${specifier}';`, {
          external: [...PEERS, 'gl-matrix/*'],
          keepEffects: true,
        });
        const ours = Object.entries(inputs).filter(([file, bytes]) => bytes > 0 && file.includes('@glanz/'));
        // Imports of libraries stay, and do nothing of ours.
        const bare =
          text
            .replace(/import\s*\{[^}]*\}\s*from\s*"(react|three|@react-three\/fiber|gl-matrix\/[^"]*)";?/g, '')
            .replace(/import\s*"gl-matrix\/[^"]*";?/g, '')
            .replace(/"use client";?/g, '')
            .trim() === '';
        verdicts.expect(
          bare || ours.length === 0,
          `import '${specifier}' runs code: ${ours.map(([file, bytes]) => `${file} (${bytes} bytes)`).join(', ')}: ${text.slice(0, 200)}`,
        );
      });
    }
  }
  for (const { from, symbol, has, lacks } of SYMBOLS) {
    await verdicts.attempt(`{ ${symbol} } from ${from}`, async () => {
      const whole = await bundle(consumer, `export * from '${from}';`, { external: PEERS });
      const one = await bundle(consumer, `export { ${symbol} } from '${from}';`, { external: PEERS });
      const faults = [
        ...has.filter((marker) => !one.text.includes(marker)).map((marker) => `lacks "${marker}"`),
        ...lacks.filter((marker) => one.text.includes(marker)).map((marker) => `drags in "${marker}"`),
        ...lacks
          .filter((marker) => !whole.text.includes(marker))
          .map((marker) => `"${marker}" is nowhere in the package: choose another marker`),
      ];
      verdicts.expect(faults.length === 0, `{ ${symbol} } from ${from}: ${faults.join('; ')}.`);
      rows.push([`{ ${symbol} }`, from, (one.gzip / 1000).toFixed(2), (whole.gzip / 1000).toFixed(2)]);
    });
  }
  verdicts.table.push(...columns([['symbol', 'from', 'kB min+gz', 'of'], ...rows], [2, 3]));
  return verdicts;
}

await runAlone(import.meta, checkTreeShaking);
