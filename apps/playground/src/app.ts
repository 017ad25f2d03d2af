import { yieldToEventLoop, type Camera, type Scene } from '@glanz/scene';
import { controlCamera } from '@glanz/viewer/controls';
import { fitCamera } from '@glanz/viewer/fit-camera';
import { describeError, isAbort } from './errors';
import { Environments } from './input/environments';
import {
  isSample,
  linkOfPage,
  nameOf,
  open,
  sampleTitle,
  stateFor,
  type Opened,
  type OpenedLink,
} from './input/opening';
import type { ModelRequest } from './input/load-messages';
import { SAMPLES } from './input/samples';
import { wireFiles } from './input/wire-files';
import { chosenParts, Selection, toggled } from './selection';
import { stateFromQuery } from './state/address';
import { keepAddress } from './state/keep-address';
import type { State } from './state/state';
import { Store } from './state/store';
import type { Context } from './ui/context';
import { byId, element } from './ui/elements';
import { Messages } from './ui/messages';
import { StatusLine } from './ui/status-line';
import { wireTabs } from './ui/tabs';
import { wireTheme } from './ui/theme';
import { Backdrop } from './viewer/backdrop';
import { CameraRig } from './viewer/camera-rig';
import { applyChange, present, type EffectsHost } from './viewer/effects';
import { filmSize } from './viewer/film-size';
import type { Outline } from './viewer/outline';
import type { Posing } from './viewer/posing';
import { wireCommands } from './ui/commands';
import { Session, type SessionStatus } from './viewer/session';
import { chosenInVariant, assignedMaterial } from './viewer/assigned-material';

/** The page: joins controls, files and the session. */
export class App {
  readonly #canvas = byId<HTMLCanvasElement>('image');
  readonly #stage = byId('stage');
  readonly #model = byId<HTMLSelectElement>('model');
  readonly #messages = new Messages(byId('messages'));
  readonly #status = new StatusLine(this.#canvas);
  readonly #environments = new Environments();
  readonly #selection = new Selection();
  readonly #store: Store<State>;
  readonly #rig: CameraRig;
  readonly #backdrop: Backdrop;
  readonly #modelListeners: (() => void)[] = [];
  readonly #environmentListeners: (() => void)[] = [];
  readonly #viewListeners: (() => void)[] = [];
  readonly #statusListeners: ((status: SessionStatus) => void)[] = [];
  #session!: Session;
  #outline: Outline | undefined;
  #opened: Opened | undefined;
  #link: OpenedLink | undefined;
  #loading: AbortController | undefined;
  #posing: Promise<Posing> | undefined;
  #context: Promise<Context> | undefined;
  /** Whether the last click or key on the image adds to the selection. */
  #adding = false;

