import { numberOf, takenNumbers, takesNumber } from './attribute-checks';
import { ATTRIBUTES, camel, type AttributeKind, type AttributeName } from './attributes';
import { ElementError } from './errors';

/**
 * The text of a property's value. A string is taken as markup is: an invalid one is reported by the `error` event.
 * @throws {ElementError} `element/property`
 */
function textOf(name: AttributeName, kind: AttributeKind, value: unknown): string {
  if (typeof value === 'string' || (kind === 'text' && value instanceof URL)) return String(value);
  if (typeof value === 'number' && Number.isFinite(value) && (kind === 'text' || takesNumber(name, value)))
    return String(value);
  const takes = kind === 'text' ? 'a text' : takenNumbers(name);
  const given = typeof value === 'number' ? String(value) : `of the type "${typeof value}"`;
  throw new ElementError(
    'element/property',
    `The property ${camel(name)} of <glanz-viewer> is ${given}; it takes ${takes}, or null.`,
  );
}

/** Gives a class the properties that reflect the attributes. A value that one cannot be throws, and nothing changes. */
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
        else this.setAttribute(name, textOf(name, kind, value));
      },
    });
  }
}

/** Takes over what was set on an element before its class was there. @returns The errors of what cannot be set. */
export function adoptProperties(element: HTMLElement): unknown[] {
  const errors: unknown[] = [];
  for (const name of Object.keys(ATTRIBUTES).map(camel)) {
    if (!Object.hasOwn(element, name)) continue;
    const own = element as unknown as Record<string, unknown>;
    const value = own[name];
    delete own[name];
    try {
      own[name] = value;
    } catch (error) {
      errors.push(error);
    }
  }
  return errors;
}
