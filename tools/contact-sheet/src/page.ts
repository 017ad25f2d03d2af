import { existsSync } from 'node:fs';
import { join } from 'node:path';
import sharp from 'sharp';
import { NOTES } from './notes';
import type { Row } from './render';

const escape = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** The page: images first, then warnings and errors of each model. */
export function html(rows: readonly Row[], size: number, samples: number): string {
  const reported = rows.filter(
    ({ error, warnings, badSamples }) => error !== undefined || warnings.length > 0 || badSamples > 0,
  );
  const cell = ({ id, name, note, error, warnings, triangles }: Row) =>
    `<figure class="${error === undefined ? (warnings.length > 0 ? 'warned' : '') : 'failed'}"><a href="#${escape(id)}">${error === undefined ? `<img src="images/${escape(id)}.png" width="${size}" height="${size}" alt="">` : '<div></div>'}</a><figcaption title="${escape(note)}${NOTES[name] ? ` — ${escape(NOTES[name])}` : ''}">${escape(name)}<br><small>${triangles.toLocaleString('en')} triangles</small></figcaption></figure>`;
  const entry = ({ id, name, error, warnings, badSamples }: Row) =>
    `<h3 id="${escape(id)}">${escape(name)}</h3><ul>${error === undefined ? '' : `<li class="failed">${escape(error)}</li>`}${badSamples > 0 ? `<li>${badSamples} samples were NaN or infinite</li>` : ''}${warnings.map((warning) => `<li>${escape(warning)}</li>`).join('')}</ul>`;
  return `<!doctype html><meta charset="utf-8"><title>Contact sheet</title>
<style>body{font:13px system-ui;margin:16px;background:#1b1c1e;color:#ddd}main{display:flex;flex-wrap:wrap;gap:8px}figure{margin:0;width:${Math.max(size, 110)}px;overflow-wrap:anywhere}figure div{width:${size}px;height:${size}px;background:#511}.failed{color:#f77}.warned figcaption{color:#fc6}img{image-rendering:pixelated}a{color:inherit}</style>
<h1>${rows.length} models</h1><p>${size} × ${size}, ${samples} samples. ${rows.filter(({ error }) => error !== undefined).length} failed, ${reported.length} with warnings or errors.</p>
<main>${rows.map(cell).join('\n')}</main>
<h2>Warnings and errors</h2>${reported.map(entry).join('\n')}
`;
}

/** Summary of warnings: each kind once, with its count. */
function summary(warnings: readonly string[]): string {
  const kinds = new Map<string, number>();
  for (const warning of warnings) {
    const code = /\[([\w/-]+)\]$/.exec(warning)?.[1] ?? warning;
    kinds.set(code, (kinds.get(code) ?? 0) + 1);
  }
  return [...kinds].map(([code, count]) => `${count} × \`${code}\``).join(', ');
}

/** The page of the documentation: a table without images, since many models' licences forbid them. */
export function assetsMarkdown(rows: readonly Row[], size: number, samples: number): string {
  const reported = rows.filter(({ warnings, badSamples }) => warnings.length > 0 || badSamples > 0);
  const failed = rows.filter(({ error }) => error !== undefined);
  const cell = (text: string) => text.replaceAll('|', '\\|').replace(/\s+/g, ' ');
  return [
    '# Test models',
    '',
    `${rows.length} real models, most of them Khronos samples, each loaded with \`loadGltfFile\`, framed from the front right in the neutral studio, and rendered at ${size} × ${size} with ${samples} samples on a software GPU: **${failed.length} failed, ${rows.filter(({ badSamples }) => badSamples > 0).length} with NaN or infinite samples, ${reported.length} with warnings**. The models are not part of the project, and many of their licences do not allow images of them here. \`npm run contact-sheet -- FOLDER\` renders a contact sheet of any folder; with \`--pages\` it writes this page.`,
    '',
    '## What looks different, and why',
    '',
    'Compared with the images that rasterisers render of the same files:',
    '',
    '| model | |',
    '| --- | --- |',
    ...rows.flatMap(({ name }) => (NOTES[name] ? [`| ${cell(name)} | ${cell(NOTES[name])} |`] : [])),
    '',
    'In every image: indirect light, shadows of glass, reflections of the model in itself, and noise, because there are only a few samples. Occlusion textures are not used, since occlusion is computed.',
    '',
    '## Warnings',
    '',
    '`scene/degenerate`, from `validateScene`, reports a triangle without area. No ray can hit it, so the image does not change. `gltf/primitive` reports points and lines, which are not rendered, and triangles whose winding was reversed.',
    '',
    '| model | |',
    '| --- | --- |',
    ...reported.map(
      ({ name, warnings, badSamples }) =>
        `| ${cell(name)} | ${summary(warnings)}${badSamples > 0 ? `; ${badSamples} NaN or infinite samples` : ''} |`,
    ),
    '',
    '## All models',
    '',
    'For loading times see [Loading](/results/loading).',
    '',
    '| model | features | triangles | result |',
    '| --- | --- | --: | --- |',
    ...rows.map(
      ({ name, note, triangles, error, warnings }) =>
        `| ${cell(name)} | ${cell(note)} | ${triangles.toLocaleString('en')} | ${error === undefined ? (warnings.length > 0 ? 'with warnings' : 'no warnings') : cell(error)} |`,
    ),
    '',
  ].join('\n');
}

/** All images in one, with their names below. */
export async function montage(rows: readonly Row[], folder: string, size: number): Promise<Uint8Array> {
  const columns = Math.min(12, rows.length),
    label = 16,
    width = Math.max(size, 96) + 4,
    height = size + label;
  const pieces: { input: string | Buffer; left: number; top: number }[] = [];
  for (const [i, { id, name, error }] of rows.entries()) {
    const left = (i % columns) * width,
      top = Math.floor(i / columns) * height;
    const file = join(folder, `${id}.png`);
    if (error === undefined && existsSync(file)) pieces.push({ input: file, left, top });
    pieces.push({
      input: Buffer.from(
        `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${label}"><text x="1" y="11" font-family="sans-serif" font-size="10" fill="${error === undefined ? '#ddd' : '#f66'}">${escape(name.slice(0, 19))}</text></svg>`,
      ),
      left,
      top: top + size,
    });
  }
  return sharp({
    create: {
      width: columns * width,
      height: Math.ceil(rows.length / columns) * height,
      channels: 3,
      background: '#1b1c1e',
    },
  })
    .composite(pieces)
    .png()
    .toBuffer();
}
