import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { findModels, type Model } from './models';
import { assetsMarkdown, html, montage } from './page';
import { openRenderer, type Row } from './render';

/** Renders a folder of models into one page. Returns the exit status. */
export async function contactSheet(argv: readonly string[]): Promise<number> {
  const { values, positionals } = parseArgs({
    args: [...argv],
    allowPositionals: true,
    options: {
      size: { type: 'string', default: '96' },
      samples: { type: 'string', default: '16' },
      only: { type: 'string', multiple: true },
      gpu: { type: 'string' },
      out: { type: 'string', default: 'out/contact-sheet' },
      pages: { type: 'string' },
      fresh: { type: 'boolean', default: false },
    },
  });
  const folder = resolve(positionals[0] ?? '../shared/assets');
  const size = Number(values.size),
    samples = Number(values.samples);
  if (!(size >= 8 && size <= 2048 && samples >= 1)) {
    process.stderr.write('contact-sheet: --size must be from 8 to 2048, --samples at least 1.\n');
    return 2;
  }
  const models = findModels(folder).filter(
    ({ name }) => !values.only || values.only.some((part) => name.includes(part)),
  );
  if (models.length === 0) {
    process.stderr.write(`contact-sheet: there are no models in ${folder}.\n`);
    return 2;
  }
  const out = resolve(values.out);
  mkdirSync(join(out, 'images'), { recursive: true });
  const rows: Row[] = [];
  let renderer: Awaited<ReturnType<typeof openRenderer>> | undefined;
  for (const [index, model] of models.entries()) {
    const cached = values.fresh ? undefined : known(out, model, size, samples);
    if (cached) rows.push(cached);
    else {
      renderer ??= await openRenderer({ size, samples, ...(values.gpu === undefined ? {} : { gpu: values.gpu }) });
      const { row, png } = await renderer.render(model);
      if (png) writeFileSync(join(out, 'images', `${model.id}.png`), png);
      writeFileSync(join(out, 'images', `${model.id}.json`), JSON.stringify({ size, samples, row }));
      rows.push(row);
    }
    const row = rows.at(-1) as Row;
    process.stderr.write(
      `${index + 1}/${models.length} ${row.name}: ${row.error ?? `${row.warnings.length} warnings`} (${Math.round(row.loadMs)} + ${Math.round(row.prepareMs)} + ${Math.round(row.renderMs)} ms)\n`,
    );
  }
  renderer?.close();
  writeFileSync(join(out, 'sheet.json'), `${JSON.stringify(rows, null, 1)}\n`);
  writeFileSync(join(out, 'index.html'), html(rows, size, samples));
  writeFileSync(join(out, 'sheet.png'), await montage(rows, join(out, 'images'), size));
  if (values.pages !== undefined)
    writeFileSync(join(resolve(values.pages), 'assets.md'), assetsMarkdown(rows, size, samples));
  const failed = rows.filter(({ error }) => error !== undefined);
  process.stderr.write(
    `${join(out, 'index.html')}: ${rows.length} models, ${failed.length} failed, ${rows.filter(({ warnings }) => warnings.length > 0).length} with warnings.\n`,
  );
  return failed.length > 0 ? 1 : 0;
}

/** What an earlier run has found, if it looked at the same file in the same way. */
function known(out: string, model: Model, size: number, samples: number): Row | undefined {
  const file = join(out, 'images', `${model.id}.json`);
  if (!existsSync(file)) return undefined;
  const saved = JSON.parse(readFileSync(file, 'utf8')) as { size: number; samples: number; row: Row };
  return saved.size === size && saved.samples === samples && saved.row.error === undefined ? saved.row : undefined;
}
