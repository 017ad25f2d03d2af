import type { Instance, Material, Mesh, Scene, Steps } from '@glanz/scene';
import { GROUP_SHIFT, LIGHT_MIRRORED, LIGHT_TRIANGLE, LIGHT_TWO_SIDED, lightStruct } from '../storage/layout';
import { EmissionEstimate } from './emission';
import type { LightGroupTable } from './light-groups';
import { luminance, wordOf } from './light-records';
import type { TreeLights } from './light-bounds';
import { emittedRadiance } from '../materials/materials';
import { determinant3, transformPoint } from '../geometry/matrix';
import { parametersOf } from '../materials/parameters';

/** The texture coordinates of a triangle's corners. */
const cornersOf = (uvs: Float32Array, indices: Uint32Array, triangle: number) =>
  [0, 1, 2].flatMap((k) => {
    const vertex = indices[3 * triangle + k] as number;
    return [uvs[2 * vertex] as number, uvs[2 * vertex + 1] as number];
  }) as [number, number, number, number, number, number];

/** Triangles that are written between two stops. */
const STEP_TRIANGLES = 2048;

/** Where the triangles of an instance are written, and what they have in common. */
interface Emitter {
  readonly floats: Float32Array;
  readonly integers: Uint32Array;
  readonly weights: Float64Array;
  readonly bounds: TreeLights;
  /** The first one's record. */
  readonly base: number;
  readonly mesh: Mesh;
  readonly transform: Float64Array;
  readonly material: number;
  readonly kind: number;
  readonly radiance: number;
  readonly sides: number;
  /** −1 where the transform turns the triangles round. */
  readonly mirrored: number;
  readonly estimate: EmissionEstimate | undefined;
  readonly uvs: Float32Array | undefined;
}

/**
 * Writes the triangles of a glowing instance, all but what names shapes on the GPU: see {@link nameTriangles}.
 *
 * @param weights Their powers; 0 for those that do not shine.
 * @param base The first one's record.
 */
export function* triangleSteps(
  records: ArrayBuffer,
  weights: Float64Array,
  bounds: TreeLights,
  scene: Scene,
  index: number,
  base: number,
  groups: LightGroupTable,
): Steps<void> {
  const instance = scene.instances[index] as Instance;
  const mesh = scene.meshes[instance.mesh] as Mesh;
  const material = scene.materials[instance.material] as Material;
  const mirrored = determinant3(instance.transform) < 0 ? -1 : 1;
  const binding = material.textures?.emission_color;
  const emitter: Emitter = {
    floats: new Float32Array(records),
    integers: new Uint32Array(records),
    weights,
    bounds,
    base,
    mesh,
    // Whatever kind of list it is, the loop's machine code sees one.
    transform: Float64Array.from(instance.transform),
    material: instance.material,
    kind:
      LIGHT_TRIANGLE |
      (material.double_sided ? LIGHT_TWO_SIDED : 0) |
      (mirrored < 0 ? LIGHT_MIRRORED : 0) |
      (groups.material(material) << GROUP_SHIFT),
    radiance: luminance(emittedRadiance(parametersOf(material))),
    sides: material.double_sided ? 2 : 1,
    mirrored,
    estimate: binding ? new EmissionEstimate(scene, binding) : undefined,
    uvs: binding ? mesh.uvs?.[binding.uv ?? 0] : undefined,
  };
  const count = mesh.indices.length / 3;
  for (let first = 0; first < count; first += STEP_TRIANGLES) {
    if (first > 0) yield;
    writeTriangles(emitter, first, Math.min(count, first + STEP_TRIANGLES));
  }
}

/** No functions and no lists within the loop: thousands of triangles, while nothing is compiled yet. */
function writeTriangles(
  {
    floats,
    integers,
    weights,
    bounds,
    base,
    mesh,
    transform,
    material,
    kind,
    radiance,
    sides,
    mirrored,
    estimate,
    uvs,
  }: Emitter,
  first: number,
  end: number,
): void {
  const words = lightStruct.size / 4;
  const at = { a: wordOf('a'), b: wordOf('b'), c: wordOf('c'), kind: wordOf('kind'), ids: wordOf('ids') };
  const p = new Float64Array(9);
  const { positions, indices } = mesh;
  for (let triangle = first; triangle < end; triangle++) {
    const row = (base + triangle) * words;
    for (let k = 0; k < 3; k++) {
      const vertex = 3 * (indices[3 * triangle + k] as number);
      transformPoint(
        transform,
        positions[vertex] as number,
        positions[vertex + 1] as number,
        positions[vertex + 2] as number,
        p,
        3 * k,
      );
    }
    for (let k = 0; k < 3; k++) {
      floats[row + at.a + k] = p[k] as number;
      floats[row + at.b + k] = p[3 + k] as number;
      floats[row + at.c + k] = p[6 + k] as number;
    }
    integers[row + at.kind] = kind;
    integers[row + at.ids + 2] = material;
    const ax = (p[3] as number) - (p[0] as number),
      ay = (p[4] as number) - (p[1] as number),
      az = (p[5] as number) - (p[2] as number);
    const bx = (p[6] as number) - (p[0] as number),
      by = (p[7] as number) - (p[1] as number),
      bz = (p[8] as number) - (p[2] as number);
    const nx = ay * bz - az * by,
      ny = az * bx - ax * bz,
      nz = ax * by - ay * bx;
    const length = Math.hypot(nx, ny, nz);
    const area = 0.5 * length;
    const texel = estimate && uvs ? estimate.mean(cornersOf(uvs, indices, triangle)) : 1;
    const power = Math.PI * area * radiance * sides * texel;
    if (!(Number.isFinite(power) && power > 0)) continue;
    const i = base + triangle;
    weights[i] = power;
    bounds.energies[i] = area * radiance * texel;
    bounds.spreads[i] = sides === 2 ? Math.PI : 0;
    bounds.reaches[i] = Math.PI / 2;
    bounds.axes[3 * i] = (mirrored * nx) / length;
    bounds.axes[3 * i + 1] = (mirrored * ny) / length;
    bounds.axes[3 * i + 2] = (mirrored * nz) / length;
    for (let k = 0; k < 3; k++) {
      bounds.bounds[6 * i + k] = Math.min(p[k] as number, p[3 + k] as number, p[6 + k] as number);
      bounds.bounds[6 * i + 3 + k] = Math.max(p[k] as number, p[3 + k] as number, p[6 + k] as number);
    }
  }
}

/**
 * Writes which shapes on the GPU the triangles of an instance are, and their ids.
 *
 * @param base The first one's record.
 * @param count How many there are.
 * @param slot The instance's record.
 * @param leaves Input triangle → absolute leaf-order triangle.
 * @param firstId The first one's id, see `LightIds`.
 */
export function nameTriangles(
  records: ArrayBuffer,
  base: number,
  count: number,
  slot: number,
  leaves: Uint32Array,
  firstId: number,
): void {
  const integers = new Uint32Array(records);
  const words = lightStruct.size / 4;
  for (let triangle = 0, at = base * words + wordOf('ids'); triangle < count; triangle++, at += words) {
    integers[at] = slot;
    integers[at + 1] = leaves[triangle] as number;
    integers[at + 3] = firstId + triangle;
  }
}
