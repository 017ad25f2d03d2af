import { expect, test } from 'vitest';
import { controlCamera, type ControlOptions } from '../src/controls';

/** An element of 200 × 100 CSS pixels whose commands are recorded, and what sends it events. */
function makeElement(options?: ControlOptions) {
  const element = Object.assign(new EventTarget(), {
    clientWidth: 200,
    clientHeight: 100,
    getBoundingClientRect: () => ({ left: 10, top: 20 }),
  });
  const calls: unknown[][] = [];
  const record =
    (name: string) =>
    (...values: number[]) =>
      void calls.push([name, ...values]);
  const stop = controlCamera(
    element as unknown as HTMLElement,
    {
      orbit: record('orbit'),
      pan: record('pan'),
      zoom: record('zoom'),
      home: record('home'),
      pick: record('pick'),
      focus: record('focus'),
    },
    options,
  );
  /** @returns The commands that it leads to, and whether the page's own reaction was prevented. */
  const send = (type: string, fields: object) => {
    const event = Object.assign(new Event(type, { cancelable: true }), fields);
    calls.length = 0;
    element.dispatchEvent(event);
    return { calls: [...calls], prevented: event.defaultPrevented };
  };
  return { send, stop };
}

const mouse = { pointerId: 1, pointerType: 'mouse', button: 0 };

test('the key F looks at what lies under the pointer, unless focus is for pointers alone or off', () => {
  const key = { key: 'f' };
  const { send } = makeElement();
  expect(send('keydown', key)).toEqual({ calls: [['focus', 100, 50]], prevented: true });
  send('pointermove', { ...mouse, clientX: 40, clientY: 60 });
  expect(send('keydown', { key: 'F' }).calls).toEqual([['focus', 30, 40]]);
  expect(send('keydown', { key: 'F1' })).toEqual({ calls: [], prevented: false });
  expect(makeElement({ focus: 'pointer' }).send('keydown', key)).toEqual({ calls: [], prevented: false });
  expect(makeElement({ focus: 'pointer' }).send('dblclick', { clientX: 40, clientY: 60 }).calls).toEqual([
    ['focus', 30, 40],
  ]);
  expect(makeElement({ focus: false }).send('dblclick', { clientX: 40, clientY: 60 }).calls).toEqual([]);
});

test('a wheel zooms by pixels, lines or pages', () => {
  const { send } = makeElement();
  const factor = (deltaMode: number, deltaY: number) => {
    const { calls, prevented } = send('wheel', { deltaMode, deltaY });
    expect(prevented).toBe(true);
    return calls[0]?.[1] as number;
  };
  expect(factor(0, 100)).toBeCloseTo(Math.exp(-0.15), 12);
  expect(factor(1, -5)).toBeCloseTo(Math.exp(0.12), 12);
  expect(factor(2, 0.25)).toBeCloseTo(Math.exp(-0.15), 12);
  // At most 240 pixels count.
  expect(factor(2, 1)).toBeCloseTo(Math.exp(-0.36), 12);
});

test('a press that does not move picks, a drag orbits, and nothing happens once the controls are removed', () => {
  const { send, stop } = makeElement();
  const at = (x: number, y: number) => ({ ...mouse, clientX: x + 10, clientY: y + 20 });
  send('pointerdown', at(50, 50));
  expect(send('pointermove', at(52, 51)).calls).toEqual([]);
  expect(send('pointerup', at(52, 51)).calls).toEqual([['pick', 52, 51]]);
  send('pointerdown', at(50, 50));
  expect(send('pointermove', at(75, 50)).calls).toEqual([['orbit', -Math.PI / 4, 0]]);
  expect(send('pointerup', at(75, 50)).calls).toEqual([]);
  stop();
  expect(send('keydown', { key: 'f' })).toEqual({ calls: [], prevented: false });
  expect(send('wheel', { deltaMode: 0, deltaY: 100 }).calls).toEqual([]);
});
