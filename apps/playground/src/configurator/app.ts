import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { createViewer, type Viewer } from '@glanz/viewer';
import { frameCamera, type Scene } from '@glanz/scene';
import { describeError, isAbort } from '../errors';
import { LIMITS } from '../state/limits';
import { byId, element } from '../ui/elements';
import { Messages } from '../ui/messages';
import type { RenderFormat } from '../ui/render-dialog';
import { assemble, assemblyOf, type Assembly } from './assembly';
import {
  CATALOGUE,
  choicesOf,
  chosen,
  combinations,
  FEATURES,
  sentence,
  usual,
  type Configuration,
  type FeatureName,
} from './catalogue';
import { OptionsForm } from './options-form';
import { orderCode, parseOrderCode } from './order-code';

/** From the button towards the camera. */
const PRODUCT = [0.7, 0.4, 0.6] as const;
const VIEWS = { front: [0, 0.0001, 1], side: [1, 0.12, 0.12], back: [0.62, 0.32, -1] } as const;

const FORMATS: readonly RenderFormat[] = [
  { id: 'png', title: 'PNG', extension: 'png', type: 'image/png', alpha: true },
  { id: 'jpeg', title: 'JPEG', extension: 'jpg', type: 'image/jpeg', alpha: false },
  { id: 'webp', title: 'WebP', extension: 'webp', type: 'image/webp', alpha: true },
  { id: 'exr', title: 'EXR, linear', extension: 'exr', type: 'image/x-exr', alpha: true },
];

/** The image is sharp from here on: enough for a catalogue. */
const SAMPLES = 512;

const number = (text: string | null, low: number, high: number, initial: number): number => {
  const value = Number(text ?? Number.NaN);
  return text !== null && value >= low && value <= high ? value : initial;
};

/** The page on which a button is put together. */
export class Configurator {
  readonly #canvas = byId<HTMLCanvasElement>('image');
  readonly #stage = byId('stage');
  readonly #code = byId<HTMLInputElement>('code');
  readonly #messages = new Messages(byId('messages'));
  readonly #form: OptionsForm;
  readonly #viewer: Viewer;
  /** Whether images are denoised, and frames of a view that moves filtered. */
  readonly #denoise: boolean;
  #configuration: Configuration;
  #shown: Assembly | undefined;

