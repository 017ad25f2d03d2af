import { element } from './elements';

export interface Message {
  readonly kind: 'error' | 'note';
  readonly text: string;
  /** The error's code, for tests and reports. */
  readonly code?: string;
  /** Whether a note stays until it is closed. */
  readonly stays?: boolean;
  readonly action?: { readonly title: string; readonly run: () => void };
}

/** A note goes by itself, an error stays until it is closed or something succeeds. */
const NOTE_MS = 9000;
const MAX_MESSAGES = 3;

/** One-line messages beside the image. */
export class Messages {
  readonly #region: HTMLElement;

  /** @param region A popover is shown above all else while it has messages. */
  constructor(region: HTMLElement) {
    this.#region = region;
  }

  show({ kind, text, code, stays, action }: Message): void {
    const close = element('button', { type: 'button', class: 'close', 'aria-label': 'Close this message' }, '×');
    const message = element(
      'div',
      { class: `message ${kind}`, role: kind === 'error' ? 'alert' : 'status', 'data-code': code },
      element('p', {}, text),
    );
    close.addEventListener('click', () => this.#remove(message));
    if (action) {
      const button = element('button', { type: 'button' }, action.title);
      button.addEventListener('click', () => {
        this.#remove(message);
        action.run();
      });
      message.append(button);
    }
    message.append(close);
    // The same trouble again is not more trouble.
    for (const other of this.#region.children) if (other.querySelector('p')?.textContent === text) other.remove();
    this.#region.append(message);
    while (this.#region.children.length > MAX_MESSAGES) this.#region.firstElementChild?.remove();
    if (kind === 'note' && !stays) setTimeout(() => this.#remove(message), NOTE_MS);
    this.#raise();
  }

  /** Removes errors: what they spoke of is over. */
  clearErrors(): void {
    for (const message of this.#region.querySelectorAll('.error')) this.#remove(message);
  }

  #remove(message: Element): void {
    message.remove();
    if (this.#region.popover && this.#region.childElementCount === 0) this.#region.hidePopover();
  }

  /** Above menus and dialogs that were opened since the last message. */
  #raise(): void {
    if (!this.#region.popover) return;
    this.#region.hidePopover();
    this.#region.showPopover();
  }
}
