import { expect, test } from 'vitest';
import { PUSH_BUTTON_KIT } from '@glanz/models';
import { assemblyOf, optionalParts } from '../src/configurator/assembly';
import {
  applies,
  CATALOGUE,
  choicesOf,
  combinations,
  FEATURES,
  sentence,
  usual,
  type Configuration,
} from '../src/configurator/catalogue';
import { orderCode, parseOrderCode } from '../src/configurator/order-code';

/** Every button, counted off like an odometer, in steps so that a test sees tens of thousands of them. */
function* buttons(step: number): Generator<Configuration> {
  const sizes = FEATURES.map((feature) => choicesOf(feature).length);
  const total = sizes.reduce((product, size) => product * size, 1);
  for (let n = 0; n < total; n += step) {
    let rest = n;
    yield Object.fromEntries(
      FEATURES.map((feature, i) => {
        const at = rest % sizes[i]!;
        rest = Math.floor(rest / sizes[i]!);
        return [feature, choicesOf(feature)[at]!.code];
      }),
    ) as Configuration;
  }
}

test('codes of choices are one letter each, unlike within a feature, and never the sign for nothing', () => {
  for (const feature of FEATURES) {
    const codes = choicesOf(feature).map(({ code }) => code);
    expect(
      codes.every((code) => /^[A-Z]$/.test(code)),
      feature,
    ).toBe(true);
    expect(new Set(codes).size, feature).toBe(codes.length);
  }
});

test('each button has an order code of its own, from which the button comes back', () => {
  // A prime: the steps do not favour any choice.
  const codes = new Map<string, string>();
  for (const button of buttons(61)) {
    const code = orderCode(button);
    const back = parseOrderCode(code)!;
    for (const feature of FEATURES)
      if (applies(button, feature)) expect(back[feature], `${code}: ${feature}`).toBe(button[feature]);
    const same = FEATURES.filter((feature) => applies(button, feature))
      .map((feature) => button[feature])
      .join('');
    expect(codes.get(code) ?? same).toBe(same);
    codes.set(code, same);
  }
  expect(codes.size).toBeGreaterThan(20_000);
});

test('there are as many buttons as codes', () => {
  const distinct = new Set<string>();
  // Mountings and panels in full, the rest by multiplication.
  for (const mounting of choicesOf('mounting'))
    for (const panel of choicesOf('panel'))
      distinct.add(orderCode({ ...usual(), mounting: mounting.code, panel: panel.code }));
  const rest = FEATURES.filter((feature) => feature !== 'mounting' && feature !== 'panel').reduce(
    (product, feature) => product * CATALOGUE[feature].choices.length,
    1,
  );
  expect(combinations()).toBe(distinct.size * rest);
  expect(combinations()).toBeGreaterThan(1_000_000);
});

test('codes are read whatever their case, and nonsense is refused', () => {
  const code = orderCode(usual());
  expect(parseOrderCode(` ${code.toLowerCase()} `)).toEqual(usual());
  expect(parseOrderCode(`#${code}`)).toEqual(usual());
  for (const bad of [
    '',
    'GB22',
    code.slice(0, -1),
    `${code}X`,
    code.replace('GB22', 'GB30'),
    code.replace('-FG-', '-ZG-'),
    code.replace('-PA-', '-P0-'),
    '<script>',
  ])
    expect(parseOrderCode(bad), bad).toBeUndefined();
});

test('every choice shows parts that the kit has, and one lens, one bezel and at most one legend', () => {
  const optional = optionalParts();
  for (const button of buttons(997)) {
    const { visible, heights } = assemblyOf(button);
    const of = (kind: string) => [...visible].filter((name) => name.startsWith(`${kind} `)).length;
    expect([...visible].filter((name) => !optional.has(name))).toEqual([]);
    expect([of('Lens'), of('Bezel'), of('Legend')]).toEqual([1, 1, button.legend === 'N' ? 0 : 1]);
    expect(heights.size).toBe(button.legend === 'N' ? 0 : 1);
    const lampBlock = PUSH_BUTTON_KIT.blocks['Lamp block'].every((name) => visible.has(name));
    expect(lampBlock).toBe(button.light !== 'N');
    expect(sentence(button)).toMatch(/^[A-Z][^.]{60,}\.$/);
  }
});
