import type { PickResult } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { createViewer, type ModelSource, type Orbit, type PlayOptions, type Viewer } from '@glanz/viewer';
import { ElementAnimation } from './animation';
import type { ElementBlobOptions, GlanzViewerConstructor, GlanzViewerElement, GlanzViewerEventMap } from './api';
import { attributeFault, numberIn } from './attribute-checks';
import { ATTRIBUTES, type AttributeName } from './attributes';
import { packagedDecoders } from './decoders';
import { denoiseBy } from './denoise-module';
import { ElementError } from './errors';
import { HotspotLayer, readVector, viewHotspot, type HotspotView } from './hotspots';
import { adoptProperties, reflectAttributes } from './reflect';
import {
  applySettings,
  backgroundOf,
  credentialsOf,
  decodersOf,
  environmentOf,
  groundOf,
  tracerOptionsOf,
  transformOf,
} from './settings';
import { fillShadow, type Shadow } from './shadow';
import { cameraOf, describeView, limitsOf, orbitOf, type ViewAttributes } from './view';

const VIEW: ReadonlySet<string> = new Set([
  'camera-orbit',
  'camera-target',
  'field-of-view',
  'min-camera-orbit',
  'max-camera-orbit',
]);
const LIGHT: ReadonlySet<string> = new Set(['environment-image', 'skybox-image']);
/**
 * Samples per pixel from which on an image is better than its poster: it has an eighth of the noise of its first
 * sample.
 */
const POSTER_SAMPLES = 64;
/** Milliseconds after the last movement before the view is announced to screen readers. */
const SPEAK_MS = 600;

let made: GlanzViewerConstructor | undefined;

/** A number as a property takes it. @throws {ElementError} `element/property` */
function finite(name: string, value: unknown): number {
  if (typeof value === 'number' && Number.isFinite(value)) return value;
  const given = typeof value === 'number' ? String(value) : `of the type "${typeof value}"`;
  throw new ElementError('element/property', `The property ${name} of <glanz-viewer> is ${given}; it takes a number.`);
}

/** The class of the element, created at the first call, since a server has no `HTMLElement`. */
export function glanzViewerClass(): GlanzViewerConstructor {
  return (made ??= makeClass());
}

