import type { Blas } from '@glanz/bvh';
import { RefitQuality } from '@glanz/bvh/refit-quality';
import { refitBlas } from '@glanz/bvh/refit';
import { openAnimations, type PoseChange, type ScenePoser } from '@glanz/gltf/animation';
import type { PathTracer } from '@glanz/renderer';
import type { Scene, SceneAnimation } from '@glanz/scene';
import { abortError, isAbort, isLoss } from './aborts';
import type { Emitter } from './emitter';
import type { Engine } from './engine';
import { ViewerError } from './errors';
import type { ViewerEvents } from './events';
import type { RefitHierarchy } from './hierarchies';
import { placed, placedLight } from './stage';
import {
  filesOf,
  isFiles,
  meshoptDecoder,
  OTHER,
  pathOf,
  sortFiles,
  type GltfSource,
  type LoadModelOptions,
  type ModelSource,
} from './load';

/** Options for {@link AnimationPlayer.play}. */
export interface PlayOptions {
  /** How often the animation plays, a whole number from 1, or `Infinity` (default). Of `pingpong`, each way counts. */
  readonly repetitions?: number;
  /** Plays every second time backwards. Default false. */
  readonly pingpong?: boolean;
}

/** What an {@link AnimationPlayer} works on. */
export interface AnimatedModel {
  /** Where the model is placed in the world; undefined: where its file places it. */
  readonly place: () => readonly number[] | undefined;
  /** Applies a change with the next frame; of several that wait, the last one counts. */
  readonly edit: (change: (tracer: PathTracer) => void | Promise<void>) => Promise<void>;
  /** Opens the animations again, for another tracer's scene of the model. */
  readonly reopen: (scene: Scene) => Promise<ScenePoser>;
  /** Wakes the viewer's loop. */
  readonly wake: () => void;
  readonly emit: <K extends 'play' | 'pause' | 'loop' | 'finished'>(type: K, detail: ViewerEvents[K]) => void;
  readonly failed: (error: unknown) => void;
}

/**
 * The animations of a model that is shown. Frames are previews while one plays, as they are while the camera moves;
 * where it is paused or finished, the image of that pose is refined to its end. Time does not advance while the viewer
 * is not visible. Made by `Viewer.animation()`, for one model: after another `load()` it does nothing.
 */
export class AnimationPlayer {
  readonly #model: AnimatedModel;
  readonly #poser: ScenePoser;
  #name: string | undefined;
  #time = 0;
  /** 1, or −1 on the way back of `pingpong`. */
  #direction = 1;
  #loops = 0;
  #repetitions = Infinity;
  #pingpong = false;
  #playing = false;
  #timeScale = 1;
  #destroyed = false;
  /** Whether meshes of a pose are on their way to the GPU, and whether another pose has been asked for since. */
  #deforming = false;
  #late = false;

  /** @internal Use `Viewer.animation()`. */
  constructor(model: AnimatedModel, poser: ScenePoser) {
    this.#model = model;
    this.#poser = poser;
  }

  /** The model's animations, in the order of its file. Durations are in seconds. */
  get animations(): readonly SceneAnimation[] {
    return this.#poser.animations;
  }

  /** Name of the animation that poses the model; `undefined`: the rest pose, or what the file was loaded in. */
  get name(): string | undefined {
    return this.#name;
  }

