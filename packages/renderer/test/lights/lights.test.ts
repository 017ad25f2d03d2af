import { finish, type Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { NONE, lightStruct } from '../../src/storage/layout';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { lightGroupTable } from '../../src/lights/light-groups';
import { LightIds } from '../../src/lights/light-ids';
import { buildLightTable, lightSteps, placingSteps, type LightGeometry } from '../../src/lights/lights';
import { emittedRadiance } from '../../src/materials/materials';
import { parametersOf } from '../../src/materials/parameters';
import { addQuad, createScene } from '../scenes';

const FLAT = [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Two squares of a metre that glow, one between them that does not, a lamp and a sun. */
function glowing(): Scene {
  const scene = createScene();
  for (const [x, emission_luminance] of [
    [0, 3000],
    [2, 0],
    [4, 1000],
  ] as const) {
    addQuad(
      scene,
      0.5,
      0,
      { name: `glow ${x}`, parameters: { emission_luminance } },
      { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1] },
    );
  }
  scene.lights.push(
    { type: 'point', name: 'lamp', position: [0, 3, 0], color: [1, 1, 1], intensity: 2 },
    { type: 'directional', name: 'sun', direction: [0, -1, 0], color: [1, 0.9, 0.8], intensity: 5 },
  );
  return scene;
}

/** Where the triangles are: each at twice its number in its mesh, 100 a mesh. */
const placesOf = (slots: Uint32Array): LightGeometry => ({
  instanceSlots: slots,
  leafTriangles: (mesh) => Uint32Array.from({ length: 2 }, (_, triangle) => 100 * mesh + 2 * triangle),
});

describe('lights', () => {
  it('gathered before shapes have their places, they are the table that is built after', async () => {
    const scene = glowing();
    const { instanceSlots, radius } = (await prepareGeometry(scene)).placement;
    const groups = lightGroupTable(scene, 'named');
    const places = placesOf(instanceSlots);
    for (const sampling of ['tree', 'power'] as const) {
      const gathered = finish(lightSteps(scene, () => true, groups, sampling));
      const table = finish(placingSteps(scene, gathered, places, radius, new LightIds()))!;
      expect(table).toEqual(buildLightTable(scene, places, radius, groups, sampling, new LightIds()));
      expect(table.count).toBe(6);
      // Two triangles, one that does not glow left out, two more: which shapes they are.
      const ids = [0, 1, 2, 3].map((i) => [
        ...new Uint32Array(table.records, i * lightStruct.size + lightStruct.offsetOf('ids'), 2),
      ]);
      expect(ids).toEqual([
        [instanceSlots[0], 0],
        [instanceSlots[0], 2],
        [instanceSlots[2], 200],
        [instanceSlots[2], 202],
      ]);
      // Each in watts; a sun's are what it sends onto the scene.
      const glow = [0, 2].map((instance) => emittedRadiance(parametersOf(scene.materials[instance]!))[1]! * Math.PI);
      const sun = 5 * (0.2126 + 0.7152 * 0.9 + 0.0722 * 0.8) * Math.PI * radius * radius;
      expect(table.power / (glow[0]! + glow[1]! + 2 * 4 * Math.PI + sun)).toBeCloseTo(1, 6);
    }
  });

  it('emitters without a place are reported, and left out when it is built again', async () => {
    const scene = glowing();
    scene.instances[0]!.transform = FLAT;
    const { instanceSlots, radius } = (await prepareGeometry(scene)).placement;
    expect(instanceSlots[0]).toBe(NONE);
    const groups = lightGroupTable(scene, 'named');
    expect(
      finish(
        placingSteps(
          scene,
          finish(lightSteps(scene, () => true, groups, 'tree')),
          placesOf(instanceSlots),
          radius,
          new LightIds(),
        ),
      ),
    ).toBeUndefined();
    const { count, firstLight } = buildLightTable(
      scene,
      placesOf(instanceSlots),
      radius,
      groups,
      'tree',
      new LightIds(),
    );
    expect([count, ...firstLight]).toEqual([4, NONE, NONE, 0]);
  });
});
