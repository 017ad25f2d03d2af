import type { MarkdownRenderer } from 'vitepress';

/** The corner of a table that has headings on two sides is no heading: without text it would announce nothing. */
export function emptyHeaders(md: MarkdownRenderer): void {
  md.core.ruler.push('empty-headers', ({ tokens }) => {
    tokens.forEach((token, i) => {
      if (token.type !== 'th_open' || tokens[i + 1]?.content.trim() !== '') return;
      const close = tokens[i + 2];
      token.tag = 'td';
      if (close) close.tag = 'td';
    });
  });
}
