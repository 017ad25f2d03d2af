import {
  frameCamera,
  frameCameraSteps,
  inSlices,
  sceneBounds,
  sceneBoundsSteps,
  type Camera,
  type Scene,
  type SceneBounds,
} from '@glanz/scene';
import { fitCamera } from '@glanz/viewer/fit-camera';
import { OrbitRig, type Orbit } from '@glanz/viewer/orbit';
import type { OrbitView, State } from '../state/state';
import type { Store } from '../state/store';
import { placedTransform } from './placement';
import { directionOf, STANDARD_VIEWS, withLens, type StandardView } from './lens';

/** Seconds in which 63 % of a movement is done; none of it where the user asks for less motion. */
const DAMPING = 0.06;
const damping = () => (matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : DAMPING);

/** The field of view that the state asks for, radians. */
const yfovOf = ({ lens: { fov } }: State) => (fov === null ? undefined : (fov * Math.PI) / 180);
const framing = (aspect: number, yfov: number | undefined) => ({ aspect, ...(yfov === undefined ? {} : { yfov }) });
/** What the camera that a state begins with depends on, besides the scene. */
const keyOf = ({ camera, lens: { fov } }: State, aspect: number) => [camera, fov, aspect].join();

const viewOf = ({ theta, phi, radius, target, zoom = 1 }: Orbit): OrbitView => ({
  target,
  distance: radius,
  yaw: theta,
  pitch: Math.PI / 2 - phi,
  zoom,
});
/** An orbit as the viewer's packages have it. */
export const orbitOf = ({ target, distance, yaw, pitch, zoom }: OrbitView): Orbit => ({
  target,
  radius: distance,
  theta: yaw,
  phi: Math.PI / 2 - pitch,
  zoom,
});

/** The camera that the state requests, its controls, and the one that follows it smoothly. */
export class CameraRig {
  readonly #store: Store<State>;
  readonly #aspect: () => number;
  #scene: Scene | undefined;
  #bounds: SceneBounds | undefined;
  /**
   * Moves to the camera of the state. Made from the camera that the state begins with, and again where that changes.
   */
  #follower: OrbitRig | undefined;
  #followed: Camera | undefined;
  /**
   * The camera that a state begins with, cached while what it depends on stays: framing iterates over all vertices.
   */
  #known: { readonly key: string; readonly scene: Scene; readonly camera: Camera } | undefined;

  /** @param aspect Width over height of the film. */
  constructor(store: Store<State>, aspect: () => number) {
    this.#store = store;
    this.#aspect = aspect;
  }

  /**
   * Finds what the rig needs to know of a scene, in slices.
   *
   * @param scene As loaded: helpers such as the floor do not count.
   * @param state That will be asked for.
   */
  async setScene(scene: Scene, state: State): Promise<void> {
    const bounds = await inSlices(sceneBoundsSteps(scene));
    const aspect = this.#aspect();
    const framed = scene.cameras[state.camera]
      ? undefined
      : await inSlices(frameCameraSteps(scene, framing(aspect, yfovOf(state))));
    this.#scene = scene;
    this.#bounds = bounds;
    this.#follower = undefined;
    this.#known = framed && { key: keyOf(state, aspect), scene, camera: framed };
  }

  /** Takes over what another rig knows of its scene. */
  adopt(rig: CameraRig): void {
    this.#scene = rig.#scene;
    this.#bounds = rig.#bounds;
    this.#known = rig.#known;
    this.#follower = undefined;
  }