  private constructor() {
    const { state } = stateFromQuery(location.search);
    this.#store = new Store(state, ['orbit', 'layer']);
    this.#rig = new CameraRig(this.#store, () => this.#aspect());
    this.#backdrop = new Backdrop(this.#stage, byId<HTMLCanvasElement>('backdrop'));
    this.#model.append(
      ...Object.entries(SAMPLES).map(([name, { title }]) => element('option', { value: name }, title)),
    );
    wireTheme();
    wireTabs(() => undefined);
  }

  /**
   * Starts the page.
   *
   * @param early The model of the address, which is loaded while scripts arrive; `problem` says why it is another one.
   * @throws {DeviceError} without WebGPU.
   */
  static async start(early: {
    readonly request: ModelRequest;
    readonly scene: Promise<Scene>;
    readonly problem?: unknown;
  }): Promise<void> {
    const app = new App();
    const link = (app.#link = await linkOfPage());
    app.#environments.expect(link?.files?.environment ?? '');
    const { exposure, toneMap, samples, noise, layer, denoise } = { ...app.#store.state, ...app.#link?.state };
    app.#session = await Session.create(
      app.#canvas,
      byId<HTMLCanvasElement>('layer-image'),
      { exposure, toneMap, samples, noise, layer, denoise },
      {
        step: (seconds) => app.#step(seconds),
        moving: () => app.#rig.moving,
        camera: (aspect) => app.#cameraFor(aspect),
      },
      {
        onStatus: (status) => app.#showStatus(status),
        onError: (error, retry) => app.#fail(error, retry),
        onRecovered: (samples) => {
          app.#messages.clearErrors();
          const now = samples > 0 ? `keeps its ${samples} samples` : 'starts from the first sample';
          app.#messages.show({
            kind: 'note',
            text: `The GPU was lost and has been restored; the image ${now}.`,
            code: 'playground/recovered',
          });
        },
        onShown: (ms) => (app.#canvas.dataset['shownAfter'] = ms.toFixed(1)),
      },
    );
    app.#wire();
    app.#resize();
    const requested = app.#link && isSample(app.#link.model) ? app.#link.model : undefined;
    if (requested && early.request.kind === 'sample' && requested !== early.request.name)
      await app.load({ kind: 'sample', name: requested });
    else await app.load(early.request, early.scene);
    if (early.problem) app.#fail(early.problem);
    if (link?.note) app.#messages.show({ kind: 'note', text: link.note, code: 'playground/link-file', stays: true });
    keepAddress(
      app.#store,
      () => app.#opened?.name,
      () => app.#environments.fileName,
    );
    // Another link was put into the address.
    window.addEventListener('hashchange', () => location.reload());
  }

  #host(): EffectsHost {
    return {
      session: this.#session,
      rig: this.#rig,
      scene: () => this.#opened?.scene,
      state: () => this.#store.state,
      environment: (state, scene) => this.#environments.choose(state, scene),
      onError: (error) => this.#fail(error),
    };
  }

  #wire(): void {
    const host = this.#host();
    for (const type of ['pointerup', 'keydown'] as const)
      this.#canvas.addEventListener(
        type,
        ({ ctrlKey, metaKey, shiftKey }) => (this.#adding = ctrlKey || metaKey || shiftKey),
        true,
      );
    new ResizeObserver(() => this.#resize()).observe(this.#stage);
    const at = (x: number, y: number) => [x / this.#canvas.clientWidth, y / this.#canvas.clientHeight] as const;
    controlCamera(
      this.#canvas,
      {
        orbit: (yaw, pitch) => this.#rig.move((orbit) => orbit.orbit(yaw, pitch)),
        pan: (right, up) => this.#rig.move((orbit) => orbit.pan(right, up)),
        zoom: (factor) => this.#rig.move((orbit) => orbit.zoom(factor)),
        home: () => this.#rig.choose(this.#store.state.camera),
        pick: (x, y) => this.#pick(...at(x, y)),
        focus: (x, y) => {
          const hit = this.#session.pick(...at(x, y));
          if (hit) this.#rig.move((orbit) => orbit.focus(hit.position));
        },
      },
      // The key frames the chosen part.
      { focus: 'pointer' },
    );
    this.#store.subscribe((next, before, source) => {
      if (source !== 'load') applyChange(next, before, host);
      else {
        this.#rig.follow(true);
        this.#session.look();
      }
      // Light and finishing leave shapes where they are.
      if (
        next.camera !== before.camera ||
        next.orbit !== before.orbit ||
        next.lens !== before.lens ||
        next.hidden !== before.hidden ||
        next.moves !== before.moves
      )
        this.#outline?.clear();
      if (next.scale !== before.scale) this.#resize();
      // Further edits apply to what is seen.
      if (next.variant !== before.variant && source !== 'load' && this.#opened)
        this.#selection.choose(
          chosenInVariant(this.#opened.scene, this.#selection.chosen, before.variant, next.variant),
        );
      this.#drawBackdrop();
    });
    this.#model.addEventListener('change', () => {
      const { value } = this.#model;
      if (isSample(value)) void this.load({ kind: 'sample', name: value });
    });
    wireFiles({
      onFiles: (files) => void this.#open(files),
      onPreset: (name, x, y) => void this.#dropPreset(name, x, y),
    });
    wireCommands({
      store: this.#store,
      session: this.#session,
      rig: this.#rig,
      selection: this.#selection,
      canvas: this.#canvas,
      say: (text) => this.#say(text),
    });
  }

  /** Opens what was dropped or picked. */
  async #open(files: ReadonlyMap<string, File> | Promise<ReadonlyMap<string, File>>): Promise<void> {
    try {
      const { openFiles } = await import('./input/open-files');
      await openFiles(
        {
          store: this.#store,
          session: this.#session,
          selection: this.#selection,
          environments: this.#environments,
          scene: () => this.#opened?.scene,
          load: (request) => this.load(request),
          onEnvironmentFile: () => this.#environmentListeners.forEach((listener) => listener()),
          clearErrors: () => this.#messages.clearErrors(),
          show: (message) => this.#messages.show(message),
        },
        await files,
      );
    } catch (error) {
      this.#fail(error);
    }
  }

  /** Loads and shows a model. Until it is ready, and where it fails, the former one stays. */
  async load(request: ModelRequest, early?: Promise<Scene>, state?: State): Promise<void> {
    this.#loading?.abort(new DOMException('another model was asked for', 'AbortError'));
    const loading = (this.#loading = new AbortController());
    const { signal } = loading;
    const title =
      request.kind === 'sample' ? sampleTitle(request.name) : (request.entry.split('/').at(-1) ?? request.entry);
    try {
      this.#status.prepare(request.kind === 'sample' ? 'make' : 'read');
      const opened: Opened = early
        ? { scene: await early, request, title, name: nameOf(request) }
        : await open(request, title, {
            signal,
            compressedFormats: await this.#session.compressedFormats(),
            onProgress: (stage, done) => this.#status.prepare(stage, done),
          });
      signal.throwIfAborted();
      const { scene } = opened;
      const first = this.#opened === undefined;
      const begin = state ?? stateFor(scene, request, this.#store.state, { link: this.#link, first });
      // What is changed until the image is ready is applied on top.
      const from = this.#store.state;
      const now = (): State =>
        this.#store.state === from ? begin : { ...begin, ...changedSince(from, this.#store.state) };
      const host = this.#host();
      const rig = new CameraRig(this.#store, () => this.#aspect());
      await rig.setScene(scene, begin);
      await this.#environments.prepare(begin, scene);
      signal.throwIfAborted();
      await present(
        scene,
        () => (this.#opened?.scene === scene ? this.#store.state : now()),
        { ...host, rig },
        ({ stage, done }) => this.#status.prepare(stage, done),
      );
      await yieldToEventLoop();
      await this.#adopt(opened, now(), rig);
    } catch (error) {
      this.#fail(error);
      if (this.#loading === loading) this.#model.value = this.#canvas.dataset['sample'] ?? '';
    } finally {
      if (this.#loading === loading) {
        this.#loading = undefined;
        this.#status.prepared();
      }
    }
  }

  /**
   * Brings the page in line with the model that is shown now, a panel at a time: together they would take more than a
   * frame.
   */
  async #adopt(opened: Opened, state: State, rig: CameraRig): Promise<void> {
    const { scene, request, title } = opened;
    const again = this.#opened?.request === request;
    this.#opened = opened;
    this.#rig.adopt(rig);
    this.#messages.clearErrors();
    if (again) this.#store.set(state);
    else this.#store.load(state);
    const { exposure, toneMap, samples, noise, layer } = state;
    this.#session.setView({ exposure, toneMap, samples, noise, layer }).catch((error: unknown) => this.#fail(error));
    if (this.#link?.model === opened.name) this.#link = undefined;
    const replaced = async () => {
      await yieldToEventLoop();
      return this.#opened?.request !== request;
    };
    if (await replaced()) return;
    if (!again) this.#selection.choose({ material: scene.instances[0]?.material ?? 0 });
    if (await replaced()) return;
    const sample = request.kind === 'sample' ? request.name : undefined;
    this.#model.querySelector('option[data-file]')?.remove();
    if (!sample) this.#model.append(element('option', { value: '(file)', 'data-file': true }, title));
    this.#model.value = sample ?? '(file)';
    this.#canvas.dataset['sample'] = this.#model.value;
    this.#canvas.setAttribute('aria-label', `Path-traced image of ${title}`);
    document.title = `${title} – Glanz playground`;
    if (scene.warnings.length > 0) {
      const more = scene.warnings.length > 1 ? ` (and ${scene.warnings.length - 1} more, under Statistics)` : '';
      this.#messages.show({
        kind: 'note',
        text: `${scene.warnings[0]?.message ?? ''}${more}`,
        code: scene.warnings[0]?.code ?? '',
      });
    }
    for (const listener of this.#modelListeners) {
      if (await replaced()) return;
      listener();
    }
    this.#canvas.dataset['scene'] = title;
    this.#drawBackdrop();
    this.#context ??= this.#makePanels();
    this.#context.catch((error: unknown) => this.#fail(error));
  }

  async #makePanels(): Promise<Context> {
    const context: Context = {
      store: this.#store,
      selection: this.#selection,
      session: this.#session,
      rig: this.#rig,
      environments: this.#environments,
      opened: () => this.#opened as Opened,
      onModel: (listener) => this.#modelListeners.push(listener),
      onEnvironmentFile: (listener) => this.#environmentListeners.push(listener),
      onStatus: (listener) => this.#statusListeners.push(listener),
      openFiles: (files) => void this.#open(files),
      pickFiles: () => byId('files').click(),
      load: (request) => this.load(request),
      pose: () => this.#pose(),
      say: (text) => this.#say(text),
      fail: (error) => this.#fail(error),
      camera: () => this.#cameraFor(this.#aspect()),
      onView: (listener) => this.#viewListeners.push(listener),
      stageSize: () => [this.#stage.clientWidth, this.#stage.clientHeight],
    };
    const [{ makePanels }, { Outline }] = await Promise.all([import('./ui/panels'), import('./viewer/outline')]);
    const outline = (this.#outline = new Outline(byId<HTMLCanvasElement>('outline'), this.#session));
    this.#selection.subscribe((chosen) => outline.show(chosenParts(chosen)));
    outline.show(chosenParts(this.#selection.chosen));
    const backdropFor = (aspect: number, camera = this.#cameraFor(aspect)) => {
      const { state } = this.#store;
      return this.#backdrop.rendered(state, this.#environments.choose(state, this.#opened?.scene), camera, aspect);
    };
    makePanels(context, () => this.#backdrop.saved(this.#store.state), backdropFor);
    document.body.dataset['panels'] = 'ready';
    return context;
  }

  /** The model in the pose that the state says. @returns Whether there is a model to pose, and it has been. */
  async #pose(): Promise<boolean> {
    this.#posing ??= import('./viewer/posing').then(
      ({ Posing }) =>
        new Posing({
          effects: this.#host(),
          opened: () => this.#opened,
          setPosed: (opened) => {
            this.#opened = opened;
            this.#rig.pose(opened.scene);
            this.#outline?.clear();
          },
          load: (request, state) => this.load(request, undefined, state),
        }),
    );
    return (await this.#posing).pose();
  }

  async #dropPreset(name: string, x: number, y: number): Promise<void> {
    const picked = this.#session.pick(x, y);
    if (!picked || !this.#context) return;
    const [{ applyPreset }, context] = await Promise.all([import('./ui/material/presets'), this.#context]);
    this.#selection.choose({ material: picked.material, instance: picked.instance });
    applyPreset(context, [picked.material], name);
  }

  #pick(x: number, y: number): void {
    const picked = this.#session.pick(x, y);
    const part = picked && this.#opened?.scene.instances[picked.instance];
    if (!picked || !part) return;
    if (this.#canvas.classList.contains('focusing')) {
      const { lens } = this.#store.state;
      // A pinhole has nothing out of focus: the first click opens it.
      this.#store.set({ lens: { ...lens, focus: picked.depth, stop: lens.stop || 2.8 } }, { label: 'Focus' });
      return;
    }
    const { scene } = this.#opened!;
    const materialOf = (index: number) => assignedMaterial(scene, index, this.#store.state.variant);
    this.#selection.choose(
      this.#adding
        ? toggled(this.#selection.chosen, picked.instance, materialOf)
        : { material: materialOf(picked.instance), instance: picked.instance },
    );
    this.#canvas.dataset['picked'] = part.name || `part ${picked.instance + 1}`;
  }

  #aspect(): number {
    return Math.max(1, this.#stage.clientWidth) / Math.max(1, this.#stage.clientHeight);
  }

  /** The camera as it is now, for an image of this width over height. */
  #cameraFor(aspect: number): Camera {
    const { now } = this.#rig;
    const [width, height] = this.#session.film;
    // The film on the screen has the stage's shape, but for the rounding of its pixels.
    return aspect === width / height
      ? now
      : fitCamera(now.type === 'perspective' ? { ...now, aspect: this.#aspect() } : now, aspect);
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#stage;
    if (width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    const { scale, orbit } = this.#store.state;
    this.#outline?.clear();
    this.#session.resize(filmSize(width, height, scale, ratio), filmSize(width, height, 'device', ratio));
    // A first view fits the window; one that was turned stays.
    if (this.#opened && !orbit) this.#rig.follow(true);
    this.#drawBackdrop();
  }

  #step(seconds: number): boolean {
    const moved = this.#rig.step(seconds);
    if (moved) this.#drawBackdrop();
    return moved;
  }

  #drawBackdrop(): void {
    const scene = this.#opened?.scene;
    if (scene)
      this.#backdrop.draw(
        this.#store.state,
        () => this.#environments.choose(this.#store.state, scene),
        () => this.#rig.now,
        this.#aspect(),
      );
    for (const listener of this.#viewListeners) listener();
  }

  #showStatus(status: SessionStatus): void {
    this.#status.show(status);
    if (status.state === 'done' || status.state === 'paused') this.#outline?.settled();
    for (const listener of this.#statusListeners) listener(status);
  }

  #say(text: string): void {
    this.#messages.show({ kind: 'note', text });
  }

  #fail(error: unknown, retry?: () => void): void {
    if (isAbort(error)) return;
    const { message, code } = describeError(error);
    // A tracer that cannot keep the lights apart is not asked for again.
    if (code === 'renderer/light-groups' && this.#store.state.relight) this.#store.set({ relight: false });
    this.#messages.show({
      kind: 'error',
      text: message,
      code,
      ...(retry ? { action: { title: 'Try again', run: retry } } : {}),
    });
  }
}

/** Fields in which a later state differs. */
const changedSince = (before: State, now: State): Partial<State> =>
  Object.fromEntries(
    (Object.keys(now) as (keyof State)[]).filter((name) => now[name] !== before[name]).map((name) => [name, now[name]]),
  ) as Partial<State>;
