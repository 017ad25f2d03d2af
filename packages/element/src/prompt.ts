const STYLE = `
.prompt { position: absolute; inset: 0; display: grid; place-items: center; pointer-events: none; animation: prompt-in 0.5s; }
.prompt svg { width: 56px; height: 56px; filter: drop-shadow(0 1px 3px rgba(0, 0, 0, 0.6)); }
.prompt.wiggle svg { animation: prompt-wiggle 2.5s ease-in-out infinite; }
@keyframes prompt-in { from { opacity: 0; } }
@keyframes prompt-wiggle { 25% { transform: translateX(-40px); } 75% { transform: translateX(40px); } }
`;
/** A hand that points: an outline of 24 units. */
const HAND =
  'M9 11V4.5a1.5 1.5 0 0 1 3 0V10l5.6 1.2A2 2 0 0 1 19 13.3l-.7 5A2 2 0 0 1 16.3 20H11a2 2 0 0 1-1.5-.7L5 14.5a1.4 1.4 0 0 1 2-2L9 14.2Z';
const SVG = 'http://www.w3.org/2000/svg';

let sheet: CSSStyleSheet | undefined;

/** Input that ends the prompt, or comes before it. */
const INPUTS = ['pointerdown', 'wheel', 'keydown'] as const;

/**
 * Shows a hand over an element where there is no input for a while, until the first input.
 *
 * @param signal Ends it, too.
 */
export function promptAfter(host: HTMLElement, milliseconds: number, wiggles: boolean, signal: AbortSignal): void {
  if (signal.aborted) return;
  const listening = new AbortController();
  const either = AbortSignal.any([signal, listening.signal]);
  const timer = setTimeout(() => {
    const remove = showPrompt(host, wiggles);
    either.addEventListener('abort', remove);
  }, milliseconds);
  either.addEventListener('abort', () => clearTimeout(timer));
  for (const type of INPUTS) host.addEventListener(type, () => listening.abort(), { passive: true, signal: either });
}

/** Shows a hand over an element. @returns What removes it. */
function showPrompt(host: HTMLElement, wiggles: boolean): () => void {
  const root = host.shadowRoot as ShadowRoot;
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLE);
  }
  if (!root.adoptedStyleSheets.includes(sheet)) root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
  const prompt = document.createElement('div');
  prompt.className = wiggles ? 'prompt wiggle' : 'prompt';
  prompt.part.add('prompt');
  // The canvas itself says how it is moved.
  prompt.ariaHidden = 'true';
  const svg = document.createElementNS(SVG, 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  const path = document.createElementNS(SVG, 'path');
  path.setAttribute('d', HAND);
  path.setAttribute('fill', '#fff');
  path.setAttribute('stroke', '#333');
  svg.append(path);
  prompt.append(svg);
  root.append(prompt);
  return () => prompt.remove();
}
