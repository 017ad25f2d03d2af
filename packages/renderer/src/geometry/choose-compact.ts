import { loadPart } from '@glanz/wgsl';
import type { Scene } from '@glanz/scene';
import type { MemoryBudget } from '../memory';
import type { CompactShapes } from './compact-shapes';
import { expectedShapes, shapeBytes } from './geometry';

/** Shapes of so many MiB are stored as they are read fastest; larger ones take about half. */
const COMPACT_ABOVE_MIB = 256;
/** Share of their size that compact shapes may take: triangles that share few vertices do not get smaller. */
const COMPACT_SHARE = 0.8;

/** What writes the shapes of a scene, if they are to be compact, see `MemoryBudget.compactAboveMiB`. */
export async function chooseCompact(scene: Scene, memory?: MemoryBudget): Promise<CompactShapes | undefined> {
  const above = memory?.compactAboveMiB;
  const bytes = totalBytes(scene);
  if (bytes <= (above ?? COMPACT_ABOVE_MIB) * 2 ** 20) return undefined;
  // The GPU poses meshes in the other layout alone.
  if (above === undefined && scene.meshes.some(({ pose }) => pose)) return undefined;
  // A chunk of its own, for most scenes have no use for it.
  const { COMPACT_SHAPES } = await loadPart('compact-shapes', import('./compact-shapes'));
  return totalBytes(scene, COMPACT_SHAPES) < COMPACT_SHARE * bytes ? COMPACT_SHAPES : undefined;
}

const totalBytes = (scene: Scene, compact?: CompactShapes) =>
  Object.values(shapeBytes(scene, expectedShapes(scene, compact))).reduce((a, b) => a + b, 0);
