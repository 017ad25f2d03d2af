// Declarations of a package, before they are bundled.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join, relative } from 'node:path';
import { bin, root } from './process.mjs';

/**
 * Checks the sources of a package and emits their declarations, one file each, to `.cache/types`. The native compiler
 * does in a second what takes the bundler of declarations, which runs TypeScript in JavaScript, a dozen: that one reads
 * declarations only.
 *
 * @param {string} folder The package's.
 * @param {Readonly<Record<string, string>>} entries Source files by the name of their output, from `src/` on.
 * @returns {Record<string, string>} The declarations of these sources, by the same names; relative to `folder`.
 */
export function emitDeclarations(folder, entries) {
  const out = join(root, '.cache', 'types', basename(folder));
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const config = join(out, 'tsconfig.json');
  const options = {
    extends: join(root, 'tsconfig.base.json'),
    compilerOptions: {
      declaration: true,
      emitDeclarationOnly: true,
      noEmit: false,
      outDir: '.',
      rootDir: join(folder, 'src'),
      // Not "@glanz/source": published declarations point at published packages.
      customConditions: [],
      types: ['@webgpu/types', 'node'],
    },
    files: Object.values(entries).map((source) => join(folder, source)),
    // What imports of shader sources, of gl-matrix's modules and of packages without declarations are.
    include: [join(root, 'wesl.d.ts'), join(root, 'gl-matrix.d.ts'), join(folder, 'src/**/*.d.ts')],
  };
  writeFileSync(config, JSON.stringify(options));
  const { status, stdout, stderr, error } = spawnSync(
    process.execPath,
    [bin('typescript-native', 'bin/tsc'), '-p', config],
    { cwd: folder, encoding: 'utf8' },
  );
  if (status !== 0) throw new Error(`${stdout}${stderr}${error?.message ?? ''}`.trim());
  // The compiler reads declarations that stand among the sources, and does not copy them.
  for (const file of readdirSync(join(folder, 'src'), { recursive: true, encoding: 'utf8' }))
    if (file.endsWith('.d.ts')) cpSync(join(folder, 'src', file), join(out, file));
  return Object.fromEntries(
    Object.entries(entries).map(([name, source]) => [
      name,
      relative(folder, join(out, source.replace(/^src\//, '').replace(/\.tsx?$/, '.d.ts'))),
    ]),
  );
}
