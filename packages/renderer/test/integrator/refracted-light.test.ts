import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { kernelSource } from '../../src/integrator/pipelines';
import { MESH_NORMALS } from '../../src/storage/layout';

it('its shader knows where a mesh has its normals', () => {
  const file = new URL('../../src/lights/refracted/refracted_way.wesl', import.meta.url);
  expect(readFileSync(file, 'utf8')).toContain(`const REFRACTED_NORMALS = ${MESH_NORMALS}u;`);
});

it('kernels of other scenes have no text for it', () => {
  const names = ['renderer', 'openpbr', 'bvh'].flatMap((name) => {
    const src = new URL(`../../../${name}/src/`, import.meta.url);
    return readdirSync(src, { recursive: true, encoding: 'utf8' })
      .filter((file) => file.endsWith('.wesl'))
      .flatMap((file) => [...readFileSync(new URL(file, src), 'utf8').matchAll(/@(?:if|elif)\(([^)]*)\)/g)])
      .flatMap(([, condition]) => condition!.match(/\w+/g)!);
  });
  const scene = ['MEDIA', 'SCATTERING', 'PATH_DEPTH', 'NULL_SURFACES', 'LIGHTS', 'NEXT_EVENT', 'AREA_LIGHTS'];
  const text = (...more: string[]) => {
    const on = new Set([...scene, ...more]);
    const flags = Object.fromEntries([...names, 'TEXTURES'].map((name) => [name, on.has(name)]));
    const features = { flags, samplings: [], textured: [], textureCount: 0, samplerCount: 0, lightPasses: 1 };
    return (['intersect', 'shade', 'connect', 'generate'] as const).map((name) => kernelSource(name, features).key);
  };
  expect(text().join()).not.toMatch(/refracted_|path_(set_)?(refracted|scattered)\(/);
  expect(text('REFRACTED_LIGHT').join()).toMatch(/refracted_walked/);
});
