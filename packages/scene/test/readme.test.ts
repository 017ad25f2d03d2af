import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import * as api from '../src/index';

it("the README's example runs and finds nothing wrong", () => {
  const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const [, names, code] = /```ts\nimport \{([^}]+)\} from '@glanz\/scene';\n([\s\S]+?)```/.exec(readme) as unknown as [
    string,
    string,
    string,
  ];
  const list = names.split(',').map((name) => name.trim());
  const run = new Function(...list, `${code}; return { scene, warnings };`) as (...args: unknown[]) => {
    scene: api.Scene;
    warnings: api.SceneWarning[];
  };
  const { scene, warnings } = run(...list.map((name) => (api as Record<string, unknown>)[name]));
  expect(warnings).toEqual([]);
  expect(scene.cameras[0]).toMatchObject({ type: 'perspective', aspect: 4 / 3 });
});
