import {
  cadToScene,
  checkMaterialMap,
  levelsOfDetail,
  readCad,
  writeGlb,
} from '@glanz/cad';
import { openOcct } from '@glanz/cad/node';

/** Converts a STEP file to GLB files, from fine to coarse. */
export async function stepToGlb(
  stepBytes: Uint8Array,
  map: unknown,
): Promise<Uint8Array[]> {
  const model = await readCad(stepBytes, {
    openOcct,
    tolerance: { metres: 0.0001 },
  });
  const scene = cadToScene(model, {
    materials: checkMaterialMap(map),
    strip: true,
  });
  const levels = await levelsOfDetail(scene, { levels: 3 });
  return levels.map((level) => writeGlb(level, { strip: true }));
}
