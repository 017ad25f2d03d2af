import type { Mesh, Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { lightGroupTable } from '../../src/lights/light-groups';
import { LightIds, lightIndex } from '../../src/lights/light-ids';
import { buildLightTable, type LightTable } from '../../src/lights/lights';
import { LIGHT_ID_FIRST, lightStruct, NONE } from '../../src/storage/layout';
import { allLights } from '../light-scene';

/** The table of a scene as it is now. */
async function tableOf(scene: Scene, ids: LightIds): Promise<LightTable> {
  const { placement, blas, regions } = await prepareGeometry(scene);
  const leafTriangles = (mesh: number) => {
    const order = new Uint32Array(scene.meshes[mesh]!.indices.length / 3);
    blas[mesh]!.triangleIndices.forEach((input, leaf) => (order[input] = regions[mesh]!.firstTriangle + leaf));
    return order;
  };
  const places = { instanceSlots: placement.instanceSlots, leafTriangles };
  return buildLightTable(scene, places, placement.radius, lightGroupTable(scene, 'named'), 'tree', ids);
}

/** What tells a light from all others: corners of its triangle in the world, or its place and kind. */
const recordOf = ({ records }: LightTable, index: number) => {
  const floats = new Float32Array(records, index * lightStruct.size, lightStruct.size / 4);
  const at = (field: 'a' | 'b' | 'c') => [...floats.subarray(lightStruct.offsetOf(field) / 4).subarray(0, 3)];
  return { a: at('a'), b: at('b'), c: at('c') };
};

/** A triangle of an instance in the world, in single precision. */
function corners(scene: Scene, instance: number, triangle: number): number[][] {
  const { transform, mesh } = scene.instances[instance]!;
  const { positions, indices } = scene.meshes[mesh]!;
  return [0, 1, 2].map((k) => {
    const p = positions.subarray(3 * indices[3 * triangle + k]!);
    return [0, 1, 2].map((row) =>
      Math.fround(
        transform[row]! * p[0]! + transform[4 + row]! * p[1]! + transform[8 + row]! * p[2]! + transform[12 + row]!,
      ),
    );
  });
}

/** A light as the scene has it. */
type Named = { readonly instance: number; readonly triangle: number } | { readonly light: number };

/** Finds the lights of a table in the scene by where they are; those that lie where another does have no name. */
function named(scene: Scene, table: LightTable, ids: LightIds): Map<number, Named> {
  const places = new Map<string, Named[]>();
  const put = (place: unknown, name: Named) => {
    const key = JSON.stringify(place);
    places.set(key, [...(places.get(key) ?? []), name]);
  };
  scene.instances.forEach(({ mesh }, instance) => {
    for (let triangle = 0; triangle < scene.meshes[mesh]!.indices.length / 3; triangle++)
      put(corners(scene, instance, triangle), { instance, triangle });
  });
  // A rectangle begins at a corner, which is no name of its own.
  scene.lights.forEach((light, i) => {
    if (light.type !== 'rectangle')
      put('position' in light ? light.position.map(Math.fround) : [0, 0, 0], { light: i });
  });
  const index = lightIndex(table, ids.end);
  const found = new Map<number, Named>();
  for (let id = LIGHT_ID_FIRST; id < index.length; id++) {
    if (index[id] === NONE) continue;
    const { a, b, c } = recordOf(table, index[id]!);
    const names = places.get(JSON.stringify([a, b, c])) ?? places.get(JSON.stringify(a)) ?? [];
    if (names.length === 1) found.set(id, names[0]!);
  }
  return found;
}

const tetrahedron: Mesh = {
  name: 'tetrahedron',
  positions: new Float32Array([0, 0, 0, 0.3, 0, 0, 0, 0.3, 0, 0, 0, 0.3]),
  indices: new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]),
};

describe('ids of lights', () => {
  it('name the same light or triangle before and after edits', async () => {
    const scene = allLights();
    const ids = new LightIds();
    const original = await tableOf(scene, ids);
    const before = named(scene, original, ids);
    // All but the rectangle: 6 lights, and triangles of four instances.
    const triangles = [1, 2, 3, 4].reduce(
      (sum, i) => sum + scene.meshes[scene.instances[i]!.mesh]!.indices.length / 3,
      0,
    );
    // A sphere has triangles without area at its poles, two of which are one place.
    expect(before.size).toBeGreaterThanOrEqual(6 + triangles - 16);

    const ball = scene.meshes[scene.instances[4]!.mesh]!;
    const edits: readonly (() => void)[] = [
      // The floor glows: its triangles come before all others.
      () => (scene.materials[scene.instances[0]!.material]!.parameters = { emission_luminance: 10 }),
      () =>
        (scene.instances[1] = {
          ...scene.instances[1]!,
          transform: Array.from(scene.instances[1]!.transform).map((x, i) => (i === 12 ? x + 0.25 : x)),
        }),
      () => (scene.instances[2] = { ...scene.instances[2]!, visible: false }),
      () => (scene.lights[0] = { ...scene.lights[0]!, position: [0.1, 0.2, 3] } as Scene['lights'][number]),
      () => (scene.materials[scene.instances[3]!.material]!.parameters = { emission_luminance: 0 }),
      () => (scene.meshes[scene.instances[4]!.mesh] = tetrahedron),
      () => (scene.instances[2] = { ...scene.instances[2]!, visible: true }),
      () => (scene.materials[scene.instances[0]!.material]!.parameters = {}),
      () => (scene.meshes[scene.instances[4]!.mesh] = ball),
      () => (scene.materials[scene.instances[3]!.material]!.parameters = { emission_luminance: 5 }),
    ];
    const known = new Map(before);
    for (const [step, edit] of edits.entries()) {
      edit();
      const after = named(scene, await tableOf(scene, ids), ids);
      for (const [id, name] of after) {
        // Of the mesh that takes the ball's place the triangles are others, with other ids.
        if ('instance' in name && name.instance === 4 && scene.meshes[scene.instances[4]!.mesh] === tetrahedron) {
          expect(known.has(id), `edit ${step}`).toBe(false);
          continue;
        }
        expect(known.get(id) ?? name, `id ${id} after edit ${step}`).toEqual(name);
        known.set(id, name);
      }
    }
    // All are back.
    const index = lightIndex(await tableOf(scene, ids), ids.end);
    for (const [id] of before) expect(index[id]).not.toBe(NONE);
    expect(ids.generation).toBe(0);
  });

  it('of lights that have gone dark name no record', async () => {
    const scene = allLights();
    const ids = new LightIds();
    const before = named(scene, await tableOf(scene, ids), ids);
    scene.instances[2] = { ...scene.instances[2]!, visible: false };
    const index = lightIndex(await tableOf(scene, ids), ids.end);
    for (const [id, name] of before) expect(index[id] === NONE).toBe('instance' in name && name.instance === 2);
  });

  it('are given out again, as another generation, before those of meshes that are gone become many', () => {
    const ids = new LightIds();
    let renewed = 0;
    for (let triangles = 1000; triangles < 3000; triangles++) {
      ids.begin(triangles);
      if (ids.generation > renewed) {
        renewed++;
        expect(ids.end).toBe(LIGHT_ID_FIRST);
      }
      ids.ofTriangles(0, triangles);
      expect(ids.end).toBeLessThan((1 << 20) + 5 * triangles + 2);
    }
    expect(renewed).toBeGreaterThan(0);
  });
});
