export { defineGlanzViewer, glanzViewerClass, type ElementBlobOptions, type GlanzViewerConstructor, type GlanzViewerElement, type GlanzViewerEventMap } from './element';
export { ATTRIBUTES, type AttributeKind, type AttributeName, type ReflectedProperties } from './attributes';
export type { HotspotView } from './hotspots';
