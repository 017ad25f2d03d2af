import type { OpenPbrGroup, OpenPbrParameterInfo } from '@glanz/openpbr/parameters';

/** One line of the parameter tables, ready to print. */
export interface ParameterRow {
  readonly name: string;
  readonly group: OpenPbrGroup;
  readonly type: string;
  readonly default: string;
  readonly range: string;
  readonly softRange: string;
  readonly unit: string;
  readonly texturable: boolean;
  /** Whether the renderer reads it yet. */
  readonly acts: boolean;
  readonly doc: string;
}

const UNITS: Readonly<Record<OpenPbrParameterInfo['unit'], string>> = {
  '1': '',
  length: ' m',
  'cd/m²': ' cd/m²',
  µm: ' µm',
};

const number = (value: number) =>
  value === Infinity ? '∞' : value === -Infinity ? '−∞' : String(value).replace('-', '−');
const interval = (range: readonly [number, number] | undefined) =>
  range ? `${number(range[0])} … ${number(range[1])}` : '';

function initial(value: OpenPbrParameterInfo['default']): string {
  if (value === null) return 'none';
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return typeof value === 'number' ? number(value) : value.map(number).join(', ');
}

/** Turns the table of `@glanz/openpbr` into lines, group by group in the specification's order. */
export function parameterRows(
  table: Readonly<Record<string, OpenPbrParameterInfo>>,
  acting: readonly string[],
): Partial<Record<OpenPbrGroup, ParameterRow[]>> {
  const groups: Partial<Record<OpenPbrGroup, ParameterRow[]>> = {};
  for (const { name, group, type, default: value, range, softRange, unit, texturable, doc } of Object.values(table)) {
    const soft = interval(softRange);
    (groups[group] ??= []).push({
      name,
      group,
      type,
      default: initial(value),
      range: interval(range),
      softRange: soft === interval(range) ? '' : soft,
      unit: range ? UNITS[unit] : '',
      texturable,
      acts: acting.includes(name),
      doc: doc.replaceAll('`', ''),
    });
  }
  return groups;
}
