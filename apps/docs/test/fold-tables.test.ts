import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath, pathToFileURL } from 'node:url';
import type { MarkdownRenderer } from 'vitepress';
import { describe, expect, test } from 'vitest';
import { foldTables } from '../.vitepress/fold-tables';

const results = fileURLToPath(new URL('../results', import.meta.url));
// The one that typedoc brings; VitePress's own is part of its bundle.
const path = createRequire(createRequire(import.meta.url).resolve('typedoc')).resolve('markdown-it');
const { default: MarkdownIt } = (await import(pathToFileURL(path).href)) as {
  readonly default: new (options: object) => MarkdownRenderer;
};
const md = new MarkdownIt({ html: true });
foldTables(md);

const html = (relativePath: string, source: string) => md.render(source, { relativePath });
const count = (text: string, pattern: RegExp) => text.match(pattern)?.length ?? 0;

describe('tables of pages of results', () => {
  const pages = readdirSync(results).filter((name) => name.endsWith('.md'));
  const plotted = pages.filter((name) => /<ResultPlot/.test(readFileSync(`${results}/${name}`, 'utf8')));

  test.each(plotted)('%s: each folds under a name of its own, below its heading', (name) => {
    const text = html(`results/${name}`, readFileSync(`${results}/${name}`, 'utf8'));
    const tables = count(text, /<table|<Figure(Grid|Table)\s/g);
    expect(tables).toBeGreaterThan(0);
    const folds = [...text.matchAll(/<details class="result-table">([\s\S]*?)<\/details>/g)].map(
      ([, inside]) => inside!,
    );
    expect(folds.length).toBe(tables);
    for (const inside of folds) {
      expect(count(inside, /<table|<Figure(Grid|Table)\s/g)).toBe(1);
      expect(count(inside, /<h[1-6]/g)).toBe(0);
    }
    const names = folds.map((inside) => /<summary>(.*?)<\/summary>/.exec(inside)?.[1]);
    expect(new Set(names).size).toBe(names.length);
  });

  test('stay open without a plot above them, and elsewhere', () => {
    const table = '| a | b |\n|---|---|\n| 1 | 2 |\n';
    expect(html('results/x.md', `# A\n\n${table}\n## B\n\n<ResultPlot of="bvh" />\n`)).not.toContain('<details');
    expect(html('guide/x.md', `# A\n\n<ResultPlot of="bvh" />\n\n${table}`)).not.toContain('<details');
    expect(html('results/x.md', `# A\n\n![plot](./a.svg)\n\n${table}`)).toContain('<summary>A: table</summary>');
  });
});
