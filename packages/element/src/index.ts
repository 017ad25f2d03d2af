export { defineGlanzViewer, glanzViewerClass } from './element';
export type { ElementBlobOptions, GlanzViewerConstructor, GlanzViewerElement, GlanzViewerEventMap } from './api';
export { ATTRIBUTES, type AttributeKind, type AttributeName, type ReflectedProperties } from './attributes';
export type { HotspotView } from './hotspots';
export { ElementError } from './errors';
