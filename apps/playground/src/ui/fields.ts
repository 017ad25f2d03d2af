import { srgbDecode, srgbEncode } from '@glanz/tonemap';
import { element } from './elements';
import { icon } from './icons';

/** A labelled control. */
export interface Field<T> {
  readonly element: HTMLElement;
  /** Shows another value, without an event. */
  set(value: T): void;
  /** What the way back leads to from now on; undefined takes it away. */
  setInitial(value: T | undefined): void;
}

interface Common<T> {
  readonly id: string;
  readonly label: string;
  readonly value: T;
  /** What it does, shown on hover. */
  readonly hint?: string | undefined;
  /** What a button leads back to where the value is another one. */
  readonly initial?: T | undefined;
  readonly onInput: (value: T) => void;
}

export interface SliderOptions extends Common<number> {
  /** What the slider offers. */
  readonly range: readonly [number, number];
  /** What the number box takes; default: the same. */
  readonly hardRange?: readonly [number, number] | undefined;
  /** Of the slider; default a two-hundredth of its range. */
  readonly step?: number | undefined;
  readonly unit?: string | undefined;
  /** Power between the slider's place and the value: more than 1 gives small values more room. Default 1. */
  readonly curve?: number | undefined;
  /** Only whole numbers. */
  readonly whole?: boolean | undefined;
}

const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/** A row of name and controls, with the button that leads back. */
function fieldRow<T>(
  { id, label, hint, initial, onInput }: Common<T>,
  show: (value: T) => void,
  ...controls: HTMLElement[]
): {
  readonly element: HTMLElement;
  readonly noteValue: (value: T) => void;
  readonly setInitial: (value: T | undefined) => void;
} {
  const reset = element('button', {
    type: 'button',
    class: 'reset',
    'aria-label': `Reset ${label}`,
    title: 'Reset',
    tabindex: -1,
  });
  reset.append(icon('reset'));
  const row = element('div', { class: 'field', title: hint }, element('label', { for: id }, label), ...controls, reset);
  let start = initial;
  let last: T | undefined;
  const mark = () => {
    const changed = start !== undefined && last !== undefined && !same(last, start);
    row.classList.toggle('changed', changed);
    reset.tabIndex = changed ? 0 : -1;
  };
  const noteValue = (value: T) => {
    last = value;
    mark();
  };
  reset.addEventListener('click', () => {
    if (start === undefined) return;
    show(start);
    onInput(start);
  });
  return {
    element: row,
    noteValue,
    setInitial: (value) => {
      start = value;
      mark();
    },
  };
}

/** As few digits as distinguish values. */
const tidy = (value: number) => String(Number(value.toPrecision(4)));

/** A slider and a box for the number. */
export function sliderField(options: SliderOptions): Field<number> {
  const {
    id,
    label,
    value,
    range: [low, high],
    hardRange = [low, high],
    step,
    unit,
    curve = 1,
    whole = false,
    onInput,
  } = options;
  const span = high - low;
  const toPlace = (v: number) => Math.max(0, Math.min(1, (v - low) / span)) ** (1 / curve);
  const plain = curve === 1;
  const slider = element('input', {
    type: 'range',
    id,
    min: plain ? low : 0,
    max: plain ? high : 1,
    step: step ?? (!plain ? 0.002 : whole ? 1 : span / 200),
  });
  const box = element('input', {
    type: 'number',
    step: whole ? 1 : 'any',
    'aria-label': unit ? `${label}, ${unit}` : label,
    inputmode: 'decimal',
  });
  if (Number.isFinite(hardRange[0])) box.min = String(hardRange[0]);
  if (Number.isFinite(hardRange[1])) box.max = String(hardRange[1]);
  const show = (v: number, except?: HTMLInputElement) => {
    const text = tidy(v);
    if (except !== slider) slider.value = String(plain ? v : toPlace(v));
    if (except !== box) box.value = text;
    slider.style.setProperty('--at', `${100 * toPlace(v)}%`);
    slider.setAttribute('aria-valuetext', unit ? `${text} ${unit}` : text);
    row.noteValue(v);
  };
  const row = fieldRow(options, show, slider, box);
  slider.addEventListener('input', () => {
    const place = Number(slider.value);
    const exact = plain ? place : low + span * place ** curve;
    const v = whole ? Math.round(exact) : exact;
    show(v, slider);
    onInput(Number(tidy(v)));
  });
  box.addEventListener('change', () => {
    const typed = box.valueAsNumber;
    if (!Number.isFinite(typed))
      return show(Number(tidy(plain ? Number(slider.value) : low + span * Number(slider.value) ** curve)));
    const clamped = Math.min(Math.max(whole ? Math.round(typed) : typed, hardRange[0]), hardRange[1]);
    show(clamped);
    onInput(clamped);
  });
  show(value);
  if (unit) row.element.querySelector('label')?.append(element('span', { class: 'unit' }, ` ${unit}`));
  return { element: row.element, set: (v) => show(v), setInitial: row.setInitial };
}

