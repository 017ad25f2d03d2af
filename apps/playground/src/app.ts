import type { PickResult, PrepareProgress } from '@glanz/renderer';
import { frameCamera, sceneBounds, type Camera, type Scene } from '@glanz/scene';
import { describeError, isAbort } from './errors';
import { Environments } from './input/environments';
import { filesOfDrop, filesOfInput, sortFiles } from './input/files';
import { loadScene } from './input/load-scene';
import type { LoadRequest } from './input/load-messages';
import { SAMPLES, type SampleName } from './input/samples';
import { download, fileName, pictureAsExr, pictureAsPng } from './output/save';
import { settingsFromAddress, type EnvironmentChoice, type Settings } from './settings';
import { byId, element } from './ui/elements';
import { MaterialPanel } from './ui/material-panel';
import { Messages } from './ui/messages';
import { SettingsPanel } from './ui/settings-panel';
import { spokenRate, spokenTime, StatisticsPanel } from './ui/statistics';
import { controlCamera } from './viewer/camera-controls';
import { filmSize } from './viewer/film-size';
import { fitCamera, OrbitCamera } from './viewer/orbit-camera';
import { Session, type SessionStatus } from './viewer/session';

const STAGES: Readonly<Record<string, string>> = {
  read: 'Reading the model',
  decode: 'Decoding the model',
  images: 'Decoding textures',
  bvh: 'Building the hierarchy',
  upload: 'Uploading to the GPU',
  compile: 'Compiling shaders',
};

/** The page: joins controls, files and the session. */
export class App {
  readonly #canvas = byId<HTMLCanvasElement>('picture');
  readonly #stage = byId('stage');
  readonly #model = byId<HTMLSelectElement>('model');
  readonly #messages = new Messages(byId('messages'));
  readonly #statistics = new StatisticsPanel();
  readonly #environments = new Environments();
  readonly #settings: Settings;
  readonly #panel: SettingsPanel;
  readonly #materials: MaterialPanel;
  #session!: Session;
  #scene: Scene | undefined;
  #title = '';
  #orbit: OrbitCamera | undefined;
  /** Index into the scene's cameras; −1 frames the whole scene. */
  #camera = -1;
  #loading: AbortController | undefined;

  private constructor() {
    this.#settings = settingsFromAddress(location.search);
    this.#panel = new SettingsPanel(this.#settings, { onChange: (change) => this.#changed(change), onCamera: (index) => this.#chooseCamera(index), onPickFile: () => byId('files').click() });
    this.#materials = new MaterialPanel({ onChange: (index, change) => this.#session.setMaterial(index, change) });
    byId('picture-fields').append(this.#panel.picture);
    byId('environment-fields').append(this.#panel.environment);
    byId('material-panel').append(this.#materials.element);
    byId('statistics-panel').append(this.#statistics.element);
    this.#model.append(...Object.entries(SAMPLES).map(([name, { title }]) => element('option', { value: name }, title)));
    this.#model.value = this.#settings.model;
  }

  /** @throws {DeviceError} without WebGPU. */
  static async start(): Promise<void> {
    const app = new App();
    const { exposure, toneMap, samples, depth, background, layer } = app.#settings;
    app.#session = await Session.create(
      app.#canvas,
      { exposure, toneMap, samples, depth, background, layer },
      {
        onStatus: (status) => app.#showStatus(status),
        onError: (error, retry) => app.#fail(error, retry),
        onRecovered: () => {
          app.#messages.clearErrors();
          app.#messages.show({ kind: 'note', text: 'The GPU was lost and is back; the picture starts anew.', code: 'playground/recovered' });
          app.#showStatistics();
        },
      },
    );
    app.#wire();
    app.#resize();
    await app.#loadSample(app.#settings.model);
  }

  #wire(): void {
    new ResizeObserver(() => this.#resize()).observe(this.#stage);
    controlCamera(this.#canvas, {
      orbit: (yaw, pitch) => this.#move((orbit) => orbit.orbit(yaw, pitch)),
      pan: (right, up) => this.#move((orbit) => orbit.pan(right, up)),
      zoom: (factor) => this.#move((orbit) => orbit.zoom(factor)),
      home: () => this.#chooseCamera(this.#camera),
      pick: (x, y) => this.#pick(x / this.#canvas.clientWidth, y / this.#canvas.clientHeight),
    });
    this.#canvas.addEventListener('keydown', (event) => {
      if (event.key !== ' ') return;
      event.preventDefault();
      this.#pause();
    });
    byId('pause').addEventListener('click', () => this.#pause());
    byId('home').addEventListener('click', () => this.#chooseCamera(this.#camera));
    byId('save-png').addEventListener('click', (event) => void this.#save(event.currentTarget as HTMLButtonElement, 'png'));
    byId('save-exr').addEventListener('click', (event) => void this.#save(event.currentTarget as HTMLButtonElement, 'exr'));
    this.#model.addEventListener('change', () => {
      if (Object.hasOwn(SAMPLES, this.#model.value)) void this.#loadSample(this.#model.value as SampleName);
    });
    for (const [button, input] of [['open', 'files'], ['open-folder', 'folder']] as const) {
      const picker = byId<HTMLInputElement>(input);
      byId(button).addEventListener('click', () => picker.click());
      picker.addEventListener('change', () => {
        const files = filesOfInput(picker);
        // So that the same file can be chosen again.
        picker.value = '';
        if (files.size > 0) void this.#open(Promise.resolve(files));
      });
    }
    this.#acceptDrops();
  }

  #acceptDrops(): void {
    const drop = byId('drop');
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    window.addEventListener('dragover', (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      drop.hidden = false;
    });
    window.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) drop.hidden = true;
    });
    window.addEventListener('drop', (event) => {
      drop.hidden = true;
      if (!event.dataTransfer || !hasFiles(event)) return;
      event.preventDefault();
      void this.#open(filesOfDrop(event.dataTransfer));
    });
  }

