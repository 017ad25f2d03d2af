/** How the text of an attribute becomes the value of a property, and back. */
export type AttributeKind = 'text' | 'flag' | 'number';

/**
 * The attributes of the element. Names that model-viewer has mean what they mean there. The property of each is its name in
 * camel case, and reflects.
 */
export const ATTRIBUTES = {
  src: 'text',
  alt: 'text',
  poster: 'text',
  loading: 'text',
  reveal: 'text',
  'camera-controls': 'flag',
  'disable-pan': 'flag',
  'disable-tap': 'flag',
  'disable-zoom': 'flag',
  'touch-action': 'text',
  'camera-orbit': 'text',
  'camera-target': 'text',
  'field-of-view': 'text',
  'min-camera-orbit': 'text',
  'max-camera-orbit': 'text',
  'interpolation-decay': 'number',
  'auto-rotate': 'flag',
  'auto-rotate-delay': 'number',
  'rotation-per-second': 'text',
  'environment-image': 'text',
  'environment-intensity': 'number',
  'environment-rotation': 'text',
  'skybox-image': 'text',
  exposure: 'number',
  'tone-mapping': 'text',
  'variant-name': 'text',
  samples: 'number',
  noise: 'number',
  'max-depth': 'number',
  'pixel-ratio': 'number',
  'back-face-culling': 'text',
} as const satisfies Readonly<Record<string, AttributeKind>>;

/** Name of an attribute of the element. */
export type AttributeName = keyof typeof ATTRIBUTES;

type Camel<Name extends string> = Name extends `${infer Head}-${infer Tail}` ? `${Head}${Capitalize<Camel<Tail>>}` : Name;
type Value<Kind extends AttributeKind> = Kind extends 'flag' ? boolean : Kind extends 'number' ? number | null : string | null;

/** The properties that reflect the attributes; `null` where an attribute is not there. */
export type ReflectedProperties = { -readonly [Name in AttributeName as Camel<Name>]: Value<(typeof ATTRIBUTES)[Name]> };

const camel = (name: string) => name.replace(/-([a-z])/g, (_, letter: string) => letter.toUpperCase());

/** Gives a class the properties that reflect the attributes. */
export function reflectAttributes(prototype: HTMLElement): void {
  for (const [name, kind] of Object.entries(ATTRIBUTES) as [AttributeName, AttributeKind][]) {
    Object.defineProperty(prototype, camel(name), {
      configurable: true,
      enumerable: true,
      get(this: HTMLElement) {
        if (kind === 'flag') return this.hasAttribute(name);
        return kind === 'number' ? numberOf(this.getAttribute(name)) : this.getAttribute(name);
      },
      set(this: HTMLElement, value: unknown) {
        if (kind === 'flag') this.toggleAttribute(name, Boolean(value));
        else if (value === null || value === undefined) this.removeAttribute(name);
        else this.setAttribute(name, String(value));
      },
    });
  }
}

/** Takes over what was set on an element before its class was there. */
export function adoptProperties(element: HTMLElement): void {
  for (const name of Object.keys(ATTRIBUTES).map(camel)) {
    if (!Object.hasOwn(element, name)) continue;
    const own = element as unknown as Record<string, unknown>;
    const value = own[name];
    delete own[name];
    own[name] = value;
  }
}

/** The number that a text says, or `null`. */
export function numberOf(text: string | null): number | null {
  const value = text === null || text.trim() === '' ? Number.NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}
