import { describeError, isAbort } from '../errors';
import '../style/render-dialog.css';
import { element } from './elements';

/** Time to wait, in words. */
export function waitText(ms: number): string {
  const seconds = Math.ceil(ms / 1000);
  if (seconds < 90) return `${seconds} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

/** A number box that keeps to its range. */
export function numberBox(
  id: string,
  label: string,
  value: number,
  [low, high]: readonly [number, number],
  step: number | 'any',
): HTMLInputElement {
  const box = element('input', {
    type: 'number',
    id,
    min: low,
    max: high,
    step,
    value,
    required: true,
    'aria-label': label,
    inputmode: 'decimal',
  });
  box.addEventListener('change', () => {
    const typed = box.valueAsNumber;
    const kept = Number.isFinite(typed) ? Math.min(Math.max(step === 1 ? Math.round(typed) : typed, low), high) : value;
    box.value = String(kept);
  });
  return box;
}

/** A line of a dialog. */
export const row = (label: string, id: string, ...controls: HTMLElement[]) =>
  element('div', { class: 'render-row' }, element('label', { for: id }, label), ...controls);

/** One of several. */
export const select = (
  id: string,
  choices: readonly (readonly [value: string, title: string])[],
  value: string,
): HTMLSelectElement => {
  const made = element('select', { id }, ...choices.map(([key, title]) => element('option', { value: key }, title)));
  made.value = value;
  return made;
};

/** A row of controls that the label above it speaks of too. */
export const below = (...controls: (HTMLElement | string)[]): HTMLElement =>
  element('div', { class: 'render-row' }, element('span', {}), element('div', { class: 'render-pair' }, ...controls));

/** What a {@link workDialog} is made of. */
export interface WorkDialogParts {
  /** Ids of its elements begin with it. */
  readonly name: string;
  readonly title: string;
  /** What the progress bar is called. */
  readonly progress: string;
  /** Controls, disabled while it works. */
  readonly inputs: HTMLFieldSetElement;
  /** Shown beside the progress bar while it works. */
  readonly preview?: HTMLElement;
  /** Buttons that begin, the last one by Enter; hidden while it works. */
  readonly actions: readonly HTMLButtonElement[];
  /** Called when it begins and when it ends. */
  readonly onBusy: (busy: boolean) => void;
  /** Called by the last action. */
  readonly submit: () => void;
}

/** A dialog whose work takes a while, shows its progress and can be cancelled. */
export interface WorkDialog {
  readonly open: () => void;
  readonly progress: (share: number, text: string) => void;
  /** Works until it is done or cancelled, and says what has come of it: what `work` resolves to, or its error. */
  readonly run: (work: (signal: AbortSignal) => Promise<string>) => Promise<void>;
}

/** Makes a dialog; it is removed from the page when it closes. */
export function workDialog(parts: WorkDialogParts): WorkDialog {
  const { name, title, inputs, preview, actions, onBusy } = parts;
  const bar = element('progress', { max: 1, value: 0, 'aria-label': parts.progress });
  const figures = element('p', { class: 'note', id: `${name}-figures` });
  const progress = element(
    'div',
    { class: 'render-progress', hidden: true },
    ...(preview ? [preview] : []),
    bar,
    figures,
  );
  const said = element('p', { class: 'note', role: 'status' });
  const wrong = element('p', { class: 'render-error', role: 'alert', hidden: true });
  const cancel = element('button', { type: 'button', id: `${name}-cancel`, hidden: true }, 'Cancel');
  const close = element('button', { type: 'button', class: 'quiet square', 'aria-label': 'Close' }, '×');
  const form = element(
    'form',
    { method: 'dialog', novalidate: true },
    inputs,
    progress,
    said,
    wrong,
    element('div', { class: 'render-actions' }, cancel, ...actions),
  );
  const dialog = element(
    'dialog',
    { id: `${name}-dialog`, class: 'dialog render-dialog', 'aria-labelledby': `${name}-title` },
    element('header', {}, element('h2', { id: `${name}-title` }, title), close),
    form,
  );
  let running: AbortController | undefined;
  const busy = (controller: AbortController | undefined) => {
    running = controller;
    const works = controller !== undefined;
    inputs.disabled = works;
    [progress.hidden, cancel.hidden] = [!works, !works];
    for (const action of actions) action.hidden = works;
    onBusy(works);
  };
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    parts.submit();
  });
  cancel.addEventListener('click', () => running?.abort());
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => {
    running?.abort();
    dialog.remove();
  });
  return {
    open: () => {
      busy(undefined);
      document.body.append(dialog);
      dialog.showModal();
    },
    progress: (share, text) => {
      bar.value = share;
      figures.textContent = text;
    },
    run: async (work) => {
      if (running) return;
      const controller = new AbortController();
      busy(controller);
      wrong.hidden = true;
      said.textContent = '';
      bar.value = 0;
      figures.textContent = 'Preparing';
      cancel.focus();
      try {
        said.textContent = await work(controller.signal);
      } catch (error) {
        if (controller.signal.aborted || isAbort(error)) said.textContent = 'Cancelled.';
        else {
          const { message, code } = describeError(error);
          wrong.textContent = message;
          wrong.dataset['code'] = code;
          wrong.hidden = false;
        }
      } finally {
        busy(undefined);
        if (dialog.open) actions.at(-1)?.focus();
      }
    },
  };
}
