import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import {
  bindingsOf,
  KERNELS,
  kernelSource,
  type KernelFeatures,
  type KernelName,
} from '../../src/integrator/pipelines';
import type { KernelBindings } from '../../src/storage/resources';
import { random } from '../tree-lights';

/** What WebGPU offers everywhere: `maxStorageBuffersPerShaderStage`, `maxUniformBuffersPerShaderStage`. */
const STORAGE_BUFFERS = 8;
const UNIFORM_BUFFERS = 12;

const features = (flags: Record<string, boolean>, lightPasses = 1): KernelFeatures => ({
  flags,
  samplings: [],
  textured: [],
  textureCount: 0,
  samplerCount: 0,
  lightPasses,
});

/** Flags that decide what kernels bind: all that the files name which choose resources. */
const source = ['integrator/pipelines.ts', 'film/aovs.ts'].map((file) =>
  readFileSync(new URL(`../../src/${file}`, import.meta.url), 'utf8'),
);
const names = [
  ...new Set(
    source.flatMap((text) => [...text.matchAll(/(?:[fF]lags|chosen)\.([A-Z][A-Z_]+)/g)].map(([, name]) => name!)),
  ),
].filter((name) => name !== 'TEXTURES');

const countOf = (groups: KernelBindings, ...spaces: string[]) =>
  groups.flatMap(({ bindings }) => bindings).filter(({ space }) => spaces.includes(space)).length;

/** All flags that shaders name. */
const shaders = ['renderer', 'openpbr', 'bvh'].flatMap((name) => {
  const src = new URL(`../../../${name}/src/`, import.meta.url);
  return readdirSync(src, { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.wesl'))
    .map((file) => readFileSync(new URL(file, src), 'utf8'));
});
const all = new Set([
  ...names,
  ...shaders.flatMap((text) =>
    [...text.matchAll(/@(?:if|elif)\(([^)]*)\)/g)].flatMap(([, condition]) => condition!.match(/\w+/g)!),
  ),
]);

/** The flags that a kernel's bindings depend on: those that change them in one of many sets of the others. */
function decisive(kernel: KernelName): string[] {
  const next = random(7);
  const found = new Set<string>();
  for (let i = 0; i < 200; i++) {
    const flags = Object.fromEntries(names.map((name) => [name, next() < 0.5]));
    const before = JSON.stringify(bindingsOf(kernel, features(flags)));
    for (const name of names)
      if (
        !found.has(name) &&
        JSON.stringify(bindingsOf(kernel, features({ ...flags, [name]: !flags[name] }))) !== before
      )
        found.add(name);
  }
  return [...found];
}

it('no kernel binds more buffers than every browser offers, whatever flags are set', () => {
  expect(names).toEqual(expect.arrayContaining(['OPACITY', 'AREA_LIGHTS', 'MEDIA', 'NULL_SURFACES', 'AOVS']));
  const counts = KERNELS.map((kernel) => {
    const switches = decisive(kernel);
    let max = 0;
    for (let bits = 0; bits < 2 ** switches.length; bits++) {
      const flags = Object.fromEntries(switches.map((name, i) => [name, ((bits >> i) & 1) === 1]));
      const groups = bindingsOf(kernel, features(flags));
      const count = countOf(groups, 'read', 'read_write');
      max = Math.max(max, count);
      if (count > STORAGE_BUFFERS || countOf(groups, 'uniform') > UNIFORM_BUFFERS)
        expect.fail(`${kernel} binds ${count} storage buffers with ${JSON.stringify(flags)}`);
    }
    return max;
  });
  // The limit is reached: where one more is needed, another must go.
  expect(Math.max(...counts)).toBe(STORAGE_BUFFERS);
});

it('the text of each kernel declares what is bound, and binds a resource under one number in all kernels', () => {
  const places = new Map<string, string>();
  for (const kernel of KERNELS) {
    for (const on of [false, true]) {
      const scene = features(Object.fromEntries([...all].map((name) => [name, on])));
      const declared = [
        ...kernelSource(kernel, scene, {}, on).key.matchAll(
          /@group\((\d)\) *@binding\((\d+)\) *var(?:<(\w+)[^>]*>)? *(\w+)/g,
        ),
      ];
      const bound = bindingsOf(kernel, scene);
      expect(declared.filter(([, , , space]) => space === 'storage')).toHaveLength(
        countOf(bound, 'read', 'read_write'),
      );
      expect(declared).toHaveLength(bound.flatMap(({ bindings }) => bindings).length);
      for (const [, group, binding, , name] of declared) {
        const place = `${group} ${binding}`;
        expect(places.get(name!) ?? place, name).toBe(place);
        places.set(name!, place);
      }
    }
  }
  expect(new Set(places.values()).size).toBe(places.size);
});
