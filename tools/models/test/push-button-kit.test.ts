import { describe, expect, it } from 'vitest';
import { createPushButtonKit, PUSH_BUTTON_KIT } from '../src/index';
import { inspect } from './solids';

describe.each(['low', 'medium'] as const)('push-button kit, level %s', (level) => {
  const scene = createPushButtonKit({ level });

  it('is made of closed solids that face outwards, with normals on the side of the triangles', () => {
    for (const mesh of scene.meshes) {
      const { openEdges, volume, worstNormal } = inspect(mesh);
      expect({ part: mesh.name, openEdges }).toEqual({ part: mesh.name, openEdges: 0 });
      expect(volume, mesh.name).toBeGreaterThan(0);
      expect(worstNormal, mesh.name).toBeGreaterThan(0);
    }
  });

  it('has every part that it names, once', () => {
    const names = scene.instances.map(({ name }) => name);
    expect(new Set(names).size).toBe(names.length);
    const { lenses, legends, bezels, mountings, blocks } = PUSH_BUTTON_KIT;
    const listed = [
      ...Object.keys(lenses).map((name) => `Lens ${name}`),
      ...legends.map((name) => `Legend ${name}`),
      ...bezels.map((name) => `Bezel ${name}`),
      ...Object.values(mountings).flat(),
      ...Object.values(blocks).flat(),
    ];
    expect(listed.filter((name) => !names.includes(name))).toEqual([]);
    expect(
      Object.values(PUSH_BUTTON_KIT.materials).filter(
        (name) => !scene.materials.some((material) => material.name === name),
      ),
    ).toEqual([]);
  });

  it('legends lie on the faces of the lenses: the axis leaves each lens at the height that is given', () => {
    for (const [name, face] of Object.entries(PUSH_BUTTON_KIT.lenses)) {
      const mesh = scene.meshes[scene.instances.find((instance) => instance.name === `Lens ${name}`)!.mesh]!;
      let top = -Infinity;
      for (let i = 0; i < mesh.positions.length; i += 3)
        if (Math.hypot(mesh.positions[i]!, mesh.positions[i + 1]!) < 1e-9) top = Math.max(top, mesh.positions[i + 2]!);
      expect(top, name).toBeCloseTo(face, 6);
    }
  });
});