  private constructor() {
    const query = new URLSearchParams(location.search);
    this.#configuration = parseOrderCode(location.hash) ?? usual();
    this.#form = new OptionsForm(byId<HTMLFormElement>('options'), (feature, code) =>
      this.choose({ ...this.#configuration, [feature]: code }, feature),
    );
    const scale = query.get('scale');
    this.#denoise = query.get('denoise') !== 'off';
    this.#viewer = createViewer(this.#canvas, {
      samples: Math.round(number(query.get('samples'), ...LIMITS.samples, SAMPLES)),
      maxDepth: Math.round(
        number(query.get('max-depth') ?? query.get('depth'), ...LIMITS.maxDepth, RENDER_OPTIONS.maxDepth.default),
      ),
      environment: 'studio',
      background: 'transparent',
      preview: this.#denoise ? 'auto' : 'raw',
      ...(scale === null ? {} : { pixelRatio: number(scale, 0.05, 2, 1) }),
    });
    byId('count').textContent = `One of ${new Intl.NumberFormat('en').format(combinations())} buttons.`;
    this.#showConfiguration();
    this.#wire();
  }

  /** @param kit All parts of the button, on their way. */
  static async start(kit: Promise<Scene>): Promise<void> {
    const page = new Configurator();
    const scene = await kit;
    // All parts are in this image, so that it stays the same whatever is chosen.
    const aspect = Math.max(1, page.#stage.clientWidth) / Math.max(1, page.#stage.clientHeight);
    await page.#viewer.load(scene, {
      camera: frameCamera(scene, { aspect, direction: PRODUCT, yfov: (25 * Math.PI) / 180, margin: 0.04 }),
    });
    await page.#apply();
    // Until there is something to see, the page says what it is doing.
    await page.#frame();
    page.#stage.dataset['ready'] = '';
    if (page.#denoise) page.#viewer.denoise = (await import('../viewer/denoise')).denoising;
  }

  /** Shows another button and how long the change took. */
  choose(configuration: Configuration, feature?: FeatureName): void {
    const asked = performance.now();
    this.#configuration = configuration;
    this.#showConfiguration();
    history.replaceState(null, '', `#${orderCode(configuration)}`);
    const title = feature
      ? `${CATALOGUE[feature].title}: ${chosen(configuration, feature).title}`
      : sentence(configuration).split(',')[0];
    void this.#apply().then(
      async (edits) => {
        if (edits === 0) return;
        await this.#frame();
        const ms = performance.now() - asked;
        this.#canvas.dataset['price'] = ms.toFixed(1);
        byId('price').replaceChildren(
          element('b', {}, `${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`),
          `${title} `,
          element('span', { id: 'progress' }),
        );
      },
      (error: unknown) =>
        !isAbort(error) &&
        this.#messages.show({ kind: 'error', text: error instanceof Error ? error.message : String(error) }),
    );
  }

  /** Brings what is shown to what is chosen. @returns How many edits of the scene that took. */
  async #apply(): Promise<number> {
    let edits = 0;
    // Compared when its turn comes: several choices in a row become one change.
    const change = this.#viewer.edit(
      async (tracer) => {
        const next = assemblyOf(this.#configuration);
        const before = this.#shown;
        this.#shown = next;
        edits = await assemble(tracer, next, before);
      },
      { key: 'assembly' },
    );
    await change;
    return edits;
  }

  /** The next image on the canvas. */
  #frame(): Promise<void> {
    return new Promise((resolve) => {
      const stop = this.#viewer.on('frame', () => {
        stop();
        resolve();
      });
    });
  }

  #showConfiguration(): void {
    const code = orderCode(this.#configuration);
    this.#form.show(this.#configuration);
    byId('sentence').textContent = sentence(this.#configuration);
    this.#code.value = code;
    this.#code.removeAttribute('aria-invalid');
    this.#canvas.dataset['code'] = code;
    document.title = `${code} – push-button configurator`;
  }

  #wire(): void {
    const { dataset } = this.#canvas;
    this.#viewer.on('state', ({ state }) => (dataset['state'] = state));
    this.#viewer.on('sample', ({ samples, target }) => {
      dataset['samples'] = String(samples);
      const progress = document.getElementById('progress');
      if (progress) progress.textContent = samples < target ? `· ${samples} of ${target} samples` : '· finished';
    });
    this.#viewer.on('error', ({ message, code, retry }) => {
      this.#messages.show({
        kind: 'error',
        text: message,
        code,
        ...(retry ? { action: { title: 'Try again', run: retry } } : {}),
      });
    });
    this.#viewer.on('warning', ({ message, code }) => this.#messages.show({ kind: 'note', text: message, code }));
    this.#viewer.on('frame', ({ denoised }) => (dataset['denoised'] = String(denoised)));
    this.#viewer.on('device-restored', () => this.#messages.clearErrors());
    this.#code.addEventListener('change', () => {
      const configuration = parseOrderCode(this.#code.value);
      if (configuration) this.choose(configuration);
      else this.#code.setAttribute('aria-invalid', 'true');
    });
    window.addEventListener('hashchange', () => {
      const configuration = parseOrderCode(location.hash);
      if (configuration) this.choose(configuration);
    });
    for (const button of document.querySelectorAll<HTMLElement>('[data-view]')) {
      button.addEventListener('click', () => {
        const view = button.dataset['view'] as keyof typeof VIEWS | 'product';
        if (view === 'product') this.#viewer.home();
        else this.#viewer.frame({ direction: VIEWS[view] });
      });
    }
    byId('surprise').addEventListener('click', () => {
      const any = (feature: FeatureName) =>
        choicesOf(feature)[Math.floor(Math.random() * choicesOf(feature).length)]?.code ?? '';
      this.choose(Object.fromEntries(FEATURES.map((feature) => [feature, any(feature)])) as Configuration);
    });
    byId('copy').addEventListener('click', () => void this.#copy());
    byId('save').addEventListener(
      'click',
      () =>
        void this.#save().catch((error: unknown) =>
          this.#messages.show({ kind: 'error', text: describeError(error).message, code: describeError(error).code }),
        ),
    );
  }

  async #copy(): Promise<void> {
    const link = `${location.origin}${location.pathname}#${orderCode(this.#configuration)}`;
    try {
      await navigator.clipboard.writeText(link);
      this.#messages.show({ kind: 'note', text: 'The link to this button is on the clipboard.' });
    } catch {
      this.#messages.show({ kind: 'note', text: `The link to this button: ${link}` });
    }
  }

  async #save(): Promise<void> {
    const { showRenderDialog } = await import('../ui/render-dialog');
    const viewer = this.#viewer;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.#canvas.clientWidth, this.#canvas.clientHeight].map((side) =>
      Math.max(1, Math.round(side * ratio)),
    );
    showRenderDialog({
      name: orderCode(this.#configuration).toLowerCase(),
      screen: [width as number, height as number],
      samples: viewer.samples,
      noise: 0,
      transparent: true,
      formats: FORMATS,
      render: ({ format, noise, transparent, ...request }) => {
        const { type } = FORMATS.find(({ id }) => id === format) as RenderFormat;
        return viewer.toBlob({
          ...request,
          type,
          background: transparent ? 'transparent' : 'environment',
          ...(noise === undefined ? {} : { noise }),
        });
      },
    });
  }
}
