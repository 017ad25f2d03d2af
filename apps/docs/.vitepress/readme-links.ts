// The pages of packages are their READMEs. Links that are right in the repository become links of the site here.
import type { MarkdownRenderer } from 'vitepress';

/** Where files of the repository's root are documented on the site. */
const FILES: Readonly<Record<string, string>> = {
  'ARCHITECTURE.md': '/how/',
  'ARCHITECTURE.md#conventions': '/guide/conventions',
  'CONTRIBUTING.md': '/how/tested',
};

/** `../scene` and `packages/scene/README.md` → `/packages/scene`; anything else stays. */
export function siteLink(href: string): string {
  const path = href.replace(/^(\.{1,2}\/)+/, '');
  const known = FILES[path];
  if (known !== undefined) return known;
  const name = /^(?:packages\/)?([a-z-]+)(?:\/|\/README\.md)?(#.*)?$/.exec(path);
  return href !== path || path.startsWith('packages/') ? (name ? `/packages/${name[1]}${name[2] ?? ''}` : href) : href;
}

/** A markdown-it plugin that rewrites the links of the package pages. */
export function readmeLinks(md: MarkdownRenderer): void {
  md.core.ruler.push('readme-links', (state) => {
    const page = (state.env as { relativePath?: string }).relativePath ?? '';
    if (!page.startsWith('packages/')) return;
    for (const { children } of state.tokens) {
      for (const token of children ?? []) {
        const href = token.type === 'link_open' ? token.attrGet('href') : null;
        if (href !== null && !/^([a-z]+:|\/|#)/.test(href)) token.attrSet('href', siteLink(href));
      }
    }
  });
}
