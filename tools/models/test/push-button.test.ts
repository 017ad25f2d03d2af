import { describe, expect, it } from 'vitest';
import { createPushButton, type PushButtonLevel } from '../src/index';
import type { PerspectiveCamera } from '@glanz/scene';
import { inspect } from './solids';

const EXPECTED: Record<PushButtonLevel, number> = { high: 1_068_735, medium: 106_873, low: 10_687 };

describe.each(Object.entries(EXPECTED) as [PushButtonLevel, number][])('push-button, level %s', (level, expected) => {
  const scene = createPushButton({ level });

  it(`stores ${expected} triangles within 1 %, each used once`, () => {
    const triangles = scene.meshes.reduce((sum, mesh) => sum + mesh.indices.length / 3, 0);
    expect(Math.abs(triangles - expected) / expected).toBeLessThan(0.01);
    expect(scene.instances.map((instance) => instance.mesh)).toEqual(scene.meshes.map((_, i) => i));
  });

  it('has finite vertices, unit normals and indices in range', () => {
    for (const mesh of scene.meshes) {
      expect(mesh.positions.every(Number.isFinite), mesh.name).toBe(true);
      expect(mesh.normals!.length).toBe(mesh.positions.length);
      let worst = 0;
      for (let i = 0; i < mesh.normals!.length; i += 3)
        worst = Math.max(
          worst,
          Math.abs(Math.hypot(mesh.normals![i]!, mesh.normals![i + 1]!, mesh.normals![i + 2]!) - 1),
        );
      expect(worst, mesh.name).toBeLessThan(1e-6);
      expect(mesh.indices.reduce((max, index) => Math.max(max, index), 0)).toBeLessThan(mesh.positions.length / 3);
    }
  });

  it('is made of closed solids that face outwards, with normals on the side of the triangles', () => {
    for (const mesh of scene.meshes) {
      const { openEdges, volume, worstNormal, flat, triangles } = inspect(mesh);
      expect({ part: mesh.name, openEdges }).toEqual({ part: mesh.name, openEdges: 0 });
      expect(volume, mesh.name).toBeGreaterThan(0);
      expect(worstNormal, mesh.name).toBeGreaterThan(0);
      expect(flat / triangles, mesh.name).toBeLessThan(0.02);
    }
  });

  it('names every part, once', () => {
    const names = scene.instances.map((instance) => instance.name);
    expect(new Set(names).size).toBe(names.length);
    for (const part of [
      'Bezel ring',
      'Lens',
      'Light ring',
      'Housing barrel',
      'Collar nut',
      'Mounting plate',
      'Plate screw 1',
      'Contact block NO body',
      'Contact block NO terminal top plate',
    ])
      expect(names).toContain(part);
  });

  it('has the size of the real thing, and a camera that sees all of it', () => {
    const { transform, yfov } = scene.cameras[0] as PerspectiveCamera & { transform: number[] };
    const limit = Math.tan(yfov / 2);
    const [low, high] = [
      [1, 1, 1],
      [-1, -1, -1],
    ];
    let furthest = 0;
    for (const { mesh, transform: m } of scene.instances) {
      const { positions } = scene.meshes[mesh]!;
      for (let i = 0; i < positions.length; i += 3) {
        const [x, y, z] = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
        const world = [0, 1, 2].map((k) => m[k]! * x + m[4 + k]! * y + m[8 + k]! * z + m[12 + k]!);
        for (let k = 0; k < 3; k++) {
          low[k] = Math.min(low[k]!, world[k]!);
          high[k] = Math.max(high[k]!, world[k]!);
        }
        const d = world.map((value, k) => value - transform[12 + k]!);
        const [right, up, back] = [0, 4, 8].map(
          (column) => d[0]! * transform[column]! + d[1]! * transform[column + 1]! + d[2]! * transform[column + 2]!,
        ) as [number, number, number];
        furthest = Math.max(furthest, Math.abs(right / back), Math.abs(up / back));
      }
    }
    for (let k = 0; k < 3; k++) {
      expect(high[k]! - low[k]!).toBeGreaterThan(0.045);
      expect(high[k]! - low[k]!).toBeLessThan(0.09);
    }
    expect(furthest).toBeLessThan(limit);
    expect(furthest).toBeGreaterThan(0.7 * limit);
  });
});
