export type { DeclaredLook, MaterialEdit } from './declared-look';
export { GlanzViewer, type GlanzViewerProps } from './glanz-viewer';
export type { GlanzViewerTag, HtmlProps } from './html';
export type { GlanzViewerElement, GlanzViewerEventMap } from '@glanz/element';
