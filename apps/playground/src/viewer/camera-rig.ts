import { frameCamera, frameCameraSteps, inSlices, sceneBounds, sceneBoundsSteps, type Camera, type PerspectiveCamera, type Scene, type SceneBounds } from '@glanz/scene';
import type { OrbitView, State } from '../state/state';
import type { Store } from '../state/store';
import { directionOf, STANDARD_VIEWS, withLens, type StandardView } from './lens';
import { fitCamera, OrbitCamera } from './orbit-camera';

/** The field of view that the state asks for, radians. */
const yfovOf = ({ lens: { fov } }: State) => (fov === null ? undefined : (fov * Math.PI) / 180);

const framing = (aspect: number, yfov: number | undefined) => ({ aspect, ...(yfov === undefined ? {} : { yfov }) });

/** The camera that the state asks for, and what hands and buttons do to it. */
export class CameraRig {
  readonly #store: Store<State>;
  readonly #aspect: () => number;
  #scene: Scene | undefined;
  #bounds: SceneBounds | undefined;
  /** The camera that sees all, and for which aspect and field of view. */
  #framed: { readonly aspect: number; readonly yfov: number | undefined; readonly camera: PerspectiveCamera } | undefined;
  /** Whether the change that is being told is one of many in a row. */
  moving = false;

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
    const aspect = this.#aspect(), yfov = yfovOf(state);
    const framed = scene.cameras[state.camera] ? undefined : { aspect, yfov, camera: await inSlices(frameCameraSteps(scene, framing(aspect, yfov))) };
    this.#scene = scene;
    this.#bounds = bounds;
    this.#framed = framed;
  }

  /** Takes over what another rig knows of its scene. */
  follow(rig: CameraRig): void {
    this.#scene = rig.#scene;
    this.#bounds = rig.#bounds;
    this.#framed = rig.#framed;
  }

  /** The camera to render with. */
  camera(state: State = this.#store.state, scene: Scene | undefined = this.#scene): Camera {
    if (!scene) throw new Error('There is no scene to look at.');
    return withLens(state.orbit ? this.#orbit(state, scene).camera() : this.#start(state, scene), state.lens, this.#aspect());
  }

  /** Turns, shifts or zooms by hand. */
  move(change: (orbit: OrbitCamera) => void): void {
    if (!this.#scene) return;
    const orbit = this.#orbit(this.#store.state, this.#scene);
    change(orbit);
    this.moving = true;
    this.#store.set({ orbit: orbit.view });
    this.moving = false;
  }

  /** A camera of the scene by its index, −1: one that sees all. */
  choose(camera: number): void {
    this.#store.set({ camera, orbit: null }, camera === this.#store.state.camera ? {} : { label: 'Camera' });
  }

  /** One of the standard views, with all of the model in the picture. */
  look(view: StandardView): void {
    this.#frame(this.#scene, directionOf(STANDARD_VIEWS[view]));
  }

  /** Brings one part, or all of the model, into the picture without turning. */
  frame(instance: number | undefined): void {
    const scene = this.#scene;
    if (!scene) return;
    const m = this.camera().transform;
    const part = instance === undefined ? undefined : scene.instances[instance];
    this.#frame(part ? { ...scene, instances: [{ ...part, visible: true }] } : scene, [m[8] as number, m[9] as number, m[10] as number]);
  }

  #frame(what: Scene | undefined, direction: readonly [number, number, number]): void {
    if (!what || !this.#bounds) return;
    const { lens } = this.#store.state;
    // Straight up has no "right": a hair aside.
    const aside = Math.hypot(direction[0], direction[2]) < 1e-3 ? ([0, direction[1], 1e-3] as const) : direction;
    const camera = frameCamera(what, { aspect: this.#aspect(), direction: aside, ...(lens.fov === null ? {} : { yfov: (lens.fov * Math.PI) / 180 }) });
    const { view } = new OrbitCamera(camera, this.#bounds);
    this.#store.set({ orbit: view, camera: -1 });
  }

  #start(state: State, scene: Scene): Camera {
    const { camera: index, lens } = state;
    const aspect = this.#aspect();
    const camera = scene.cameras[index];
    if (!camera) {
      const yfov = yfovOf(state);
      if (this.#framed?.aspect !== aspect || this.#framed.yfov !== yfov || scene !== this.#scene) this.#framed = { aspect, yfov, camera: frameCamera(scene, framing(aspect, yfov)) };
      return this.#framed.camera;
    }
    const fitted = fitCamera(camera, aspect);
    return lens.fov === null || fitted.type !== 'perspective' ? fitted : { ...fitted, yfov: (lens.fov * Math.PI) / 180 };
  }

  #orbit(state: State, scene: Scene): OrbitCamera {
    const orbit = new OrbitCamera(this.#start(state, scene), this.#bounds ?? sceneBounds(scene));
    return state.orbit ? orbit.restore(state.orbit) : orbit;
  }

  /** Where the camera is, as a view to keep. */
  view(): OrbitView | undefined {
    return this.#scene ? this.#orbit(this.#store.state, this.#scene).view : undefined;
  }
}
