import { element } from './elements';

/** A command with its keys. */
export interface Shortcut {
  /** As `KeyboardEvent.key`; `mod+` is Control or Command. */
  readonly keys: readonly string[];
  readonly title: string;
  readonly run: () => void;
}

const typing = (target: EventTarget | null) =>
  target instanceof HTMLElement &&
  (target.isContentEditable ||
    /^(TEXTAREA|SELECT)$/.test(target.tagName) ||
    (target instanceof HTMLInputElement && !/^(range|checkbox|color|button)$/.test(target.type)));

/**
 * As {@link Shortcut.keys} say it. Shift counts with letters and named keys; in signs such as "?" it is part of the
 * sign.
 */
const named = ({ key, ctrlKey, metaKey, shiftKey }: KeyboardEvent) =>
  `${ctrlKey || metaKey ? 'mod+' : ''}${shiftKey && (key.length > 1 || /^[a-z]$/i.test(key)) ? 'shift+' : ''}${key.toLowerCase()}`;

/** Runs commands by their keys, except in text fields. */
export function wireShortcuts(shortcuts: readonly Shortcut[]): void {
  window.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.altKey || typing(event.target) || document.querySelector('dialog[open]'))
      return;
    const key = named(event);
    const shortcut = shortcuts.find(({ keys }) => keys.includes(key));
    // A button takes Space and Enter for itself.
    if (!shortcut || (event.key === ' ' && event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    shortcut.run();
  });
}

const MOUSE: readonly (readonly [string, string])[] = [
  ['Drag, one finger, arrow keys', 'Orbit'],
  ['Shift or right button and drag, two fingers', 'Pan'],
  ['Wheel, pinch, + and −', 'Zoom'],
  ['Click, tap, Enter', 'Select the part and its material'],
  ['Ctrl or Shift and click', 'Add a part to the selection, or remove it'],
  ['Ctrl or Shift while dragging a handle', 'Move, rotate or scale in steps'],
  ['Drag a preset to the image', 'Apply it to the part under the pointer'],
  ['Drop files', 'Open a model, an environment or a .mtlx material; set an image as the texture of a parameter'],
];

const shown = (key: string) =>
  key
    .split('+')
    .map((part) =>
      part === 'mod'
        ? 'Ctrl'
        : part === ' '
          ? 'Space'
          : part.length === 1
            ? part.toUpperCase()
            : part.charAt(0).toUpperCase() + part.slice(1),
    )
    .join(' ');

/** Fills the dialog that lists all keys. */
export function fillKeysDialog(dialog: HTMLDialogElement, shortcuts: readonly Shortcut[]): void {
  const close = element('button', { type: 'button', class: 'quiet square', 'aria-label': 'Close' }, '×');
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  const rows = [
    ...MOUSE.map(([keys, title]) => [keys, title] as const),
    ...shortcuts.map(({ keys, title }) => [keys[0] ?? '', title] as const),
  ];
  dialog.replaceChildren(
    element('header', {}, element('h2', { id: 'keys-title' }, 'Keys and mouse'), close),
    element(
      'dl',
      { class: 'keys' },
      ...rows.flatMap(([key, title], i) => [
        element('dt', {}, i < MOUSE.length ? key : element('kbd', {}, shown(key))),
        element('dd', {}, title),
      ]),
    ),
  );
}
