import { element } from './elements';

/** One line of a menu: what it does, and a short description. */
export function item(
  id: string,
  title: string,
  note: string,
  run: () => void | Promise<void>,
  fail: (error: unknown) => void,
): HTMLButtonElement {
  const button = element('button', { type: 'button', class: 'item', id }, title, element('small', {}, note));
  button.addEventListener('click', async () => {
    button.disabled = true;
    try {
      await run();
    } catch (error) {
      fail(error);
    } finally {
      button.disabled = false;
    }
  });
  return button;
}
