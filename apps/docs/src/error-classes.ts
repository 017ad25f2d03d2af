/** An error class as its doc comment describes it. */
export interface ErrorClass {
  readonly name: string;
  readonly package: string;
  /** The comment's first sentences, before the codes. */
  readonly summary: string;
  /** With when each is thrown; empty where the comment does not say it. */
  readonly codes: readonly { readonly code: string; readonly note: string }[];
}

/** Finds the subclasses of `GlanzError` in a source file, and the codes that their comments promise. */
export function errorClasses(packageName: string, source: string): ErrorClass[] {
  const found: ErrorClass[] = [];
  for (const [, comment = '', name = ''] of source.matchAll(
    /\/\*\*((?:(?!\*\/)[\s\S])*)\*\/\s*export class (\w+) extends GlanzError/g,
  )) {
    const text = comment
      .replace(/\n\s*\*/g, ' ')
      .replace(/\s+/g, ' ')
      .replace(/\{@link (\w+)\}/g, '$1')
      .trim();
    const [summary = '', list = ''] = text.split(/Codes?: /);
    // A list of lines, or a sentence with notes in parentheses.
    const codes = list.startsWith('- ')
      ? list.split(/(?:^| )- (?=`[a-z-]+\/)/).flatMap((line) => {
          const [, code, note = ''] = /^`([a-z-]+\/[a-z0-9-]+)`(?:: (.*))?$/.exec(line) ?? [];
          return code === undefined ? [] : [{ code, note }];
        })
      : [...list.matchAll(/`([a-z-]+\/[a-z0-9-]+)`(?: \(([^)]*)\))?/g)].map(([, code = '', note = '']) => ({
          code,
          note,
        }));
    found.push({ name, package: packageName, summary: summary.trim().replaceAll('`', ''), codes });
  }
  return found;
}
