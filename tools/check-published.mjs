// node tools/check-published.mjs — what the registry would get: publint and attw on the tarballs, and the declarations
// as consumers see them, with every module resolution that can read an export map, and the directives that frameworks read.
import { readFileSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { bin, capture } from './pipeline/process.mjs';
import { installPacked } from './pipeline/packed.mjs';
import { Verdicts, runAlone } from './pipeline/report.mjs';
import { entriesOf } from './pipeline/workspace.mjs';

async function lintPackage(p, verdicts) {
  const { publint } = await import('publint');
  const { formatMessage } = await import('publint/utils');
  const bytes = readFileSync(p.tarball);
  const { messages } = await publint({ level: 'warning', pack: { tarball: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) } });
  verdicts.expect(messages.length === 0, `publint ${p.name}: ${messages.map((message) => formatMessage(message, p.manifest)).join('; ')}`);
}

async function checkTypesResolve(p, verdicts) {
  const { code, output } = await capture(process.execPath, [bin('@arethetypeswrong/cli', 'dist/index.js'), p.tarball, '--profile', 'esm-only', '--no-color', '--no-emoji', '-f', 'ascii']);
  verdicts.expect(code === 0, `attw ${p.name}:\n${output.trim()}`);
}

/**
 * Imports every entry from a consumer's file and checks all declarations of ours, not only what the consumer uses.
 * @param {{ name: string, module: string, resolution: string, types: string[] }} variant
 */
async function checkConsumer(variant, { folder, packages }, verdicts) {
  const { default: ts } = await import('typescript');
  const specifiers = packages.flatMap((p) => entriesOf(p).map(({ specifier }) => specifier));
  const file = join(folder, `consumer-${variant.name}.mts`);
  writeFileSync(file, `${specifiers.map((specifier, i) => `import * as entry${i} from '${specifier}';`).join('\n')}\nexport const entries: object[] = [${specifiers.map((_, i) => `entry${i}`).join(', ')}];\n`);
  const { options, errors } = ts.convertCompilerOptionsFromJson(
    { target: 'ES2022', module: variant.module, moduleResolution: variant.resolution, lib: ['ES2023', 'DOM'], types: variant.types, strict: true, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true, verbatimModuleSyntax: true, skipLibCheck: false, noEmit: true },
    folder,
  );
  if (errors.length > 0) throw new Error(ts.formatDiagnostics(errors, host(ts, folder)));
  const program = ts.createProgram([file], options);
  // TypeScript's own DOM declarations and @webgpu/types overlap; only what is ours is judged.
  const ours = program.getSourceFiles().filter(({ fileName }) => fileName.startsWith(folder) && !/node_modules\/(?!@glanz\/[^/]+\/dist\/)/.test(fileName.slice(folder.length)));
  const diagnostics = ours.flatMap((source) => [...program.getSyntacticDiagnostics(source), ...program.getSemanticDiagnostics(source)]);
  verdicts.expect(diagnostics.length === 0, `declarations under ${variant.name}:\n${ts.formatDiagnostics(diagnostics, host(ts, folder)).trim()}`);
  verdicts.table.push(`declarations, ${variant.name}: ${specifiers.length} entries, ${ours.length} files, ${diagnostics.length} errors`);
}

const host = (ts, folder) => ({ getCanonicalFileName: (name) => relative(folder, name), getCurrentDirectory: () => folder, getNewLine: () => ts.sys.newLine });

/** `text` without the blank space and comments that it begins with. */
const pastComments = (text) => text.replace(/^(?:\s+|\/\/.*|\/\*[\s\S]*?\*\/)+/, '');

/**
 * Under server components, files with hooks say that they belong to the client: `'use client'`, before any other statement.
 * Without it `next build` fails with "useRef is not a function".
 */
function checkDirectives(p, { folder }, verdicts) {
  if (!p.manifest.peerDependencies?.react) return;
  for (const { specifier, conditions } of entriesOf(p)) {
    const file = join(folder, 'node_modules', p.name, conditions.default);
    const starts = /^(['"])use client\1\s*;/.test(pastComments(readFileSync(file, 'utf8')));
    verdicts.expect(starts, `${specifier}: ${relative(folder, file)} does not begin with 'use client'.`);
  }
}

export async function checkPublished() {
  const verdicts = new Verdicts();
  const consumer = await installPacked();
  for (const p of consumer.packages) {
    await lintPackage(p, verdicts);
    await checkTypesResolve(p, verdicts);
    checkDirectives(p, consumer, verdicts);
  }
  await checkConsumer({ name: 'nodenext', module: 'NodeNext', resolution: 'NodeNext', types: ['@webgpu/types'] }, consumer, verdicts);
  await checkConsumer({ name: 'bundler', module: 'ESNext', resolution: 'Bundler', types: ['@webgpu/types'] }, consumer, verdicts);
  // The WebGPU types that TypeScript 6 brings itself must do as well.
  await checkConsumer({ name: 'bundler-without-webgpu-types', module: 'ESNext', resolution: 'Bundler', types: [] }, consumer, verdicts);
  return verdicts;
}

await runAlone(import.meta, checkPublished);