  /** The same scene in another pose: bounds and the view of all stay, a camera of its own may have moved. */
  pose(scene: Scene): void {
    const own = scene.cameras[this.#store.state.camera];
    this.#known = this.#known && !own ? { ...this.#known, scene } : undefined;
    this.#scene = scene;
    if (own) this.follow(true);
  }

  /** Bounds of a scene that this rig looks at; undefined for another. A pose keeps the bounds of the model at rest. */
  boundsOf(scene: Scene): SceneBounds | undefined {
    return scene === this.#scene ? this.#bounds : undefined;
  }

  /** Whether the camera is on its way to where the state wants it. */
  get moving(): boolean {
    return this.#follower?.moving ?? false;
  }

  /** Advances it by so many seconds. @returns Whether it has moved. */
  step(seconds: number): boolean {
    return this.#follower?.step(seconds) ?? false;
  }

  /** The camera where it is now, to render with. */
  get now(): Camera {
    const { state } = this.#store;
    if (!this.#scene) throw new Error('There is no scene to look at.');
    const follower = this.#following(state, this.#scene);
    return withLens(
      state.orbit || follower.moving ? follower.camera() : this.#start(state, this.#scene),
      state.lens,
      this.#aspect(),
    );
  }

  /** The state has changed. @param immediate Whether the camera is there at once: there is another model. */
  follow(immediate = false): void {
    const { state } = this.#store;
    if (!this.#scene) return;
    const follower = this.#following(state, this.#scene);
    if (state.orbit) follower.setOrbit(orbitOf(state.orbit));
    else follower.setCamera(this.#start(state, this.#scene));
    if (immediate) follower.jump();
  }

  /** The camera that a state asks for. */
  camera(state: State = this.#store.state, scene: Scene | undefined = this.#scene): Camera {
    if (!scene) throw new Error('There is no scene to look at.');
    return withLens(
      state.orbit ? this.#orbit(state, scene).camera() : this.#start(state, scene),
      state.lens,
      this.#aspect(),
    );
  }

  /** Where the camera is that the state asks for. */
  get view(): OrbitView {
    const { state } = this.#store;
    return state.orbit ?? viewOf(this.#orbit(state, this.#scene as Scene).goal);
  }

  /** Orbits, pans or zooms by user input. */
  move(change: (rig: OrbitRig) => void): void {
    if (!this.#scene) return;
    const rig = this.#orbit(this.#store.state, this.#scene);
    change(rig);
    this.#store.set({ orbit: viewOf(rig.goal) });
  }

  /** A camera of the scene by its index, −1: one that sees all. */
  choose(camera: number): void {
    this.#store.set({ camera, orbit: null }, camera === this.#store.state.camera ? {} : { label: 'Camera' });
  }

  /** One of the standard views, with all of the model in the image. */
  look(view: StandardView): void {
    this.#frame(this.#scene, directionOf(STANDARD_VIEWS[view]));
  }

  /** Brings these parts, or all of the model where there are none, into the image without turning. */
  frame(parts: readonly number[]): void {
    const scene = this.#scene;
    if (!scene) return;
    const m = this.camera().transform;
    const framed = parts.flatMap((index) => {
      const part = scene.instances[index];
      return part
        ? [{ ...part, visible: true, transform: placedTransform(scene, index, this.#store.state.moves) }]
        : [];
    });
    this.#frame(framed.length > 0 ? { ...scene, instances: framed } : scene, [
      m[8] as number,
      m[9] as number,
      m[10] as number,
    ]);
  }

  #frame(what: Scene | undefined, direction: readonly [number, number, number]): void {
    if (!what || !this.#bounds) return;
    // Straight up has no "right": a hair aside.
    const aside = Math.hypot(direction[0], direction[2]) < 1e-3 ? ([0, direction[1], 1e-3] as const) : direction;
    const camera = frameCamera(what, { direction: aside, ...framing(this.#aspect(), yfovOf(this.#store.state)) });
    this.#store.set({ orbit: viewOf(new OrbitRig(camera, this.#bounds).goal), camera: -1 });
  }

  #start(state: State, scene: Scene): Camera {
    const aspect = this.#aspect();
    const key = keyOf(state, aspect);
    if (this.#known?.key !== key || this.#known.scene !== scene) {
      const yfov = yfovOf(state);
      const own = scene.cameras[state.camera];
      const fitted = own ? fitCamera(own, aspect) : frameCamera(scene, framing(aspect, yfov));
      this.#known = {
        key,
        scene,
        camera: yfov === undefined || fitted.type !== 'perspective' ? fitted : { ...fitted, yfov },
      };
    }
    return this.#known.camera;
  }

  /** A rig that is where the state wants it. */
  #orbit(state: State, scene: Scene): OrbitRig {
    const rig = new OrbitRig(this.#start(state, scene), this.#bounds ?? sceneBounds(scene), { damping: 0 });
    if (state.orbit) rig.setOrbit(orbitOf(state.orbit));
    rig.jump();
    return rig;
  }

  /** The follower, with the lens that the state begins with. */
  #following(state: State, scene: Scene): OrbitRig {
    const start = this.#start(state, scene);
    const former = this.#follower;
    if (former && start === this.#followed) return former;
    this.#followed = start;
    const next = (this.#follower = new OrbitRig(start, this.#bounds ?? sceneBounds(scene), { damping: damping() }));
    // From where it is, with another lens.
    if (former) {
      next.setOrbit(former.orbitNow);
      next.jump();
      next.setOrbit(former.goal);
    } else if (state.orbit) {
      next.setOrbit(orbitOf(state.orbit));
      next.jump();
    }
    return next;
  }
}
