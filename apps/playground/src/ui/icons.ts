/** Paths on a grid of 20 × 20, drawn with a stroke of the text's colour. */
const PATHS = {
  reset: 'M5 6.5A6.5 6.5 0 1 1 3.5 10M5 2.5v4h4',
  eye: 'M2 10s3-5.5 8-5.5S18 10 18 10s-3 5.5-8 5.5S2 10 2 10zM10 7.6a2.4 2.4 0 1 0 0 4.8 2.4 2.4 0 1 0 0-4.8',
  eyeOff: 'M3 10c1.5 2.7 4 4.3 7 4.3S15.5 12.7 17 10M5.5 12.8L4.2 15M10 14.5V17M14.5 12.8l1.3 2.2',
  image: 'M3 4.5h14v11H3zM3 13l4-4 4 4 2.5-2.5L17 14M13 7.5v.2',
  plus: 'M10 4.5v11M4.5 10h11',
  bin: 'M4.5 6h11M8 6V4h4v2M6 6l.7 10h6.6L14 6',
  play: 'M6.5 4.5v11l9-5.5z',
  pause: 'M7 5v10M13 5v10',
  copy: 'M7 7h9v9H7zM13 7V4H4v9h3',
} as const;
export type IconName = keyof typeof PATHS;

/** An icon; it is hidden from assistive technology, so its button needs a name. */
export function icon(name: IconName): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 20 20');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', PATHS[name]);
  svg.append(path);
  return svg;
}