type Rgb = readonly [number, number, number];

/** Linear Rec.709 as `#rrggbb`. */
export const toHex = (rgb: Rgb): string =>
  `#${rgb
    .map((v) =>
      Math.round(255 * srgbEncode(Math.max(0, Math.min(1, v))))
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;

/** `#rrggbb` as linear Rec.709. */
export const fromHex = (hex: string): Rgb =>
  [1, 3, 5].map((at) => srgbDecode(Number.parseInt(hex.slice(at, at + 2), 16) / 255)) as unknown as Rgb;

/** A colour, linear outside and sRGB on the screen. */
export function colourField(options: Common<Rgb>): Field<Rgb> {
  const { id, value, onInput } = options;
  const input = element('input', { type: 'color', id });
  const code = element('output', { for: id, class: 'code' });
  const show = (rgb: Rgb) => {
    input.value = toHex(rgb);
    code.textContent = input.value;
    row.noteValue(rgb);
  };
  const row = fieldRow(options, show, input, code);
  input.addEventListener('input', () => {
    const rgb = fromHex(input.value);
    code.textContent = input.value;
    row.noteValue(rgb);
    onInput(rgb);
  });
  show(value);
  return { element: row.element, set: show, setInitial: row.setInitial };
}

/** A box to tick. */
export function checkField(options: Common<boolean>): Field<boolean> {
  const { id, value, onInput } = options;
  const input = element('input', { type: 'checkbox', id });
  const show = (checked: boolean) => {
    input.checked = checked;
    row.noteValue(checked);
  };
  const row = fieldRow(options, show, input);
  input.addEventListener('change', () => {
    row.noteValue(input.checked);
    onInput(input.checked);
  });
  show(value);
  return { element: row.element, set: show, setInitial: row.setInitial };
}

/** One of several. */
export function selectField<T extends string>(
  options: Common<T> & { readonly choices: readonly (readonly [T, string])[] },
): Field<T> & { setChoices(choices: readonly (readonly [T, string])[], value: T): void } {
  const { id, label, hint, choices, value, onInput } = options;
  const input = element('select', { id });
  const fill = (list: readonly (readonly [T, string])[]) =>
    input.replaceChildren(...list.map(([key, title]) => element('option', { value: key }, title)));
  fill(choices);
  input.value = value;
  input.addEventListener('change', () => onInput(input.value as T));
  return {
    element: element('div', { class: 'field', title: hint }, element('label', { for: id }, label), input),
    set: (key) => void (input.value = key),
    setInitial: () => undefined,
    setChoices: (list, key) => {
      fill(list);
      input.value = key;
    },
  };
}

/** A heading over some fields. */
export const section = (title: string, ...children: (Node | string)[]): HTMLElement =>
  element('section', { class: 'section' }, element('h2', {}, title), ...children);