function makeClass(): GlanzViewerConstructor {
  class GlanzViewer extends HTMLElement {
    static readonly observedAttributes = Object.keys(ATTRIBUTES);
    #shadow: Shadow | undefined;
    #hotspots: HotspotLayer | undefined;
    #viewer: Viewer | undefined;
    #watch: IntersectionObserver | undefined;
    #loaded = false;
    #revealed = false;
    #source: ModelSource | undefined;
    #speaking: ReturnType<typeof setTimeout> | undefined;
    readonly #animation = new ElementAnimation({
      viewer: () => this.#viewer,
      name: () => this.getAttribute('animation-name'),
      autoplay: () => this.hasAttribute('autoplay') && !matchMedia('(prefers-reduced-motion: reduce)').matches,
      fail: (error) => this.#fail(error),
    });
    /** Ends the prompt. */
    #prompted: AbortController | undefined;
    /** Whether the model is seen, as it was announced. */
    #modelVisible = false;
    /** Whether the files of the model that is loading have been read. */
    #preloaded = false;
    /** Pixels of the frame before, per CSS pixel. */
    #renderScale = 0;
    /** Texts that their attributes do not take, which have been reported. */
    readonly #faults = new Map<AttributeName, string>();

    get viewer(): Viewer | undefined {
      return this.#viewer;
    }

    get loaded(): boolean {
      return this.#loaded;
    }

    get availableVariants(): readonly string[] {
      return this.#viewer?.variants ?? [];
    }

    get availableAnimations(): readonly string[] {
      return this.#animation.available;
    }

    get paused(): boolean {
      return this.#animation.paused;
    }

    get duration(): number {
      return this.#animation.duration;
    }

    get currentTime(): number {
      return this.#animation.currentTime;
    }

    set currentTime(seconds: number) {
      this.#animation.currentTime = finite('currentTime', seconds);
    }

    get timeScale(): number {
      return this.#animation.timeScale;
    }

    set timeScale(factor: number) {
      this.#animation.timeScale = finite('timeScale', factor);
    }

    play(options?: PlayOptions): void {
      this.#animation.play(options);
    }

    pause(): void {
      this.#animation.pause();
    }

    connectedCallback(): void {
      for (const error of adoptProperties(this)) this.#fail(error);
      if (!this.#shadow) {
        this.#shadow = fillShadow(this);
        this.#hotspots = new HotspotLayer(
          this,
          this.#shadow.hotspots,
          () => this.#viewer && this.#hotspots?.update(this.#viewer),
        );
      }
      this.#hotspots?.connect();
      this.#describe();
      this.#poster();
      if (this.#viewer) return;
      if (this.getAttribute('loading') === 'eager' || typeof IntersectionObserver === 'undefined') return this.#start();
      this.#watch?.disconnect();
      // A little before it comes into sight.
      this.#watch = new IntersectionObserver(
        (entries) => entries.some((entry) => entry.isIntersecting) && this.#start(),
        { rootMargin: '200px' },
      );
      this.#watch.observe(this);
    }

    disconnectedCallback(): void {
      this.#watch?.disconnect();
      this.#hotspots?.disconnect();
      // One that is moved within the page keeps its image.
      queueMicrotask(() => {
        if (!this.isConnected) this.#stop();
      });
    }

    attributeChangedCallback(name: AttributeName, before: string | null, now: string | null): void {
      if (before === now || !this.#shadow) return;
      if (name === 'alt' || name === 'camera-controls') this.#describe();
      if (name === 'poster') this.#poster();
      if (name === 'loading' && now === 'eager' && this.isConnected && !this.#viewer) this.#start();
      const viewer = this.#viewer;
      if (!viewer) return;
      this.#checkAttribute(name);
      if (name === 'back-face-culling' || name === 'shadow-softness') {
        // Of a path tracer it is part, so there is another one.
        this.#stop();
        this.#start();
      } else if (name === 'src') {
        this.#source = undefined;
        this.#load(viewer);
      } else if (name === 'denoise') this.#denoise(viewer);
      else if (name === 'animation-name') this.#animation.rename();
      else if (name === 'autoplay') {
        if (now !== null && this.#loaded) this.#animation.play();
      } else if (name === 'orientation' || name === 'scale') viewer.modelTransform = transformOf(this);
      else if (name === 'shadow-intensity' || name === 'ground-reflection') viewer.ground = groundOf(this);
      else if (name === 'with-credentials') viewer.credentials = credentialsOf(this);
      else if (name === 'variant-name') this.#setVariant(viewer);
      else if (LIGHT.has(name)) {
        viewer.background = backgroundOf(this);
        viewer.setEnvironment(environmentOf(this)).then(
          () => this.#emit('environment-change', undefined),
          (error: unknown) => this.#fail(error, 'warning'),
        );
      } else if (VIEW.has(name)) {
        if (name === 'field-of-view' && viewer.scene)
          this.#attempt(
            () => void (viewer.fieldOfView = cameraOf(viewer.scene as Scene, this.#aspect, this.#view).yfov),
          );
        this.#look(viewer, name === 'min-camera-orbit' || name === 'max-camera-orbit');
      } else applySettings(this, viewer);
    }

    async show(source: ModelSource): Promise<void> {
      this.#source = source;
      if (!this.#viewer && this.isConnected) this.#start(false);
      if (this.#viewer) await this.#loadSource(this.#viewer, source);
    }

    async toBlob({ mimeType, qualityArgument, ...options }: ElementBlobOptions = {}): Promise<Blob> {
      if (!this.#viewer) this.#start();
      const viewer = this.#viewer as Viewer;
      if (!viewer.scene && !this.#source && !this.getAttribute('src'))
        throw new ElementError('element/no-model', 'There is no image: set src, or call show(), first.');
      if (!viewer.scene)
        await new Promise<void>((resolve, reject) => {
          const listening = new AbortController();
          const { signal } = listening;
          const end = (settle: () => void) => () => {
            listening.abort();
            settle();
          };
          viewer.on('load', end(resolve), { signal });
          viewer.on('error', ({ error }) => end(() => reject(error as Error))(), { signal });
          viewer.on(
            'state',
            ({ state }) =>
              state === 'destroyed' && end(() => reject(new DOMException('the element was removed', 'AbortError')))(),
            { signal },
          );
        });
      return viewer.toBlob({
        ...(mimeType === undefined ? {} : { type: mimeType }),
        ...(qualityArgument === undefined ? {} : { quality: qualityArgument }),
        ...options,
      });
    }

    getCameraOrbit(): Orbit | undefined {
      return this.#viewer?.orbit;
    }

    getFieldOfView(): number {
      return ((this.#viewer?.fieldOfView ?? 0) * 180) / Math.PI;
    }

    jumpCameraToGoal(): void {
      const orbit = this.#viewer?.orbit;
      if (orbit) this.#viewer?.setOrbit(orbit, { immediate: true });
    }

    updateFraming(): void {
      const { scene } = this.#viewer ?? {};
      if (scene) this.#viewer?.setCamera(cameraOf(scene, this.#aspect, this.#view));
    }

    dismissPoster(): void {
      if (this.#revealed) return;
      this.#revealed = true;
      this.#shadow?.poster.classList.add('gone');
      this.#emit('poster-dismissed', undefined);
      this.#showModel();
    }

    showPoster(): void {
      this.#revealed = false;
      this.#shadow?.poster.classList.remove('gone');
      this.#showModel();
    }

    queryHotspot(slot: string): HotspotView | undefined {
      const [element] = this.#hotspots?.elementsOf(slot) ?? [];
      const position = readVector(element?.getAttribute('data-position'));
      if (!element || !position || !this.#viewer) return undefined;
      return viewHotspot(
        this.#viewer,
        { position, normal: readVector(element.getAttribute('data-normal')) },
        element.hasAttribute('data-occlusion'),
      );
    }

    updateHotspot({
      name,
      position,
      normal,
    }: {
      readonly name: string;
      readonly position?: string;
      readonly normal?: string;
    }): void {
      for (const element of this.#hotspots?.elementsOf(name) ?? []) {
        if (position !== undefined) element.setAttribute('data-position', position);
        if (normal !== undefined) element.setAttribute('data-normal', normal);
      }
    }

    pick(clientX: number, clientY: number): PickResult | undefined {
      const box = this.getBoundingClientRect();
      return this.#viewer?.pick(clientX - box.left, clientY - box.top);
    }

    get #aspect(): number {
      return Math.max(1, this.clientWidth) / Math.max(1, this.clientHeight);
    }

    get #view(): ViewAttributes {
      const text = (name: AttributeName) => this.getAttribute(name);
      return {
        orbit: text('camera-orbit'),
        target: text('camera-target'),
        fieldOfView: text('field-of-view'),
        min: text('min-camera-orbit'),
        max: text('max-camera-orbit'),
      };
    }

    #number(name: AttributeName): number | undefined {
      return numberIn(name, this.getAttribute(name));
    }

    #start(load = true): void {
      this.#watch?.disconnect();
      const shadow = this.#shadow;
      if (this.#viewer || !shadow) return;
      const viewer = (this.#viewer = createViewer(shadow.canvas, {
        environment: environmentOf(this),
        background: backgroundOf(this),
        controls: false,
        modelTransform: transformOf(this),
        ground: groundOf(this),
        credentials: credentialsOf(this),
        decoders: packagedDecoders(decodersOf(this)),
        tracer: tracerOptionsOf(this),
        camera: (scene, aspect) => cameraOf(scene, aspect, this.#view),
      }));
      for (const name of Object.keys(ATTRIBUTES) as AttributeName[]) this.#checkAttribute(name);
      applySettings(this, viewer);
      this.#listen(viewer, shadow);
      this.#denoise(viewer);
      if (load) this.#load(viewer);
    }

    #stop(): void {
      clearTimeout(this.#speaking);
      this.#prompted?.abort();
      this.#prompted = undefined;
      this.#animation.begin();
      this.#viewer?.destroy();
      this.#viewer = undefined;
      this.#loaded = false;
      this.#shadow?.progress.classList.add('gone');
      this.showPoster();
    }

    #listen(viewer: Viewer, { bar, poster, progress, message }: Shadow): void {
      for (const type of [
        'sample',
        'converged',
        'device-lost',
        'device-restored',
        'play',
        'pause',
        'loop',
        'finished',
      ] as const)
        viewer.on(type, (detail) => this.#emit(type, detail));
      const alert = (text: string) => {
        progress.classList.add('gone');
        message.textContent = text;
        message.hidden = false;
      };
      viewer.on('progress', (detail) => {
        // Not beside the message that there is no GPU: nothing happens until there is one.
        progress.classList.toggle('gone', !message.hidden);
        bar.style.transform = `scaleX(${detail.total.toFixed(3)})`;
        this.#emit('progress', { ...detail, totalProgress: detail.total });
        if (detail.stage !== 'bvh' || this.#preloaded) return;
        this.#preloaded = true;
        this.#emit('preload', undefined);
      });
      viewer.on('load', (detail) => {
        this.#loaded = true;
        message.hidden = true;
        progress.classList.add('gone');
        // A poster that stays for a while does not keep the pointer from the model.
        poster.classList.toggle('through', this.getAttribute('reveal') !== 'manual');
        this.#attempt(() => void (viewer.orbitLimits = limitsOf(detail.scene, this.#aspect, this.#view)));
        this.#speak(`${this.#name} is there.`);
        this.#emit('load', detail);
        this.#animation.begin(detail.scene.animations);
        this.#emit('environment-change', undefined);
        this.#showModel();
        this.#prompt();
      });
      viewer.on('error', (detail) => {
        alert(detail.message);
        this.#emit('error', detail);
      });
      viewer.on('warning', (detail) => {
        // No message lies over an image that is shown nevertheless.
        if (!/environment|denoise/.test(detail.code)) alert(detail.message);
        this.#emit('warning', detail);
      });
      viewer.on('converged', () => this.#reveal());
      viewer.on('device-restored', () => void (message.hidden = true));
      viewer.on('camera-change', (detail) => {
        this.#emit('camera-change', detail);
        // The poster shows another view now.
        if (detail.source !== 'api') this.#reveal();
        if (detail.source !== 'user') return;
        clearTimeout(this.#speaking);
        this.#speaking = setTimeout(() => this.#speak(`${this.#name}, seen ${describeView(detail.orbit)}.`), SPEAK_MS);
      });
      viewer.on('frame', ({ preview, width, height }) => {
        this.#scaled(width, height);
        this.#hotspots?.update(viewer);
        // While an animation plays no image gets more samples.
        if (
          !this.#hasPoster ||
          !this.paused ||
          (!preview && viewer.sampleCount >= (this.#number('poster-samples') ?? POSTER_SAMPLES))
        )
          this.#reveal();
      });
    }

    /** Announces whether the model is seen. */
    #showModel(): void {
      const visible = this.#loaded && this.#revealed;
      if (visible !== this.#modelVisible) this.#emit('model-visibility', { visible: (this.#modelVisible = visible) });
    }

    /** Shows once, after a while without input, that the model can be moved. */
    #prompt(): void {
      if (
        this.#prompted ||
        this.getAttribute('interaction-prompt') !== 'auto' ||
        !this.hasAttribute('camera-controls') ||
        matchMedia('(prefers-reduced-motion: reduce)').matches
      )
        return;
      const { signal } = (this.#prompted = new AbortController());
      const wiggles = this.getAttribute('interaction-prompt-style') !== 'basic';
      const threshold = this.#number('interaction-prompt-threshold') ?? 3000;
      import('./prompt').then(
        ({ promptAfter }) => promptAfter(this, threshold, wiggles, signal),
        () => undefined,
      );
    }

    /** Announces how large the frames are. */
    #scaled(width: number, height: number): void {
      const renderedDpr = width / Math.max(1, this.clientWidth);
      if (renderedDpr === this.#renderScale) return;
      this.#renderScale = renderedDpr;
      const reportedDpr = window.devicePixelRatio;
      this.#emit('render-scale', { reportedDpr, renderedDpr, pixelWidth: width, pixelHeight: height });
    }

    /** Dismisses the poster, unless the page does. */
    #reveal(): void {
      if (this.getAttribute('reveal') !== 'manual') this.dismissPoster();
    }

    get #hasPoster(): boolean {
      return this.hasAttribute('poster') || [...this.children].some((child) => child.slot === 'poster');
    }

    get #name(): string {
      return this.getAttribute('alt') || 'Model';
    }

    #describe(): void {
      const { canvas, hint } = this.#shadow as Shadow;
      const moves = this.hasAttribute('camera-controls');
      canvas.setAttribute('role', moves ? 'application' : 'img');
      canvas.setAttribute('aria-label', this.#name);
      canvas.toggleAttribute('aria-roledescription', false);
      if (!moves) {
        canvas.removeAttribute('aria-describedby');
        return;
      }
      canvas.setAttribute('aria-roledescription', '3D model');
      canvas.setAttribute('aria-describedby', 'hint');
      hint.textContent = 'Arrow keys turn it, plus and minus zoom, Shift and arrow keys move it, 0 returns.';
    }

    #poster(): void {
      const { poster } = this.#shadow as Shadow;
      const fallback = poster.querySelector('slot') as HTMLSlotElement;
      const address = this.getAttribute('poster');
      if (address === null) return fallback.replaceChildren();
      const image = document.createElement('img');
      image.src = address;
      image.alt = '';
      fallback.replaceChildren(image);
    }

    #load(viewer: Viewer): void {
      const source = this.#source ?? this.getAttribute('src');
      if (source) this.#loadSource(viewer, source).catch(() => undefined);
    }

    async #loadSource(viewer: Viewer, source: ModelSource): Promise<void> {
      this.#loaded = false;
      this.#preloaded = false;
      this.#showModel();
      if (this.#shadow) this.#shadow.message.hidden = true;
      this.#speak(`${this.#name} is loading.`);
      viewer.orbitLimits = {};
      const variant = this.getAttribute('variant-name');
      await viewer.load(source, variant === null || variant === 'default' ? {} : { variant });
    }

    /** Loads the denoiser that `denoise` names. */
    #denoise(viewer: Viewer): void {
      const address = this.getAttribute('denoise');
      const current = () => viewer === this.#viewer && address === this.getAttribute('denoise');
      denoiseBy(viewer, address, current).catch((error: unknown) => this.#fail(error, 'warning'));
    }

    #setVariant(viewer: Viewer): void {
      const name = this.getAttribute('variant-name');
      if (!viewer.scene) return;
      viewer.setVariant(name === null || name === 'default' ? undefined : name).then(
        () => this.#emit('variant-applied', { variantName: name }),
        (error: unknown) => this.#fail(error),
      );
    }

    #look(viewer: Viewer, limits: boolean): void {
      const { scene } = viewer;
      if (!scene) return;
      this.#attempt(() => {
        if (limits) viewer.orbitLimits = limitsOf(scene, this.#aspect, this.#view);
        else viewer.setOrbit(orbitOf(scene, this.#aspect, this.#view));
      });
    }

    /** Reports a text that its attribute does not take; the default is used in its place. */
    #checkAttribute(name: AttributeName): void {
      const text = this.getAttribute(name);
      const takes = text === null ? undefined : attributeFault(name, text);
      if (takes === undefined) this.#faults.delete(name);
      else if (this.#faults.get(name) !== text)
        this.#fail(
          new ElementError(
            'element/attribute',
            `The attribute ${name} of <glanz-viewer> is "${(text as string).slice(0, 60)}"; it takes ${takes}. The default is used.`,
          ),
        );
      if (takes !== undefined) this.#faults.set(name, text as string);
    }

    /** Does what attributes ask for; what cannot be done is reported. */
    #attempt(change: () => void): void {
      try {
        change();
      } catch (error) {
        this.#fail(error);
      }
    }

    #fail(error: unknown, type: 'error' | 'warning' = 'error'): void {
      if ((error as { name?: string }).name === 'AbortError') return;
      const { message = 'Something failed.', code } = error as { message?: string; code?: string };
      this.#emit(type, { error, message: message.split('\n')[0] as string, code: code ?? 'unexpected' });
    }

    #speak(text: string): void {
      if (this.#shadow) this.#shadow.spoken.textContent = text;
    }

    #emit<K extends keyof GlanzViewerEventMap>(type: K, detail: GlanzViewerEventMap[K]['detail']): void {
      this.dispatchEvent(new CustomEvent(type, { detail }));
    }
  }
  reflectAttributes(GlanzViewer.prototype);
  return GlanzViewer as unknown as GlanzViewerConstructor;
}

/**
 * Defines the custom element `<glanz-viewer>`. Repeated calls have no effect; on a server it does nothing.
 *
 * @param tag Another tag name. A class has one name only, so the first call decides.
 */
export function defineGlanzViewer(tag = 'glanz-viewer'): void {
  if (typeof customElements === 'undefined' || customElements.get(tag)) return;
  customElements.define(tag, glanzViewerClass() as unknown as CustomElementConstructor);
}

declare global {
  interface HTMLElementTagNameMap {
    'glanz-viewer': GlanzViewerElement;
  }
}