  /** Opens what was dropped or picked: a model, surroundings, or both. */
  async #open(given: Promise<ReadonlyMap<string, File>>): Promise<void> {
    try {
      const { model, environment } = sortFiles(await given);
      if (environment) {
        await this.#environments.load(environment);
        this.#settings.environment = 'file';
        this.#panel.setEnvironmentFile(this.#environments.fileName);
        this.#panel.set(this.#settings);
        this.#messages.clearErrors();
        if (!model) this.#session.setEnvironment(this.#environments.choose(this.#settings, this.#scene));
      }
      if (model) await this.#load({ kind: 'files', files: model.files, entry: model.entry }, model.entry.split('/').at(-1) ?? model.entry);
    } catch (error) {
      this.#fail(error);
    }
  }

  async #loadSample(name: SampleName): Promise<void> {
    const first = this.#scene === undefined;
    await this.#load({ kind: 'sample', name }, SAMPLES[name].title.split(' · ')[0] as string, name, first ? this.#settings.environment : SAMPLES[name].environment);
  }

  /**
   * Loads and shows a model. Until it is ready, and where it fails, the former one stays.
   *
   * @param sample Name of a built-in model, to be chosen in the list.
   * @param environment The surroundings that suit it; those of a file stay.
   */
  async #load(request: LoadRequest, title: string, sample?: SampleName, environment?: EnvironmentChoice): Promise<void> {
    this.#loading?.abort(new DOMException('another model was asked for', 'AbortError'));
    const loading = (this.#loading = new AbortController());
    const settings = this.#settings;
    try {
      this.#showPreparing(sample ? 'Making the model' : 'Reading the model');
      const scene = await loadScene(request, { signal: loading.signal, onProgress: (stage, done) => this.#showPreparing(STAGES[stage] ?? stage, done) });
      const wanted = environment ?? (scene.environment ? 'model' : settings.environment === 'none' || settings.environment === 'model' ? 'studio' : settings.environment);
      const choice = settings.environment === 'file' ? 'file' : wanted;
      const own = scene.environment;
      const chosen = this.#environments.choose({ ...settings, environment: choice }, scene);
      const { environment: _, ...rest } = scene;
      const camera = this.#startCamera(scene, scene.cameras.length > 0 ? 0 : -1);
      await this.#session.show({ scene: chosen ? { ...rest, environment: chosen } : rest, camera }, (progress) => this.#prepared(progress));
      this.#scene = own ? { ...rest, environment: own } : rest;
      this.#title = title;
      settings.environment = choice;
      this.#adopt(sample);
    } catch (error) {
      this.#fail(error);
      if (this.#loading === loading) this.#model.value = this.#canvas.dataset['sample'] ?? '';
    } finally {
      if (this.#loading === loading) {
        this.#loading = undefined;
        byId('preparing').hidden = true;
      }
    }
  }

  /** Brings the controls in line with the scene that is shown now. */
  #adopt(sample: SampleName | undefined): void {
    const scene = this.#scene as Scene;
    this.#messages.clearErrors();
    this.#camera = scene.cameras.length > 0 ? 0 : -1;
    this.#orbit = undefined;
    this.#panel.set(this.#settings);
    this.#panel.setCameras(scene.cameras, this.#camera);
    this.#panel.setHasOwnEnvironment(scene.environment !== undefined);
    this.#materials.setMaterials(scene.materials);
    this.#showStatistics();
    this.#model.querySelector('option[data-file]')?.remove();
    if (!sample) this.#model.append(element('option', { value: '(file)', 'data-file': true }, this.#title));
    this.#model.value = sample ?? '(file)';
    this.#canvas.dataset['sample'] = this.#model.value;
    this.#canvas.dataset['scene'] = this.#title;
    this.#canvas.setAttribute('aria-label', `Path-traced picture of ${this.#title}`);
    document.title = `${this.#title} – Glanz playground`;
    if (scene.warnings.length > 0) {
      const more = scene.warnings.length > 1 ? ` (and ${scene.warnings.length - 1} more, under Statistics)` : '';
      this.#messages.show({ kind: 'note', text: `${scene.warnings[0]?.message ?? ''}${more}`, code: scene.warnings[0]?.code ?? '' });
    }
  }

  #aspect(): number {
    return Math.max(1, this.#stage.clientWidth) / Math.max(1, this.#stage.clientHeight);
  }

  #startCamera(scene: Scene, index: number): Camera {
    const aspect = this.#aspect();
    const camera = scene.cameras[index];
    return camera ? fitCamera(camera, aspect) : frameCamera(scene, { aspect });
  }

  #chooseCamera(index: number): void {
    this.#camera = index;
    this.#orbit = undefined;
    if (this.#scene) this.#session.setCamera(this.#startCamera(this.#scene, index), false);
  }

  #move(change: (orbit: OrbitCamera) => void): void {
    if (!this.#scene) return;
    this.#orbit ??= new OrbitCamera(this.#startCamera(this.#scene, this.#camera), sceneBounds(this.#scene));
    change(this.#orbit);
    this.#session.setCamera(this.#orbit.camera(), true);
  }

  #pick(x: number, y: number): void {
    const picked: PickResult | undefined = this.#session.pick(x, y);
    if (!picked || !this.#scene) return;
    const part = this.#scene.instances[picked.instance]?.name || `part ${picked.instance + 1}`;
    this.#materials.select(picked.material, part);
    this.#canvas.dataset['picked'] = part;
  }

  #pause(): void {
    const paused = !this.#session.paused;
    this.#session.setPaused(paused);
    byId('pause').setAttribute('aria-pressed', String(paused));
  }

  #changed(change: Partial<Settings>): void {
    Object.assign(this.#settings, change);
    const { exposure, toneMap, samples, depth, background, layer } = this.#settings;
    this.#canvas.classList.toggle('transparent', background === 'transparent');
    this.#session.setView({ exposure, toneMap, samples, depth, background, layer }).catch((error: unknown) => this.#fail(error));
    if ('scale' in change) this.#resize();
    if (['environment', 'constant', 'intensity', 'rotation'].some((name) => name in change)) this.#session.setEnvironment(this.#environments.choose(this.#settings, this.#scene));
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#stage;
    if (width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    this.#session.resize(filmSize(width, height, this.#settings.scale, ratio), filmSize(width, height, 'device', ratio));
    if (this.#scene && !this.#orbit) this.#session.setCamera(this.#startCamera(this.#scene, this.#camera), false);
    this.#showStatistics();
  }

  async #save(button: HTMLButtonElement, format: 'png' | 'exr'): Promise<void> {
    const { tracer } = this.#session;
    if (!tracer) return;
    button.disabled = true;
    try {
      const { exposure, toneMap } = this.#settings;
      const bytes = format === 'png' ? await pictureAsPng(tracer, { exposure, toneMap }) : await pictureAsExr(tracer);
      download(bytes, `${fileName(this.#title)}.${format}`, format === 'png' ? 'image/png' : 'image/x-exr');
    } catch (error) {
      this.#fail(error);
    } finally {
      button.disabled = false;
    }
  }

  #prepared({ stage, done }: PrepareProgress): void {
    this.#showPreparing(STAGES[stage] ?? stage, done);
  }

  #showPreparing(text: string, done?: number): void {
    byId('preparing').hidden = false;
    byId('preparing-text').textContent = text;
    const bar = byId<HTMLProgressElement>('preparing-bar');
    if (done === undefined) bar.removeAttribute('value');
    else bar.value = done;
  }

  #showStatus({ state, samples, target, samplesPerSecond }: SessionStatus): void {
    const { dataset } = this.#canvas;
    dataset['state'] = state;
    dataset['samples'] = String(samples);
    dataset['target'] = String(target);
    const bar = byId<HTMLProgressElement>('done');
    bar.value = target > 0 ? Math.min(1, samples / target) : 0;
    bar.hidden = state !== 'rendering' && state !== 'paused';
    const count = `${samples} of ${target} samples`;
    const left = samplesPerSecond > 0 ? ` · ${spokenRate(samplesPerSecond)} · ${spokenTime(((target - samples) / samplesPerSecond) * 1000)} left` : '';
    const texts = { empty: '', preparing: '', rendering: `${count}${left}`, paused: `${count} · paused`, done: `${samples} samples · done`, recovering: 'Waiting for the GPU', failed: 'Stopped' };
    byId('status').textContent = texts[state];
  }

  #showStatistics(): void {
    const { tracer, adapterName } = this.#session;
    if (tracer && this.#scene) this.#statistics.show(this.#scene, tracer.statistics, [tracer.width, tracer.height], adapterName);
  }

  #fail(error: unknown, retry?: () => void): void {
    if (isAbort(error)) return;
    const { message, code } = describeError(error);
    this.#messages.show({ kind: 'error', text: message, code, ...(retry ? { action: { title: 'Try again', run: retry } } : {}) });
  }
}