  /**
   * Another animation, from its start; whether it plays stays as it is.
   * @throws {ViewerError} `viewer/animation` where the model has no such animation.
   */
  set name(name: string | undefined) {
    if (name === this.#name) return;
    if (name !== undefined && !this.animations.some((one) => one.name === name))
      throw new ViewerError(
        'viewer/animation',
        `The model has no animation ${JSON.stringify(name)}; it has: ${this.animations.map((one) => one.name).join(', ')}.`,
      );
    this.#name = name;
    this.#begin();
    if (name === undefined) this.pause();
    this.#pose();
  }

  /** Seconds of the present animation; 0 without one. */
  get duration(): number {
    return this.animations.find(({ name }) => name === this.#name)?.duration ?? 0;
  }

  /** Seconds from the start of the animation. Set, it is clamped to the {@link duration}. */
  get currentTime(): number {
    return this.#time;
  }

  /** @throws {ViewerError} `viewer/option` for what is not a finite number. */
  set currentTime(seconds: number) {
    if (!Number.isFinite(seconds)) throw notFinite('currentTime', seconds);
    this.#name ??= this.animations[0]?.name;
    this.#time = Math.min(Math.max(seconds, 0), this.duration);
    this.#pose();
  }

  /** Factor of the speed; below 0 it plays backwards. Default 1. */
  get timeScale(): number {
    return this.#timeScale;
  }

  /** @throws {ViewerError} `viewer/option` for what is not a finite number. */
  set timeScale(factor: number) {
    if (!Number.isFinite(factor)) throw notFinite('timeScale', factor);
    this.#timeScale = factor;
  }

  /** Whether no animation plays. */
  get paused(): boolean {
    return !this.#playing;
  }

  /**
   * Plays the present animation, or else the first one, from where it is; from the start where it has finished.
   * @throws {ViewerError} `viewer/option` for repetitions that are no whole number from 1.
   */
  play({ repetitions = Infinity, pingpong = false }: PlayOptions = {}): void {
    if (!(repetitions >= 1 && (repetitions === Infinity || Number.isInteger(repetitions))))
      throw new ViewerError(
        'viewer/option',
        `repetitions is ${String(repetitions)}; it must be a whole number from 1, or Infinity.`,
      );
    if (this.#destroyed) return;
    this.#name ??= this.animations[0]?.name;
    if (this.#loops >= this.#repetitions) this.#begin();
    this.#repetitions = repetitions;
    this.#pingpong = pingpong;
    if (this.#playing) return;
    this.#playing = true;
    this.#model.emit('play', { name: this.#name as string });
    this.#pose();
  }

  /** Stops where it is. */
  pause(): void {
    if (!this.#playing) return;
    this.#playing = false;
    this.#model.emit('pause', { name: this.#name as string });
    this.#model.wake();
  }

  /** @internal Advances by so many seconds. @returns Whether the pose has changed. */
  step(seconds: number): boolean {
    if (!this.#playing) return false;
    // The main thread may have been busy for longer than an animation should jump.
    this.#advance(Math.min(seconds, 1) * this.#timeScale * this.#direction);
    return this.#pose();
  }

  /** @internal What brings another tracer of the model to a pose: of an animation, so many seconds from its start. */
  async poserFor(tracer: PathTracer): Promise<(name: string | undefined, seconds: number) => Promise<void>> {
    const poser = await this.#model.reopen(tracer.scene);
    const place = this.#model.place();
    return async (name, seconds) => {
      const change = poser.pose(name, seconds);
      await Promise.all([...applyPlacements(tracer, change, place), ...applyShapes(tracer, change)]);
    };
  }

  /** @internal Another model is shown. */
  destroy(): void {
    this.#destroyed = true;
    this.#playing = false;
  }

  /** To the start, or the end where it plays backwards. */
  #begin(): void {
    this.#loops = 0;
    this.#direction = 1;
    this.#time = this.#timeScale < 0 ? this.duration : 0;
  }

  #advance(by: number): void {
    const { duration } = this;
    const name = this.#name as string;
    let time = this.#time + by;
    // Several rounds at once, of a short animation and a slow GPU, are counted and not played.
    const crossed =
      duration > 0 ? (time > duration ? Math.floor(time / duration) : time < 0 ? Math.ceil(-time / duration) : 0) : 1;
    if (crossed > 0) {
      const left = this.#repetitions - this.#loops;
      const ends = crossed >= left || duration === 0;
      const rounds = ends ? left : crossed;
      this.#loops += rounds;
      if (ends) {
        // On the way that the last round goes.
        const back = this.#pingpong && (rounds - 1) % 2 === 1;
        time = by > 0 !== back ? duration : 0;
      } else {
        const inside = duration > 0 ? time - Math.floor(time / duration) * duration : 0;
        const turned = this.#pingpong && rounds % 2 === 1;
        if (turned) this.#direction = -this.#direction;
        time = turned ? duration - inside : inside;
      }
      this.#time = time;
      if (ends) {
        this.#playing = false;
        this.#model.emit('finished', { name });
      } else this.#model.emit('loop', { name, count: this.#loops });
    } else this.#time = time;
  }

  /** Shows the pose of the present time with the next frame. @returns Whether it will. */
  #pose(): boolean {
    if (this.#destroyed) return false;
    if (this.#deforming) {
      this.#late = true;
      return false;
    }
    this.#model.edit((tracer) => this.#apply(tracer)).catch(this.#model.failed);
    return true;
  }

  /** Brings a tracer's scene into the pose of the present time. */
  #apply(tracer: PathTracer): void | Promise<void> {
    if (this.#destroyed) return undefined;
    const change = this.#poser.pose(this.#name, this.#time);
    const { failed } = this.#model;
    // Their images are those of the next sample; what the GPU says to them comes later.
    for (const edit of applyPlacements(tracer, change, this.#model.place())) edit.catch(failed);
    if (change.meshes.length === 0) return undefined;
    this.#deforming = true;
    return Promise.all(applyShapes(tracer, change)).then(
      () => this.#deformed(),
      (error: unknown) => {
        this.#deformed();
        throw error;
      },
    );
  }

  #deformed(): void {
    this.#deforming = false;
    if (!this.#late) return;
    this.#late = false;
    this.#pose();
  }
}

/** Applies what of a pose needs no other meshes. */
const applyPlacements = (
  tracer: PathTracer,
  { transforms, visibility, lights }: PoseChange,
  place: readonly number[] | undefined,
): Promise<void>[] => [
  tracer.setInstanceTransforms(
    transforms.map(({ instance, transform }) => [instance, place ? placed(place, transform) : transform]),
  ),
  ...visibility.map(({ instance, visible }) => tracer.setVisibility(instance, visible)),
  ...lights.map(({ index, light }) => tracer.setLight(index, place ? placedLight(place, light) : light)),
];

const applyShapes = (tracer: PathTracer, { meshes }: PoseChange): Promise<void>[] =>
  meshes.map(({ mesh, deformed }) => tracer.replaceMesh(mesh, deformed));

const notFinite = (name: string, value: unknown) =>
  new ViewerError('viewer/option', `${name} is ${String(value)}; it must be a finite number.`);

/** What the loader of glTF takes of a source; `undefined` for scenes and other formats. */
function gltfSourceOf(source: ModelSource): GltfSource | undefined {
  if (typeof source === 'string' || source instanceof URL) return OTHER.test(pathOf(source)) ? undefined : source;
  if (!(source instanceof Blob || source instanceof Map || isFiles(source))) return undefined;
  const files = filesOf(source);
  const { model } = sortFiles(files);
  return model === undefined || OTHER.test(model) ? undefined : { files, entry: model };
}

/** What {@link openPlayer} takes. */
export interface PlayerContext extends Pick<AnimatedModel, 'place'> {
  readonly source: ModelSource | undefined;
  readonly scene: Scene | undefined;
  readonly decoders: LoadModelOptions['decoders'];
  readonly credentials: LoadModelOptions['credentials'];
  readonly engine: Pick<Engine, 'edit' | 'wake' | 'refit'>;
  readonly events: Emitter<ViewerEvents>;
  /** Whether the scene is still the one that is shown. */
  readonly isShown: () => boolean;
  readonly failed: (error: unknown) => void;
}

/** Opens the animations of a model. @throws {GltfError} as `openAnimations` of `@glanz/gltf/animation`. */
export async function openPlayer(context: PlayerContext): Promise<AnimationPlayer> {
  const { source, scene, decoders, credentials, engine, events, failed, place } = context;
  if (!scene?.animations?.length) throw new ViewerError('viewer/animation', 'There is no model with animations.');
  const file = source && gltfSourceOf(source);
  if (file === undefined)
    throw new ViewerError('viewer/animation', 'The model was not loaded from a glTF file: it has no animations.');
  const settings = { decoders: { meshopt: meshoptDecoder, ...decoders }, credentials };
  const poser = await openAnimations(file, scene, settings);
  if (!context.isShown()) throw abortError('another model was shown');
  engine.refit(refitting());
  return new AnimationPlayer(
    {
      place,
      edit: (change) => engine.edit('animation', change),
      // A ground is no instance of the model.
      reopen: (other) =>
        openAnimations(file, { ...other, instances: other.instances.slice(0, scene.instances.length) }, settings),
      wake: () => engine.wake(),
      emit: (type, detail) => events.emit(type, detail),
      failed: (error) => void (isAbort(error) || isLoss(error) || failed(error)),
    },
    poser,
  );
}

/**
 * Fits hierarchies to deformed meshes, which takes a small part of the time of a build, until rays would take half as
 * long again as with a new one.
 */
export function refitting(): RefitHierarchy {
  /** The last hierarchy of each list of triangles, and how good it was when it was built. */
  const last = new WeakMap<Uint32Array, { readonly blas: Blas; readonly quality: RefitQuality }>();
  return async (mesh, build) => {
    const known = last.get(mesh.indices);
    const fitted = known && refitted(known.blas, mesh);
    if (known && fitted && !known.quality.shouldRebuild(fitted)) {
      last.set(mesh.indices, { ...known, blas: fitted });
      return fitted;
    }
    const blas = await build();
    last.set(mesh.indices, { blas, quality: new RefitQuality(blas) });
    return blas;
  };
}

function refitted(blas: Blas, mesh: Parameters<RefitHierarchy>[0]): Blas | undefined {
  const { nodes, bounds } = blas;
  const fitted = { ...blas, nodes: nodes.slice(), bounds: { min: bounds.min.slice(), max: bounds.max.slice() } };
  try {
    refitBlas(fitted, mesh);
    return fitted;
  } catch {
    // A triangle that was left out, or is not finite any more.
    return undefined;
  }
}
