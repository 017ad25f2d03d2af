const STYLE = `
:host { display: block; position: relative; width: 300px; height: 150px; contain: strict; }
:host([hidden]), .hotspot[hidden], .message[hidden] { display: none; }
canvas, .hotspots, .poster { position: absolute; inset: 0; width: 100%; height: 100%; }
canvas { display: block; outline-offset: -2px; border-radius: inherit; }
.poster { display: block; overflow: hidden; pointer-events: none; background: var(--poster-color, transparent); transition: opacity 0.3s; }
.poster.gone { opacity: 0; visibility: hidden; transition: opacity 0.3s, visibility 0s 0.3s; }
.poster img, .poster ::slotted(*) { display: block; width: 100%; height: 100%; object-fit: contain; pointer-events: auto; }
.poster.through img, .poster.through ::slotted(*) { pointer-events: none; }
.hotspots { pointer-events: none; overflow: hidden; }
.hotspot { position: absolute; left: 0; top: 0; will-change: transform; }
.hotspot ::slotted(*) { pointer-events: auto; transition: opacity 0.3s; opacity: var(--max-hotspot-opacity, 1); }
.hotspot.hide ::slotted(*) { pointer-events: none; opacity: var(--min-hotspot-opacity, 0.25); }
.progress { position: absolute; left: 0; top: 0; width: 100%; height: var(--progress-bar-height, 5px); pointer-events: none; transition: opacity 0.3s; }
.progress.gone { opacity: 0; visibility: hidden; transition: opacity 0.3s 0.2s, visibility 0s 0.5s; }
.bar { width: 100%; height: 100%; background: var(--progress-bar-color, color-mix(in srgb, currentcolor 40%, transparent)); transform-origin: 0 0; transform: scaleX(0); transition: transform 0.09s; }
.message { position: absolute; inset: auto 0 0 0; margin: 0; padding: 0.6em 1em; font: 14px/1.4 system-ui, sans-serif; color: #fff; background: rgba(110, 10, 10, 0.88); }
.spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
@media (prefers-reduced-motion: reduce) { .poster, .poster.gone, .progress, .progress.gone, .bar, .hotspot ::slotted(*) { transition: none; } }
`;

/** What lies in the element's shadow. */
export interface Shadow {
  readonly canvas: HTMLCanvasElement;
  readonly hotspots: HTMLElement;
  readonly poster: HTMLElement;
  readonly progress: HTMLElement;
  readonly bar: HTMLElement;
  readonly message: HTMLElement;
  readonly spoken: HTMLElement;
  readonly hint: HTMLElement;
}

function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  className: string,
  ...children: Node[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  element.className = className;
  element.append(...children);
  return element;
}

function slot(name: string, ...fallback: Node[]): HTMLSlotElement {
  const element = document.createElement('slot');
  element.name = name;
  element.append(...fallback);
  return element;
}

/**
 * Fills an element's shadow. Sheets are constructed and styles set by script, which strict content security policies
 * allow.
 *
 * @slot poster - Shown until the model is rendered; in place of the `poster` attribute.
 * @slot progress-bar - In place of the bar that shows how far the load is.
 * @slot hotspot-* - Stays at its `data-position` on the model.
 * @csspart canvas - The canvas that shows the model.
 * @csspart poster - The box of the poster.
 * @csspart progress-bar - The bar that shows how far the load is.
 * @csspart prompt - The hand that `interaction-prompt` shows.
 * @csspart message - The line that reports an error.
 * @cssprop --poster-color - Background of the poster.
 * @cssprop --progress-bar-color - Colour of the bar.
 * @cssprop --progress-bar-height - Height of the bar.
 * @cssprop --min-hotspot-opacity - Opacity of a hotspot that is hidden by the model.
 * @cssprop --max-hotspot-opacity - Opacity of a hotspot that is visible.
 */
export function fillShadow(host: HTMLElement): Shadow {
  const root = host.shadowRoot ?? host.attachShadow({ mode: 'open' });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  root.adoptedStyleSheets = [sheet];
  const bar = make('div', 'bar');
  bar.part.add('progress-bar');
  const progress = make('div', 'progress gone', slot('progress-bar', bar));
  const poster = make('div', 'poster', slot('poster'));
  poster.part.add('poster');
  const message = make('p', 'message');
  message.part.add('message');
  message.setAttribute('role', 'alert');
  message.hidden = true;
  const spoken = make('div', 'spoken');
  spoken.setAttribute('role', 'status');
  const hint = make('div', 'spoken');
  hint.id = 'hint';
  const hotspots = make('div', 'hotspots');
  const canvas = make('canvas', '');
  canvas.part.add('canvas');
  root.replaceChildren(canvas, hotspots, poster, progress, message, spoken, hint);
  return { canvas, hotspots, poster, progress, bar, message, spoken, hint };
}
