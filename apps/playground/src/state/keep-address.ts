import type { State } from './state';
import type { Store } from './store';

/** So long after the last change the address follows. */
const WAIT_MS = 400;

/** Keeps the page's address a link to what it shows: a reload, or a bookmark, brings it back. */
export function keepAddress(store: Store<State>, model: () => string | undefined, environment: () => string): void {
  let timer = 0;
  const write = async () => {
    const name = model();
    if (!name) return;
    // Not needed while nothing is changed.
    const { encodeLink, linkContent, LONGEST_LINK } = await import('./link');
    const link = await encodeLink(linkContent(name, store.state, environment()));
    if (link.length <= LONGEST_LINK) history.replaceState(history.state, '', `#${link}`);
  };
  store.subscribe((_next, _before, source) => {
    clearTimeout(timer);
    // A model that was just opened is no edit: its address stays plain.
    if (source !== 'load') timer = window.setTimeout(() => void write(), WAIT_MS);
    else history.replaceState(history.state, '', location.pathname + location.search);
  });
}
