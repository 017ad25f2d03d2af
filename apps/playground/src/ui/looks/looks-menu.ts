import '../../style/thumbnails.css';
import type { Context } from '../context';
import { element } from '../elements';
import { hasLook, LOOKS, type LookName } from './looks';

const IMAGES: Readonly<Record<string, string>> = import.meta.glob('../../images/looks/*.webp', {
  eager: true,
  query: '?url&no-inline',
  import: 'default',
});

/** Looks as images of one model: a click sets studio, light and camera in one step of undo. */
export function looksMenu({ store, rig }: Context): HTMLElement[] {
  const buttons = (Object.keys(LOOKS) as LookName[]).map((name) => {
    const { title, view, state } = LOOKS[name];
    const src = IMAGES[`../../images/looks/${name}.webp`];
    const button = element(
      'button',
      { type: 'button', class: 'thumbnail', 'data-look': name },
      element('img', { src, alt: '', width: 144, height: 96 }),
      element('span', {}, title),
    );
    button.addEventListener('click', () => {
      store.set(state, { label: title, merge: `look ${name}` });
      rig.look(view);
    });
    return button;
  });
  const mark = () => {
    for (const button of buttons)
      button.setAttribute('aria-pressed', String(hasLook(store.state, LOOKS[button.dataset['look'] as LookName])));
  };
  store.subscribe(mark);
  mark();
  return [
    element('h2', {}, 'Studio, light and camera'),
    element('div', { class: 'thumbnails', role: 'group', 'aria-label': 'Looks' }, ...buttons),
  ];
}
