import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import * as gltf from '../src/index';
import { spoiled } from './build';

const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');

test("the README's example runs as it stands", async () => {
  const [, names = '', body = ''] =
    /```ts\nimport \{ ([^}]*) \} from '@glanz\/gltf';\n([\s\S]*?)```/.exec(readme) ?? [];
  const lines: unknown[][] = [];
  const console = { log: (...line: unknown[]) => lines.push(line), warn: (...line: unknown[]) => lines.push(line) };
  // The example is plain JavaScript; it becomes the body of a function whose parameters are its imports.
  const run = new Function(
    'gltf',
    'input',
    'console',
    `return (async () => { const { ${names} } = gltf;\n${body}\nreturn scene; })();`,
  ) as (...args: unknown[]) => Promise<{ instances: unknown[] }>;
  const input = spoiled((json) => {
    json['meshes'][0].primitives.push({ ...json['meshes'][0].primitives[0], mode: 1 });
  });
  expect((await run(gltf, input, console)).instances.length).toBe(1);
  expect(lines).toEqual([['read', 1], ['decode', 1], ['node 1: points and lines are left out. [gltf/primitive]']]);
});

test('the README names every code of the errors, and no other', () => {
  const codes = (text: string) => new Set(text.match(/gltf\/[a-z0-9]+(-[a-z]+)*/g));
  const documented = /thrown as a `GltfError`:(.*)/.exec(readme)![1]!;
  const errors = readFileSync(new URL('../src/error.ts', import.meta.url), 'utf8');
  expect(codes(documented)).toEqual(codes(errors));
});
