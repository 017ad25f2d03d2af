import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from '@playwright/test';

interface Axe {
  run(
    context: Document | { readonly exclude: readonly string[][] },
    options: object,
  ): Promise<{
    readonly violations: readonly {
      readonly id: string;
      readonly nodes: readonly { readonly target: readonly string[]; readonly failureSummary: string }[];
    }[];
  }>;
}

let script = '';

/**
 * Faults that axe finds in the page as it is: its rule and the element, one line each.
 *
 * @param exclude Selectors of parts that are not looked at, such as navigation that other pages have shown.
 * @param contrast Whether contrasts are measured, which takes half of the time: false where other pages of the same style
 * sheets have shown theirs.
 */
export async function checkAccessibility(
  page: Page,
  exclude: readonly string[] = [],
  contrast = true,
): Promise<string[]> {
  script ||= readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  // A page's policy may keep strangers' scripts out; the debugger's are none.
  if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(script);
  return page.evaluate(
    async ([without, measured]) => {
      // What fades is looked at when it has: a theme that has just been changed, a menu that comes.
      for (const animation of document.getAnimations())
        if (animation.effect?.getComputedTiming().endTime !== Infinity) animation.finish();
      const { violations } = await (globalThis as unknown as { axe: Axe }).axe.run(
        without.length > 0 ? { exclude: without.map((selector) => [selector]) } : document,
        { resultTypes: ['violations'], rules: { 'color-contrast': { enabled: measured } } },
      );
      return violations.flatMap(({ id, nodes }) =>
        nodes.map(
          ({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary.split('\n')[1]?.trim() ?? ''}`,
        ),
      );
    },
    [exclude, contrast] as const,
  );
}
