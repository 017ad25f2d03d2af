import type { GlanzViewerElement, GlanzViewerEventMap, ReflectedProperties } from '@glanz/element';
import {
  createElement,
  forwardRef,
  useEffect,
  useImperativeHandle,
  useRef,
  type ForwardRefExoticComponent,
  type RefAttributes,
  type RefObject,
} from 'react';
import { attributesOf } from './attributes';
import type { DeclaredLook, LookKeeper } from './declared-look';
import type { GlanzViewerTag, HtmlProps } from './html';

type Source = Parameters<GlanzViewerElement['show']>[0];
type Detail<K extends keyof GlanzViewerEventMap> = GlanzViewerEventMap[K]['detail'];

/**
 * Props of {@link GlanzViewer}: the attributes of `<glanz-viewer>` in camel case, its events as functions of their
 * detail, and everything that React takes for an HTML element (`onClick`, `className`, `title`, `aria-…`, `data-…`,
 * children for its slots).
 */
export interface GlanzViewerProps extends Partial<Omit<ReflectedProperties, 'src'>>, HtmlProps {
  /** An address, a file, files, or a scene. */
  readonly src?: Source | null;
  /**
   * Parameters of materials by their names, as `Viewer.setMaterial` takes them: `{ seat: { base_color: 'firebrick' }
   * }`. Parameters that are removed return to the values of the file. Errors are reported by `onError`, with the codes
   * of `setMaterial`.
   */
  readonly materials?: DeclaredLook['materials'] | null;
  /** Whether parts are shown, by their names: `{ lid: false }`. What is left out again is shown as in the file. */
  readonly parts?: DeclaredLook['parts'] | null;
  /**
   * Factor of the image's brightness, as in model-viewer.
   * @deprecated Use `exposureEv`, the factor's base-2 logarithm. Supported until the next minor version.
   */
  readonly exposure?: number | null;
  readonly onLoad?: (detail: Detail<'load'>) => void;
  readonly onProgress?: (detail: Detail<'progress'>) => void;
  readonly onError?: (detail: Detail<'error'>) => void;
  readonly onWarning?: (detail: Detail<'warning'>) => void;
  readonly onSample?: (detail: Detail<'sample'>) => void;
  readonly onConverged?: (detail: Detail<'converged'>) => void;
  readonly onCameraChange?: (detail: Detail<'camera-change'>) => void;
  readonly onVariantApplied?: (detail: Detail<'variant-applied'>) => void;
  readonly onPreload?: () => void;
  readonly onModelVisibility?: (detail: Detail<'model-visibility'>) => void;
  readonly onEnvironmentChange?: () => void;
  readonly onRenderScale?: (detail: Detail<'render-scale'>) => void;
  readonly onPlay?: (detail: Detail<'play'>) => void;
  readonly onPause?: (detail: Detail<'pause'>) => void;
  readonly onLoop?: (detail: Detail<'loop'>) => void;
  readonly onFinished?: (detail: Detail<'finished'>) => void;
  readonly onPosterDismissed?: () => void;
  readonly onDeviceLost?: (detail: Detail<'device-lost'>) => void;
  readonly onDeviceRestored?: (detail: Detail<'device-restored'>) => void;
}

const EVENTS = {
  onLoad: 'load',
  onProgress: 'progress',
  onError: 'error',
  onWarning: 'warning',
  onSample: 'sample',
  onConverged: 'converged',
  onCameraChange: 'camera-change',
  onVariantApplied: 'variant-applied',
  onPreload: 'preload',
  onModelVisibility: 'model-visibility',
  onEnvironmentChange: 'environment-change',
  onRenderScale: 'render-scale',
  onPlay: 'play',
  onPause: 'pause',
  onLoop: 'loop',
  onFinished: 'finished',
  onPosterDismissed: 'poster-dismissed',
  onDeviceLost: 'device-lost',
  onDeviceRestored: 'device-restored',
} as const;

