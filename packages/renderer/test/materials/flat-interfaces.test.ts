import type { Material, Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { hasFlatInterfaces } from '../../src/materials/flat-interfaces';
import { addBox, addSphere, createScene, lambert } from '../scenes';

const milk: Material = {
  name: 'milk',
  parameters: {
    transmission_weight: 1,
    transmission_depth: 0.1,
    transmission_scatter: [0.8, 0.8, 0.8],
    specular_roughness: 0,
  },
};

function box(parameters: Material['parameters'] = {}, size = 1): Scene {
  const scene = createScene();
  addBox(scene, [0, 0, 0], [size, size, size], { name: 'milk', parameters: { ...milk.parameters, ...parameters } });
  return scene;
}

/** With the normals of a sphere around its middle. */
function rounded(scene: Scene): Scene {
  const { positions } = scene.meshes[0]!;
  scene.meshes[0] = { ...scene.meshes[0]!, normals: positions.map((x) => (x - 0.5) / Math.sqrt(0.75)) };
  return scene;
}

describe('hasFlatInterfaces', () => {
  it('asks for what scatters light behind a smooth surface', () => {
    expect(hasFlatInterfaces(box())).toBe(true);
    expect(hasFlatInterfaces(box({ transmission_scatter: [0, 0, 0] }))).toBe(false);
    expect(hasFlatInterfaces(box({ specular_roughness: 0.2 }))).toBe(false);
    expect(hasFlatInterfaces(box({ specular_ior: 1 }))).toBe(false);
    expect(hasFlatInterfaces(box({ geometry_thin_walled: true }))).toBe(false);
  });

  it('asks for one shape most of whose triangles are flat, whatever other surfaces are', () => {
    const ball = createScene();
    addSphere(ball, 0.5, [0, 0, 0], milk, 24);
    expect(hasFlatInterfaces(ball)).toBe(false);
    addBox(ball, [0, 0, 0], [9, 9, 9], lambert(0.5));
    expect(hasFlatInterfaces(ball)).toBe(false);
    addBox(ball, [2, 2, 2], [3, 3, 3], milk);
    expect(hasFlatInterfaces(ball)).toBe(true);
  });

  it('tells flat from smooth by a part of the triangles of large meshes', () => {
    const scene = createScene();
    addSphere(scene, 0.5, [0, 0, 0], milk, 240);
    expect(scene.meshes[0]!.indices.length / 3).toBeGreaterThan(30_000);
    expect(hasFlatInterfaces(scene)).toBe(false);
    const { name, positions, indices } = scene.meshes[0]!;
    scene.meshes[0] = { name: name!, positions, indices };
    expect(hasFlatInterfaces(scene)).toBe(true);
  });

  it('takes normals that are the faces’ own for flat, and others for smooth', () => {
    expect(hasFlatInterfaces(rounded(box()))).toBe(false);
    const scene = box();
    const { positions, indices } = scene.meshes[0]!;
    const corners = [...indices!].flatMap((at) => [...positions.subarray(3 * at, 3 * at + 3)]);
    // Faces of a box have one coordinate in common, 0 or 1: the normal's.
    const normals = Array.from({ length: corners.length / 9 }, (_, i) => {
      const [a, b, c] = [0, 3, 6].map((at) => corners.slice(9 * i + at, 9 * i + at + 3)) as [
        number[],
        number[],
        number[],
      ];
      const normal = a.map((x, k) => (x === b[k] && x === c[k] ? 2 * x - 1 : 0));
      return [normal, normal, normal].flat();
    });
    scene.meshes[0] = {
      name: 'box',
      positions: Float32Array.from(corners),
      normals: Float32Array.from(normals.flat()),
      indices: Uint32Array.from(indices!.keys()),
    };
    expect(hasFlatInterfaces(scene)).toBe(true);
  });
});
