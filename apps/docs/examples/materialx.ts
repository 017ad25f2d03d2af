import { readMaterialX, writeMaterialX } from '@glanz/openpbr/materialx';
import { OPENPBR_PRESETS, openPbrPreset } from '@glanz/openpbr/presets';
import type { PathTracer } from '@glanz/renderer';

// #region read
export async function dress(tracer: PathTracer, url: string) {
  const { materials, warnings } = readMaterialX(
    await (await fetch(url)).text(),
  );
  for (const { message } of warnings) console.warn(message);
  for (const { name, parameters } of materials)
    await tracer.setMaterial(name, parameters);
}
// #endregion read

// #region write
export const { document } = writeMaterialX([
  { name: 'housing', parameters: OPENPBR_PRESETS.gold },
  {
    name: 'label',
    parameters: { specular_roughness: 0.8 },
    textures: {
      base_color: { file: 'label.png', channels: 'rgb', colorSpace: 'srgb' },
    },
  },
]);
// #endregion write

// #region preset
export async function pour(tracer: PathTracer) {
  await tracer.setMaterial('ring', OPENPBR_PRESETS.gold);
  // Its lengths are centimetres.
  await tracer.setMaterial('glass', openPbrPreset('milk', { unit: 0.01 }));
}
// #endregion preset
