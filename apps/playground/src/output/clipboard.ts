import { PlaygroundError } from '../errors';

/**
 * Puts something on the clipboard.
 *
 * @param write Calls the browser's function.
 * @param instead What the user can do where the browser refuses.
 * @throws {PlaygroundError} `playground/clipboard`
 */
export async function toClipboard(write: () => Promise<void>, instead: string): Promise<void> {
  try {
    await write();
  } catch (cause) {
    // Without https there is no clipboard at all.
    throw new PlaygroundError('playground/clipboard', `The browser does not let this page copy. ${instead}`, { cause });
  }
}
