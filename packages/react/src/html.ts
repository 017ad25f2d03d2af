import type { AttributeName, ATTRIBUTES, GlanzViewerElement, ReflectedProperties } from '@glanz/element';
import type { DetailedHTMLProps, HTMLAttributes } from 'react';

/** Events of the element that React knows under the same name, with another argument. */
type OwnEvents = 'onLoad' | 'onProgress' | 'onError' | 'onPlay' | 'onPause';

/** What React takes for any HTML element, less what `<glanz-viewer>` defines itself. */
export type HtmlProps = Omit<
  HTMLAttributes<GlanzViewerElement>,
  keyof ReflectedProperties | OwnEvents | 'defaultChecked' | 'defaultValue'
>;

type Written<Kind extends 'text' | 'flag' | 'number'> = Kind extends 'flag'
  ? true | ''
  : Kind extends 'number'
    ? number | `${number}`
    : string;

/**
 * Props of the tag `<glanz-viewer>` in JSX, for pages that define the element themselves: HTML attributes, and those of
 * the element as they are written in HTML. An attribute that is present turns a flag on, whatever its value, and React
 * 18 writes `false` as
 * text: to leave a flag off, leave the prop out or pass `undefined`.
 */
export type GlanzViewerTag = DetailedHTMLProps<HtmlProps, GlanzViewerElement> & {
  [Name in AttributeName]?: Written<(typeof ATTRIBUTES)[Name]> | undefined;
} & {
  /** React 18 writes `className` of custom elements as `classname`; `class` works in both versions. */
  class?: string | undefined;
};
