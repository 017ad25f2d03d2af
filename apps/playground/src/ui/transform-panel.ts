import { chosenParts } from '../selection';
import type { Move } from '../state/state';
import { withNumber } from '../viewer/move-parts';
import { Gizmo, TOOLS, type Tool } from '../viewer/gizmo';
import { NO_MOVE } from '../viewer/moves';
import { watch, type Context } from './context';
import { element } from './elements';

const TITLES: Readonly<Record<Tool, string>> = { move: 'Move', rotate: 'Rotate', scale: 'Scale' };
const KEYS: Readonly<Record<Tool, string>> = { move: 'G', rotate: 'R', scale: 'S' };
const FIELDS = [
  ['translation', 'Position', 'm'],
  ['rotation', 'Rotation', '°'],
  ['scale', 'Scale', '×'],
] as const satisfies readonly (readonly [keyof Move, string, string])[];

const shown = (value: number) => String(Number(value.toFixed(4)));

/** Tools and numbers that move the chosen parts. */
export function transformPanel(context: Context): HTMLElement {
  const { store, selection, onModel, opened, camera, onView, stageSize } = context;
  const handles = document.querySelector<SVGSVGElement>('#gizmo') as SVGSVGElement;
  const gizmo = new Gizmo(handles, { store, selection, camera, onView, size: stageSize, scene: () => opened().scene });
  const parts = () => chosenParts(selection.chosen);
  const buttons = TOOLS.map((tool) => {
    const button = element(
      'button',
      {
        type: 'button',
        id: `tool-${tool}`,
        'aria-pressed': 'false',
        'aria-keyshortcuts': KEYS[tool],
        title: `${TITLES[tool]} (${KEYS[tool]})`,
      },
      TITLES[tool],
    );
    button.addEventListener('click', () => {
      gizmo.tool = gizmo.tool === tool ? undefined : tool;
      mark();
    });
    return button;
  });
  const boxes = FIELDS.map(([field, title, unit]) =>
    ['X', 'Y', 'Z'].map((name, axis) => {
      const box = element('input', {
        type: 'number',
        step: 'any',
        id: `${field}-${name.toLowerCase()}`,
        'aria-label': `${title} ${name}, ${unit === '×' ? 'factor' : unit}`,
        inputmode: 'decimal',
      });
      box.addEventListener('change', () => {
        if (!Number.isFinite(box.valueAsNumber)) return show();
        store.set(
          { moves: withNumber(store.state.moves, parts(), field, axis, box.valueAsNumber) },
          { label: title, merge: `${title} ${name} ${parts().join()}` },
        );
        show();
      });
      return box;
    }),
  );
  const reset = element('button', { type: 'button', id: 'moves-reset', class: 'quiet' }, 'Reset');
  reset.addEventListener('click', () => {
    const gone = new Set(parts().map(String));
    const moves = Object.fromEntries(Object.entries(store.state.moves).filter(([part]) => !gone.has(part)));
    store.set({ moves }, { label: 'Reset transform' });
  });
  const panel = element(
    'section',
    { class: 'section transform', id: 'transform', 'aria-label': 'Transform', hidden: true },
    element('div', { class: 'transform-bar' }, ...buttons, reset),
    element(
      'div',
      { class: 'transform-row', 'aria-hidden': 'true' },
      element('span', {}),
      ...['X', 'Y', 'Z'].map((name) => element('span', { class: 'axis' }, name)),
    ),
    ...FIELDS.map(([, title, unit], row) =>
      element(
        'div',
        { class: 'transform-row' },
        element('span', {}, `${title} `, element('span', { class: 'unit' }, unit)),
        ...(boxes[row] ?? []),
      ),
    ),
  );
  const mark = () => {
    for (const [i, button] of buttons.entries()) button.setAttribute('aria-pressed', String(gizmo.tool === TOOLS[i]));
  };
  const show = () => {
    const { moves } = store.state;
    const [part] = parts();
    panel.hidden = part === undefined;
    const move = moves[part ?? -1] ?? NO_MOVE;
    for (const [row, [field]] of FIELDS.entries())
      for (const [axis, box] of (boxes[row] ?? []).entries()) box.value = shown(move[field][axis] as number);
    reset.disabled = !parts().some((index) => moves[index]);
  };
  watch(store, ['moves'], show);
  selection.subscribe(show);
  onModel(show);
  mark();
  return panel;
}
