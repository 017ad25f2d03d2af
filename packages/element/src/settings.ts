// What the attributes of the element ask of a viewer; texts that an attribute does not take count as its default.
import { TONE_MAPS, type ToneMap } from '@glanz/tonemap';
import type { BackFaceCulling } from '@glanz/renderer';
import { RENDER_OPTIONS, takesOption } from '@glanz/renderer/options';
import type { EnvironmentSource, GroundOptions, Viewer } from '@glanz/viewer';
import { numberIn, TONE_MAP_NAMES } from './attribute-checks';
import type { AttributeName } from './attributes';
import type { DecoderAddresses } from './decoders';
import { placementOf } from './placement';
import { angle } from './units';

let warned = false;

/** Once per page: `exposure` is a factor, which the viewer, the command line and the playground do not use. */
function warnOfExposure(): void {
  if (warned) return;
  warned = true;
  // oxlint-disable-next-line no-console
  console.warn('<glanz-viewer>: "exposure", a factor, is deprecated; use "exposure-ev", its base-2 logarithm.');
}

/** What is seen behind the model. */
export const backgroundOf = (element: Element): 'environment' | 'transparent' =>
  element.hasAttribute('skybox-image') ? 'environment' : 'transparent';

/** What lights the model. */
export function environmentOf(element: Element): EnvironmentSource {
  const image = element.getAttribute('skybox-image') || element.getAttribute('environment-image');
  if (!image || image === 'auto') return 'scene';
  return image === 'neutral' || image === 'legacy' ? 'studio' : image;
}

/** Where the model stands, as a matrix. */
export const transformOf = (element: Element): number[] | undefined =>
  placementOf(element.getAttribute('orientation'), element.getAttribute('scale'));

/** The ground that catches shadows, where there is one. A reflection alone brings the whole shadow. */
export function groundOf(element: Element): GroundOptions | undefined {
  const number = (name: AttributeName) => numberIn(name, element.getAttribute(name));
  const reflection = number('ground-reflection') ?? 0;
  const shadow = number('shadow-intensity') ?? (reflection > 0 ? 1 : 0);
  return shadow > 0 ? { shadow, reflection } : undefined;
}

/** Whether requests of other origins carry cookies. */
export const credentialsOf = (element: Element): RequestCredentials =>
  element.hasAttribute('with-credentials') ? 'include' : 'same-origin';

/** Options that a path tracer has from its beginning. */
export function tracerOptionsOf(element: Element): {
  readonly backFaceCulling: BackFaceCulling;
  readonly shadowSoftness: number;
} {
  const mode = element.getAttribute('back-face-culling');
  const softness = Number(element.getAttribute('shadow-softness'));
  return {
    backFaceCulling: takesOption('backFaceCulling', mode)
      ? (mode as BackFaceCulling)
      : RENDER_OPTIONS.backFaceCulling.default,
    shadowSoftness: takesOption('shadowSoftness', softness) ? softness : RENDER_OPTIONS.shadowSoftness.default,
  };
}

/** Addresses of decoders, read when one is needed. */
export const decodersOf = (element: Element): DecoderAddresses => ({
  get draco() {
    return element.getAttribute('draco-decoder');
  },
  get ktx2() {
    return element.getAttribute('ktx2-transcoder');
  },
});

/** Sets what can change at any time at no cost. */
export function applySettings(element: Element, viewer: Viewer): void {
  const number = (name: AttributeName) => numberIn(name, element.getAttribute(name));
  const degrees = (name: AttributeName) => angle((element.getAttribute(name) ?? '').trim());
  viewer.samples = number('samples') ?? RENDER_OPTIONS.samples.default;
  viewer.noise = number('noise');
  viewer.maxDepth = number('max-depth') ?? RENDER_OPTIONS.maxDepth.default;
  viewer.pixelRatio = number('pixel-ratio');
  const preview = element.getAttribute('preview') ?? '';
  viewer.previewMode = preview === 'raw' || preview === 'filtered' ? preview : 'auto';
  const factor = number('exposure');
  if (factor !== undefined) warnOfExposure();
  viewer.exposure = number('exposure-ev') ?? Math.log2(Math.max(1e-6, factor ?? 1));
  const tone = element.getAttribute('tone-mapping') ?? 'neutral';
  viewer.toneMap = Object.hasOwn(TONE_MAP_NAMES, tone)
    ? (TONE_MAP_NAMES[tone] as ToneMap)
    : TONE_MAPS.includes(tone as ToneMap)
      ? (tone as ToneMap)
      : 'neutral';
  viewer.environmentIntensity = number('environment-intensity') ?? 1;
  viewer.environmentRotation = degrees('environment-rotation') ?? 0;
  viewer.damping = (number('interpolation-decay') ?? 60) / 1000;
  viewer.autoRotateDelay = (number('auto-rotate-delay') ?? 3000) / 1000;
  const speed = element.hasAttribute('auto-rotate') ? (degrees('rotation-per-second') ?? Math.PI / 32) : 0;
  if (speed !== viewer.autoRotate) viewer.autoRotate = speed;
  const controls = element.hasAttribute('camera-controls') && {
    pan: !element.hasAttribute('disable-pan'),
    zoom: !element.hasAttribute('disable-zoom'),
    focus: !element.hasAttribute('disable-tap'),
    orbitSensitivity: number('orbit-sensitivity') ?? 1,
    panSensitivity: number('pan-sensitivity') ?? 1,
    zoomSensitivity: number('zoom-sensitivity') ?? 1,
  };
  // Not for nothing: a drag that is under way would end.
  if (JSON.stringify(controls) !== JSON.stringify(viewer.controls)) viewer.controls = controls;
  if (viewer.controls) viewer.canvas.style.touchAction = element.getAttribute('touch-action') ?? 'pan-y';
}
