// What a page without a framework may write, checked as react.tsx is.
import { defineGlanzViewer, type GlanzViewerElement } from '@glanz/element';

defineGlanzViewer();

const element = document.createElement('glanz-viewer');
export const same: GlanzViewerElement = element;
element.cameraControls = true;
element.exposureEv = 2;
element.variantName = null;
element.addEventListener('load', ({ detail }) => detail.scene.meshes.length);
element.addEventListener('click', (event) => event instanceof Event && element.dismissPoster());
export const found: GlanzViewerElement | null = document.querySelector('glanz-viewer');

// @ts-expect-error An exposure is a number.
element.exposureEv = 'bright';
// @ts-expect-error There is no such property.
element.cameraControl = true;
