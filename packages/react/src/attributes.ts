import type { AttributeName } from '@glanz/element';
import type { HtmlProps } from './html';

/** Props that React handles itself, and passes to the element under their own name. */
const OF_REACT = new Set(['style', 'dangerouslySetInnerHTML', 'suppressContentEditableWarning']);

/** Attributes for which `false` is a value, not their absence; `aria-…` and `data-…` are others. */
const STATES = new Set(['contentEditable', 'draggable', 'spellCheck']);

type Cased<Name> = Name extends `on${Capitalize<string>}` | `aria-${string}` | Lowercase<string> ? never : Name;
type CasedHtml = Exclude<
  Cased<keyof HtmlProps>,
  'className' | 'dangerouslySetInnerHTML' | 'suppressContentEditableWarning' | 'suppressHydrationWarning'
>;

/** HTML attributes that React writes with capitals: in HTML they have no hyphens, unlike those of the element. */
const CASED: Readonly<Record<CasedHtml, true>> = {
  accessKey: true,
  autoCapitalize: true,
  autoCorrect: true,
  autoFocus: true,
  autoSave: true,
  contentEditable: true,
  contextMenu: true,
  enterKeyHint: true,
  inputMode: true,
  itemID: true,
  itemProp: true,
  itemRef: true,
  itemScope: true,
  itemType: true,
  popoverTarget: true,
  popoverTargetAction: true,
  radioGroup: true,
  spellCheck: true,
  tabIndex: true,
};

type Single<Name> = Name extends `${string}-${string}` ? never : Name;

/** Attributes of the element that are one word; the others have hyphens. */
const WORDS: Readonly<Record<Single<AttributeName>, true>> = {
  src: true,
  alt: true,
  poster: true,
  loading: true,
  reveal: true,
  exposure: true,
  samples: true,
  noise: true,
  denoise: true,
  preview: true,
  autoplay: true,
  orientation: true,
  scale: true,
};

/**
 * The name under which React writes a prop as an attribute. React 19 sets a property where the element has one of this
 * name, and so makes `title="undefined"` of a title that is taken away, and `hidden=""` no flag. No property begins
 * with a capital, and attributes of HTML are the same in any case.
 */
function attributeName(prop: string): string {
  if (prop === 'className') return 'class';
  if (/^(aria|data)-/.test(prop) || prop in WORDS) return prop;
  if (prop in CASED || !/[A-Z-]/.test(prop)) return prop.charAt(0).toUpperCase() + prop.slice(1).toLowerCase();
  return prop.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
}

/**
 * Props as React 18 and 19 both write them onto a custom element, on a server too: attributes by their names in HTML,
 * flags by their presence, nothing for `null` and `false`; handlers as they are, less those of the element's own
 * `events`.
 */
export function attributesOf(props: Readonly<Record<string, unknown>>, events: object): Record<string, unknown> {
  const attributes: Record<string, unknown> = {};
  for (const [prop, value] of Object.entries(props)) {
    if (value === undefined || value === null || prop in events || prop === 'suppressHydrationWarning') continue;
    if (typeof value === 'function' || OF_REACT.has(prop)) attributes[prop] = value;
    else if (STATES.has(prop) || /^(aria|data)-/.test(prop)) attributes[attributeName(prop)] = String(value);
    else if (value !== false) attributes[attributeName(prop)] = value === true ? '' : String(value);
  }
  return attributes;
}
