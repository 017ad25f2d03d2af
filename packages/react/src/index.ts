export { GlanzViewer, type GlanzViewerProps } from './glanz-viewer';
export type { GlanzViewerElement, GlanzViewerEventMap } from '@glanz/element';
