import { SAMPLES, type SampleName } from '../input/samples';
import '../style/thumbnails.css';
import type { Context } from './context';
import { byId, element } from './elements';

const IMAGES: Readonly<Record<string, string>> = import.meta.glob('../images/samples/*.webp', {
  eager: true,
  query: '?url&no-inline',
  import: 'default',
});
/** Levels of detail of one model share an image. */
const imageOf = (name: string) =>
  IMAGES[`../images/samples/${name.startsWith('push-button') ? 'push-button' : name}.webp`];

/** The models that the page makes itself, as images: a click loads one and closes the menu. */
export function sampleGallery({ load, opened, onModel }: Context): HTMLElement[] {
  const buttons = (Object.keys(SAMPLES) as SampleName[]).map((name) => {
    const button = element(
      'button',
      { type: 'button', class: 'thumbnail', 'data-sample': name },
      element('img', { src: imageOf(name), alt: '', width: 144, height: 96, loading: 'lazy' }),
      element('span', {}, SAMPLES[name].title),
    );
    button.addEventListener('click', () => {
      byId('gallery-menu').hidePopover();
      void load({ kind: 'sample', name });
    });
    return button;
  });
  const mark = () => {
    for (const button of buttons)
      button.setAttribute('aria-pressed', String(opened().name === button.dataset['sample']));
  };
  onModel(mark);
  mark();
  return [
    element('h2', {}, 'Sample models'),
    element('div', { class: 'thumbnails', role: 'group', 'aria-label': 'Sample models' }, ...buttons),
  ];
}
