import { multiply } from 'gl-matrix/esm/mat4.js';
import type { Part } from './geometry';
import { numbersFrom } from './matrix';
import type { Color, Matrix, ThreeMesh } from './types';

/** A placement of one part of a mesh. */
export interface Placement {
  readonly transform: Float64Array<ArrayBuffer>;
  readonly tint?: Color;
}

/** Where a mesh stands: once, or as often as it has instances. */
export function placementsOf(mesh: ThreeMesh): Placement[] {
  const world = numbersFrom(mesh.matrixWorld);
  if (!mesh.isInstancedMesh) return [{ transform: world }];
  const { count, instanceMatrix, instanceColor } = mesh as unknown as {
    readonly count: number;
    readonly instanceMatrix: { readonly array: ArrayLike<number> };
    readonly instanceColor: { readonly array: ArrayLike<number> } | null;
  };
  return Array.from({ length: count }, (_, i) => {
    const own = Array.from({ length: 16 }, (__, k) => instanceMatrix.array[16 * i + k] as number);
    const c = instanceColor?.array;
    return {
      transform: multiply(new Float64Array(16), world, own),
      ...(c ? { tint: { r: c[3 * i] as number, g: c[3 * i + 1] as number, b: c[3 * i + 2] as number } } : {}),
    };
  });
}

/** What three takes for one of its colours, to be filled by it. */
class Target implements Color {
  r = 1;
  g = 1;
  b = 1;

  setRGB(r: number, g: number, b: number): this {
    [this.r, this.g, this.b] = [r, g, b];
    return this;
  }

  fromArray(array: ArrayLike<number>, offset = 0): this {
    return this.setRGB(array[offset] as number, array[offset + 1] as number, array[offset + 2] as number);
  }
}

interface Batched {
  readonly maxInstanceCount: number;
  getVisibleAt(id: number): boolean;
  getGeometryIdAt(id: number): number;
  getGeometryRangeAt(id: number): { readonly start: number; readonly count: number } | null;
  getMatrixAt(id: number, target: Matrix): Matrix;
  /** Since version 0.166. */
  getColorAt?(id: number, target: Target): unknown;
}

/** The geometries of a BatchedMesh with the places of each. */
export function batchesOf(mesh: ThreeMesh): { readonly part: Part; readonly placements: Placement[] }[] {
  const batched = mesh as unknown as Batched;
  const world = numbersFrom(mesh.matrixWorld);
  // An object of three's own to be filled.
  const matrix = (mesh.matrixWorld as unknown as { clone(): Matrix }).clone();
  const byGeometry = new Map<number, Placement[]>();
  for (let id = 0; id < batched.maxInstanceCount; id++) {
    try {
      if (!batched.getVisibleAt(id)) continue;
    } catch {
      // A number that was never given, or was given back.
      continue;
    }
    const geometry = batched.getGeometryIdAt(id);
    const placements = byGeometry.get(geometry) ?? [];
    const tint = new Target();
    batched.getColorAt?.(id, tint);
    placements.push({
      transform: multiply(new Float64Array(16), world, batched.getMatrixAt(id, matrix).elements),
      ...(tint.r === 1 && tint.g === 1 && tint.b === 1 ? {} : { tint }),
    });
    byGeometry.set(geometry, placements);
  }
  return [...byGeometry].flatMap(([geometry, placements]) => {
    const range = batched.getGeometryRangeAt(geometry);
    return range
      ? [{ part: { start: range.start, count: range.count - (range.count % 3), material: 0 }, placements }]
      : [];
  });
}
