// What the pages of packages say of themselves above the README: version and label of stability, from the manifest.
import { readFileSync } from 'node:fs';
import type { MarkdownRenderer } from 'vitepress';

/** Name, version and stability of the package in a folder, as its manifest has them. */
export function packageFacts(folder: string): {
  readonly name: string;
  readonly version: string;
  readonly stability: string;
} {
  const { name, version, glanz } = JSON.parse(
    readFileSync(new URL(`../../../packages/${folder}/package.json`, import.meta.url), 'utf8'),
  ) as { name: string; version: string; glanz: { stability: string } };
  return { name, version, stability: glanz.stability };
}

/** A markdown-it plugin that puts the line below the heading of a package's page. */
export function packageLine(md: MarkdownRenderer): void {
  md.core.ruler.push('package-line', (state) => {
    const page = (state.env as { relativePath?: string }).relativePath ?? '';
    const name = /^packages\/([a-z-]+)\.md$/.exec(page)?.[1];
    const heading = state.tokens.findIndex(({ type, tag }) => type === 'heading_close' && tag === 'h1');
    if (name === undefined || name === 'index' || heading < 0) return;
    const { version, stability } = packageFacts(name);
    const line = new state.Token('html_block', '', 0);
    line.content = `<p class="package-facts">Version ${version} · <a href="/guide/status#stability">${stability}</a></p>\n`;
    state.tokens.splice(heading + 1, 0, line);
  });
}
