import { chosenParts, type Selection } from '../selection';
import type { State } from '../state/state';
import type { Store } from '../state/store';
import type { CameraRig } from '../viewer/camera-rig';
import type { Session } from '../viewer/session';
import { byId } from './elements';
import { fillKeysDialog, wireShortcuts, type Shortcut } from './shortcuts';

export interface CommandHost {
  readonly store: Store<State>;
  readonly session: Session;
  readonly rig: CameraRig;
  readonly selection: Selection;
  readonly canvas: HTMLCanvasElement;
  readonly say: (text: string) => void;
}

/** The tools over the image and the keys that do the same. */
export function wireCommands({ store, session, rig, selection, canvas, say }: CommandHost): void {
  const undo = () => void store.undo();
  const redo = () => void store.redo();
  const pause = () => {
    session.setPaused(!session.paused);
    byId('pause').setAttribute('aria-pressed', String(session.paused));
  };
  const focus = () => {
    const on = canvas.classList.toggle('focusing');
    byId('focus').setAttribute('aria-pressed', String(on));
    if (on) say('Click the point to focus on.');
  };
  const turn = (degrees: number) => {
    const rotation = ((((store.state.rotation + degrees + 180) % 360) + 360) % 360) - 180;
    store.set({ rotation }, { label: 'Environment rotation' });
  };
  const dialog = byId<HTMLDialogElement>('keys-dialog');
  const hide = () => {
    const { hidden } = store.state;
    const parts = chosenParts(selection.chosen).filter((part) => !hidden.includes(part));
    if (parts.length > 0)
      store.set({ hidden: [...hidden, ...parts] }, { label: parts.length > 1 ? 'Hide parts' : 'Hide part' });
  };
  const shortcuts: Shortcut[] = [
    { keys: ['mod+z'], title: 'Undo', run: undo },
    { keys: ['mod+shift+z', 'mod+y'], title: 'Redo', run: redo },
    { keys: [' '], title: 'Pause', run: pause },
    { keys: ['0', 'home'], title: 'Reset view', run: () => rig.choose(store.state.camera) },
    { keys: ['f'], title: 'Frame the selected parts', run: () => rig.frame(chosenParts(selection.chosen)) },
    { keys: ['d'], title: 'Focus by click', run: focus },
    { keys: ['h'], title: 'Hide the selected parts', run: hide },
    { keys: ['shift+h'], title: 'Show all parts', run: () => store.set({ hidden: [] }, { label: 'Show all' }) },
    ...Object.entries({ g: 'Move', r: 'Rotate', s: 'Scale' }).map(([key, tool]) => ({
      keys: [key],
      title: `${tool} the selected parts`,
      run: () => document.getElementById(`tool-${tool.toLowerCase()}`)?.click(),
    })),
    ...Object.entries({ 1: 'front', 3: 'right', 7: 'top', 9: 'corner' } as const).map(([key, side]) => ({
      keys: [key],
      title: `View from the ${side}`,
      run: () => rig.look(side),
    })),
    {
      keys: ['5'],
      title: 'Perspective or orthographic',
      run: () => {
        const { lens } = store.state;
        const projection = lens.projection === 'perspective' ? 'orthographic' : 'perspective';
        store.set({ lens: { ...lens, projection } }, { label: 'Projection' });
      },
    },
    { keys: ['l'], title: 'Rotate the environment to the left', run: () => turn(10) },
    { keys: [';'], title: 'Rotate the environment to the right', run: () => turn(-10) },
    { keys: ['e'], title: 'Export', run: () => byId('export-menu').showPopover() },
    { keys: ['?'], title: 'Show this list', run: () => dialog.showModal() },
  ];
  wireShortcuts(shortcuts);
  fillKeysDialog(dialog, shortcuts);
  byId('help').addEventListener('click', () => dialog.showModal());
  for (const [id, run] of [
    ['undo', undo],
    ['redo', redo],
    ['pause', pause],
    ['home', () => rig.choose(store.state.camera)],
    ['fit', () => rig.frame(chosenParts(selection.chosen))],
    ['focus', focus],
  ] as const)
    byId(id).addEventListener('click', run);
  const mark = () => {
    for (const [id, name, label] of [
      ['undo', 'Undo', store.undoLabel],
      ['redo', 'Redo', store.redoLabel],
    ] as const) {
      const button = byId<HTMLButtonElement>(id);
      button.disabled = label === undefined;
      button.title = label === undefined ? name : `${name}: ${label}`;
      button.setAttribute('aria-label', button.title);
    }
  };
  store.subscribe(mark);
  mark();
}
