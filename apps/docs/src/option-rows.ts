import { kebabCase, type RenderOption, type RenderOptionEffect, type RenderOptionText } from '@glanz/renderer/options';

/** One line of the table of render options, ready to print. */
export interface OptionRow {
  readonly name: string;
  readonly type: string;
  /** Values or range, with the unit. */
  readonly values: string;
  readonly default: string;
  /** Name on the command line; empty where it has none. */
  readonly flag: string;
  /** Attribute of the element; empty where it has none. */
  readonly attribute: string;
  readonly effect: RenderOptionEffect;
  readonly biased: boolean;
  readonly doc: string;
}

const number = (value: number) =>
  (Math.abs(value) >= 1e15 ? String(value) : value.toLocaleString('en')).replace('-', '−');

function valuesOf(row: RenderOption, unit = ''): string {
  switch (row.type) {
    case 'boolean':
      return 'true, false';
    case 'enum':
      return row.values.join(', ');
    case 'names':
      return `[ ${row.values.join(', ')} ]`;
    case 'filter':
      return `${Object.keys(row.radii).join(', ')}, or { type, radius } with a radius up to ${row.range[1]} pixels`;
    case 'limits':
      return `{ ${row.values.join(', ')} }, each ${row.range.map(number).join(' … ')}`;
    default:
      return `${row.above ? '> ' : ''}${row.range.map(number).join(' … ')}${unit && ` ${unit}`}`;
  }
}

/** Turns the table of `@glanz/renderer/options` into lines, in its order. */
export const optionRows = (
  table: Readonly<Record<string, RenderOption>>,
  texts: Readonly<Record<string, RenderOptionText>>,
  attributes: readonly string[],
  manual: string,
): OptionRow[] =>
  Object.entries(table).map(([name, row]) => {
    const { doc, unit, biased = false } = texts[name]!;
    const attribute = kebabCase(name);
    const flag = `--${row.type === 'boolean' ? 'no-' : ''}${attribute}`;
    return {
      name,
      type: row.type === 'filter' ? 'enum' : row.type === 'limits' ? 'integers' : row.type,
      values: valuesOf(row, unit),
      default:
        row.default === undefined || row.type === 'names'
          ? 'none'
          : typeof row.default === 'number'
            ? number(row.default)
            : String(row.default),
      flag: new RegExp(`^ +${flag}( |$)`, 'm').test(manual) ? flag : '',
      attribute: attributes.includes(attribute) ? attribute : '',
      effect: row.effect,
      biased,
      doc: doc.replaceAll('`', ''),
    };
  });
