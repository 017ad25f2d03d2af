import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, describe, expect, it } from 'vitest';
import { compileWesl, parseWesl } from '../wesl.mjs';
import { shortenLocals } from '../wesl-names.mjs';
import { shortenPrivate } from '../wesl-private.mjs';

const made: string[] = [];
afterAll(() => made.forEach((folder) => rmSync(folder, { recursive: true })));

/** Writes a workspace of some files; gives one of them with short names. */
function shortened(files: Readonly<Record<string, string>>, name = 'packages/light/src/sky.wesl'): string {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-wesl-'));
  made.push(folder);
  writeFileSync(join(folder, 'pnpm-workspace.yaml'), '');
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), text);
  }
  let result = files[name]!;
  const { tokens } = parseWesl(result);
  const edits = shortenPrivate(tokens, join(folder, name), join(folder, 'packages/light'), shortenLocals(tokens));
  for (const { from, to, text } of edits.sort((a, b) => b.from - a.from))
    result = result.slice(0, from) + text + result.slice(to);
  return result;
}

describe('names that no other file has', () => {
  it('are short: functions, structs, constants, private variables', () => {
    expect(
      shortened({
        'packages/light/src/sky.wesl':
          'struct SkyPlace { sun: f32 } const SKY_HEIGHT = 2.0; var<private> sky_seed: u32; fn sky_place(u: f32) -> SkyPlace { sky_seed += 1u; return SkyPlace(u * SKY_HEIGHT); } fn main() { _ = sky_place(1.0); }',
        'packages/light/src/lamp.wesl': 'fn lamp() {}',
      }),
    ).toBe(
      'struct li1B { sun: f32 } const li1A = 2.0; var<private> li1E: u32; fn li1D(u: f32) -> li1B { li1E += 1u; return li1B(u * li1A); } fn main() { _ = li1D(1.0); }',
    );
  });

  it('stay where another shader, a host, a page or an example has them, and so do bindings', () => {
    const sky =
      '@group(0) @binding(0) var<storage> sky_table: array<f32>; fn sky_imported() {} fn sky_given() {} fn sky_named() {} fn sky_shown() {} fn sky_used() {} fn sky_drawn() {}';
    expect(
      shortened({
        'packages/light/src/sky.wesl': sky,
        'packages/light/src/lamp.wesl': 'import package::sky::sky_imported;',
        'packages/other/src/host.wesl': 'fn sky_given() {}',
        'packages/light/src/pipelines.ts': "export const ENTRY = 'sky_named';",
        'apps/docs/guide/shaders.md': '`sky_shown` is public',
        'apps/docs/examples/sky.vue': '<script>const wgsl = `sky_used()`</script>',
        'tools/show/sky.mjs': 'sky_drawn',
      }),
    ).toBe(sky);
  });

  it('stay where a member, a parameter or a local variable is called the same', () => {
    const sky =
      'fn sky_width() {} fn sky_height() {} fn sky_depth() {} struct S { sky_width: f32 } fn f(sky_height: f32) { let sky_depth = 1.0; g(sky_height + sky_depth); }';
    expect(shortened({ 'packages/light/src/sky.wesl': sky })).toContain(
      'fn sky_width() {} fn sky_height() {} fn sky_depth() {}',
    );
  });
});

describe('what is published of the workspace', () => {
  const root = fileURLToPath(new URL('../../..', import.meta.url));
  const text = (path: string, shrink: boolean) =>
    compileWesl(readFileSync(join(root, path), 'utf8'), join(root, path), { shrink }).code;

  it('has no name twice, and none that is in a source', () => {
    const files = execFileSync('git', ['ls-files', 'packages/*/src/**.wesl'], { cwd: root, encoding: 'utf8' })
      .trim()
      .split('\n');
    const sources = new Set<string>();
    const given = new Map<string, string>();
    for (const path of files) {
      const { tokens } = parseWesl(readFileSync(join(root, path), 'utf8'));
      for (const { text: token } of tokens) sources.add(token);
      const folder = join(root, path.split('/src/')[0]!);
      for (const { from, text: short } of shortenPrivate(tokens, join(root, path), folder, shortenLocals(tokens))) {
        const name = `${path}: ${tokens.find((token) => token.from === from)!.text}`;
        expect(given.get(short) ?? name).toBe(name);
        given.set(short, name);
      }
    }
    expect(given.size).toBeGreaterThan(100);
    expect([...given.keys()].filter((short) => sources.has(short))).toEqual([]);
  });

  it('has short names, and those that are imported or documented', () => {
    const path = 'packages/renderer/src/environment/environment.wesl';
    expect(text(path, false)).toContain('fn environment_cell(');
    expect(text(path, true)).not.toContain('environment_cell(');
    expect(text(path, true)).toContain('fn environment_sample(');
    expect(text('packages/openpbr/src/wgsl/bsdf.wesl', true)).toContain('fn openpbr_eval_pdf(');
  });
});
