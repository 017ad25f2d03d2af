import { srgbDecode, srgbEncode } from '@glanz/tonemap';
import { element } from './elements';

/** A labelled control. */
export interface Field<T> {
  readonly element: HTMLElement;
  /** Shows another value, without telling anybody. */
  set(value: T): void;
}

interface Common<T> {
  readonly id: string;
  readonly label: string;
  readonly value: T;
  /** What it does, shown on hover. */
  readonly hint?: string | undefined;
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

const row = (id: string, label: string, hint: string | undefined, ...controls: HTMLElement[]) =>
  element('div', { class: 'field', title: hint }, element('label', { for: id }, label), ...controls);

/** As few digits as tell values apart. */
const tidy = (value: number) => String(Number(value.toPrecision(4)));

/** A slider and a box for the number. */
export function sliderField({ id, label, value, hint, range: [low, high], hardRange = [low, high], step, unit, curve = 1, whole = false, onInput }: SliderOptions): Field<number> {
  const span = high - low;
  const toPlace = (v: number) => Math.max(0, Math.min(1, (v - low) / span)) ** (1 / curve);
  const plain = curve === 1;
  const slider = element('input', { type: 'range', id, min: plain ? low : 0, max: plain ? high : 1, step: step ?? (!plain ? 0.002 : whole ? 1 : span / 200) });
  const box = element('input', { type: 'number', step: whole ? 1 : 'any', 'aria-label': unit ? `${label}, ${unit}` : label, inputmode: 'decimal' });
  if (Number.isFinite(hardRange[0])) box.min = String(hardRange[0]);
  if (Number.isFinite(hardRange[1])) box.max = String(hardRange[1]);
  const show = (v: number, except?: HTMLInputElement) => {
    const text = tidy(v);
    if (except !== slider) slider.value = String(plain ? v : toPlace(v));
    if (except !== box) box.value = text;
    slider.setAttribute('aria-valuetext', unit ? `${text} ${unit}` : text);
  };
  slider.addEventListener('input', () => {
    const place = Number(slider.value);
    const exact = plain ? place : low + span * place ** curve;
    const v = whole ? Math.round(exact) : exact;
    show(v, slider);
    onInput(Number(tidy(v)));
  });
  box.addEventListener('change', () => {
    const typed = box.valueAsNumber;
    if (!Number.isFinite(typed)) return show(Number(tidy(plain ? Number(slider.value) : low + span * Number(slider.value) ** curve)));
    const clamped = Math.min(Math.max(whole ? Math.round(typed) : typed, hardRange[0]), hardRange[1]);
    show(clamped);
    onInput(clamped);
  });
  show(value);
  const field = row(id, label, hint, slider, box);
  if (unit) field.querySelector('label')?.append(element('span', { class: 'unit' }, ` ${unit}`));
  return { element: field, set: (v) => show(v) };
}

type Rgb = readonly [number, number, number];

/** Linear Rec.709 as `#rrggbb`. */
export const toHex = (rgb: Rgb): string => `#${rgb.map((v) => Math.round(255 * srgbEncode(Math.max(0, Math.min(1, v)))).toString(16).padStart(2, '0')).join('')}`;

/** `#rrggbb` as linear Rec.709. */
export const fromHex = (hex: string): Rgb => [1, 3, 5].map((at) => srgbDecode(Number.parseInt(hex.slice(at, at + 2), 16) / 255)) as unknown as Rgb;

/** A colour, linear outside and sRGB on the screen. */
export function colourField({ id, label, value, hint, onInput }: Common<Rgb>): Field<Rgb> {
  const input = element('input', { type: 'color', id, value: toHex(value) });
  const code = element('output', { for: id, class: 'code' }, toHex(value));
  input.addEventListener('input', () => {
    code.textContent = input.value;
    onInput(fromHex(input.value));
  });
  return {
    element: row(id, label, hint, input, code),
    set: (rgb) => {
      input.value = toHex(rgb);
      code.textContent = input.value;
    },
  };
}

/** A box to tick. */
export function checkField({ id, label, value, hint, onInput }: Common<boolean>): Field<boolean> {
  const input = element('input', { type: 'checkbox', id });
  input.checked = value;
  input.addEventListener('change', () => onInput(input.checked));
  return { element: row(id, label, hint, input), set: (checked) => void (input.checked = checked) };
}

/** One of several. */
export function selectField<T extends string>({ id, label, value, hint, choices, onInput }: Common<T> & { readonly choices: readonly (readonly [T, string])[] }): Field<T> & { setChoices(choices: readonly (readonly [T, string])[], value: T): void } {
  const input = element('select', { id });
  const fill = (list: readonly (readonly [T, string])[]) => input.replaceChildren(...list.map(([key, title]) => element('option', { value: key }, title)));
  fill(choices);
  input.value = value;
  input.addEventListener('change', () => onInput(input.value as T));
  return {
    element: row(id, label, hint, input),
    set: (key) => void (input.value = key),
    setChoices: (list, key) => {
      fill(list);
      input.value = key;
    },
  };
}
