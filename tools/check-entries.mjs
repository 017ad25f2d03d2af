// node tools/check-entries.mjs — importing any published entry in bare Node does nothing: no output, no globals, no
// handle that keeps the process alive, no failure without a GPU or an optional dependency.
import { rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { capture } from './pipeline/process.mjs';
import { installPacked } from './pipeline/packed.mjs';
import { Verdicts, columns, runAlone } from './pipeline/report.mjs';
import { entriesOf } from './pipeline/workspace.mjs';

/** Prints what an import changed, as JSON, and must then end by itself. */
const PROBE = `
const [, , specifier] = process.argv;
const describe = () => {
  const listeners = process.eventNames().map((name) => [String(name), process.listenerCount(name)]);
  return { globals: Reflect.ownKeys(globalThis).map(String), env: Object.keys(process.env), listeners, prototypes: [Object, Array, Function, Promise].flatMap((c) => Reflect.ownKeys(c.prototype).map(String)) };
};
const before = describe();
const from = performance.now();
const module = await import(specifier);
const ms = performance.now() - from;
const after = describe();
const added = {};
for (const key of Object.keys(before)) {
  const known = new Set(before[key].map(String));
  const fresh = after[key].map(String).filter((item) => !known.has(item));
  if (fresh.length > 0) added[key] = fresh;
}
await new Promise((resolve) => setTimeout(resolve, 0));
process.stdout.write('\\u0001' + JSON.stringify({ added, ms, exports: Object.keys(module).length, handles: process.getActiveResourcesInfo().filter((name) => !/^(TTYWrap|PipeWrap|Immediate|Timeout)$/.test(name)) }));
`;

export async function checkEntries() {
  const verdicts = new Verdicts();
  const { folder, packages } = await installPacked();
  const probe = join(folder, 'probe.mjs');
  writeFileSync(probe, PROBE);
  const rows = [];
  for (const { specifier } of packages.flatMap(entriesOf)) {
    const { code, output } = await capture(process.execPath, [probe, specifier], { cwd: folder, timeoutMs: 20_000 });
    const [printed = '', report] = output.split('\u0001');
    if (
      !verdicts.expect(
        code === 0 && report !== undefined,
        `import '${specifier}' failed with code ${code}: ${output.trim().split('\n').slice(0, 6).join(' ')}`,
      )
    )
      continue;
    const { added, ms, exports, handles } = JSON.parse(report);
    const faults = [
      printed.trim() === '' ? '' : `printed ${JSON.stringify(printed.slice(0, 200))}`,
      ...Object.entries(added).map(([what, names]) => `added ${what} ${names.join(', ')}`),
      handles.length > 0 ? `left ${handles.join(', ')} open` : '',
    ].filter(Boolean);
    verdicts.expect(faults.length === 0, `import '${specifier}' ${faults.join('; ')}.`);
    verdicts.expect(exports > 0, `${specifier} exports nothing.`);
    rows.push([specifier, String(exports), ms.toFixed(0)]);
  }
  rmSync(probe, { force: true });
  verdicts.table.push(...columns([['entry', 'exports', 'ms'], ...rows], [1, 2]));
  return verdicts;
}

await runAlone(import.meta, checkEntries);