/**
 * `<glanz-viewer>` as a component. On a server it renders the tag with its children, such as the poster; in the browser
 * the element's code is fetched when the first component is mounted. Its ref is the element, which has the `Viewer`.
 *
 * @example
 * <GlanzViewer src="chair.glb" alt="An oak chair" cameraControls className="chair" onConverged={({ samples }) =>
 * console.log(samples)} />
 */
export const GlanzViewer: ForwardRefExoticComponent<GlanzViewerProps & RefAttributes<GlanzViewerElement>> = forwardRef<
  GlanzViewerElement,
  GlanzViewerProps
>(function GlanzViewer(props, ref) {
  const element = useRef<GlanzViewerElement>(null);
  const latest = useRef(props);
  useImperativeHandle(ref, () => element.current as GlanzViewerElement, []);
  // After each render: handlers are seldom the same functions twice.
  useEffect(() => void (latest.current = props));

  useEffect(() => {
    const target = element.current as GlanzViewerElement;
    const listeners = new AbortController();
    for (const [handler, type] of Object.entries(EVENTS) as [keyof typeof EVENTS, string][]) {
      target.addEventListener(
        type,
        (event) =>
          (latest.current[handler] as ((detail: unknown) => void) | undefined)?.((event as CustomEvent).detail),
        { signal: listeners.signal },
      );
    }
    void import('@glanz/element').then(({ defineGlanzViewer }) => defineGlanzViewer());
    return () => listeners.abort();
  }, []);

  const { src, children, materials, parts, ...rest } = props;
  useLook(element, latest, { materials: materials ?? undefined, parts: parts ?? undefined });
  const address = typeof src === 'string' || src instanceof URL ? String(src) : undefined;
  const source = address === undefined && src ? src : undefined;
  useEffect(() => {
    if (source === undefined) return undefined;
    let requested = true;
    // Its errors come by the event.
    void customElements
      .whenDefined('glanz-viewer')
      .then(() => (requested ? element.current?.show(source).catch(() => undefined) : undefined));
    return () => void (requested = false);
  }, [source]);

  return createElement(
    'glanz-viewer',
    {
      ref: element,
      ...attributesOf(rest, EVENTS),
      ...(address === undefined ? {} : { src: address }),
      // What the element itself adds is its own affair.
      suppressHydrationWarning: true,
    },
    children,
  );
});

/** Keeps the model of an element as its look is declared. */
function useLook(
  element: RefObject<GlanzViewerElement | null>,
  latest: RefObject<GlanzViewerProps>,
  look: DeclaredLook,
): void {
  const keeper = useRef<LookKeeper>(null);
  const requested = useRef(look);
  const isUsed = look.materials !== undefined || look.parts !== undefined;
  useEffect(() => {
    requested.current = look;
    keeper.current?.apply(look);
  });
  useEffect(() => {
    const target = element.current as GlanzViewerElement;
    if (!isUsed) return undefined;
    const report = (error: unknown) => {
      const { message = String(error), code = 'unexpected' } = error as { message?: string; code?: string };
      const { onError } = latest.current;
      if (onError) onError({ error, message, code });
      else globalThis.reportError(error);
    };
    // Fetched while the model is, so that no image shows it otherwise.
    const module = import('./declared-look');
    module.catch(() => undefined);
    let loads = 0;
    const begin = async (load: number) => {
      const { LookKeeper } = await module;
      // Another model may have come, or the component gone.
      if (!target.viewer || load !== loads) return;
      keeper.current = new LookKeeper(target.viewer, report);
      keeper.current.apply(requested.current);
    };
    const load = () => void begin(++loads).catch(report);
    target.addEventListener('load', load);
    if (target.loaded) load();
    return () => {
      loads++;
      target.removeEventListener('load', load);
    };
  }, [isUsed, element, latest]);
}

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'glanz-viewer': GlanzViewerTag;
    }
  }
}
