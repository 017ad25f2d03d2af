// On pages of results the plot answers the question; the tables behind it fold. Headings stay outside, so that links to
// them lead somewhere, and browsers open what a search of the page finds.
import type { MarkdownRenderer } from 'vitepress';

/** Components that are tables. */
const TABLES = /^<Figure(Grid|Table)\s/;

/** Whether a page begins with a plot, before its first section. */
const hasPlot = (source: string) => /<ResultPlot\s|^!\[.*\.svg\)/mu.test(source.split(/^## /mu, 1)[0]!);

/** A markdown-it plugin that puts each table of such a page into `<details>`, named after its section. */
export function foldTables(md: MarkdownRenderer): void {
  md.core.ruler.push('fold-tables', (state) => {
    const page = (state.env as { relativePath?: string }).relativePath ?? '';
    if (!page.startsWith('results/') || !hasPlot(state.src)) return;
    const { tokens } = state;
    const sectionOf: string[] = [];
    let section = '';
    for (const [i, { type, content }] of tokens.entries()) {
      if (tokens[i - 1]?.type === 'heading_open') section = content;
      sectionOf.push(isTable(type, content) ? section : '');
    }
    const html = (content: string) => Object.assign(new state.Token('html_block', '', 0), { content });
    const count = new Map<string, number>();
    state.tokens = tokens.flatMap((token, i) => {
      const name = sectionOf[i]!;
      const end = token.type === 'table_close' ? [html('</details>\n')] : [];
      if (name === '') return [token, ...end];
      const number = (count.get(name) ?? 0) + 1;
      count.set(name, number);
      const several = sectionOf.filter((other) => other === name).length > 1;
      const text = md.utils.escapeHtml(`${name}: ${several ? `table ${number}` : 'table'}`);
      const open = html(`<details class="result-table"><summary>${text}</summary>\n`);
      return token.type === 'table_open' ? [open, token] : [open, token, html('</details>\n')];
    });
  });
}

const isTable = (type: string, content: string) =>
  type === 'table_open' || (type === 'html_block' && TABLES.test(content));
