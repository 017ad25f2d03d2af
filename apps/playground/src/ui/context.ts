import type { Camera } from '@glanz/scene';
import type { Opened } from '../input/opening';
import type { ModelRequest } from '../input/load-messages';
import type { Environments } from '../input/environments';
import type { Selection } from '../selection';
import type { State } from '../state/state';
import type { ChangeOptions, Store } from '../state/store';
import type { CameraRig } from '../viewer/camera-rig';
import type { Session, SessionStatus } from '../viewer/session';

/** What panels know of the page, and what they may ask it. */
export interface Context {
  readonly store: Store<State>;
  readonly selection: Selection;
  readonly session: Session;
  readonly rig: CameraRig;
  readonly environments: Environments;
  /** The model that is shown; panels are made after the first one. */
  readonly opened: () => Opened;
  /** Calls the listener when another model is shown. */
  readonly onModel: (listener: () => void) => void;
  /** Calls the listener when an image file for the environment was opened. */
  readonly onEnvironmentFile: (listener: () => void) => void;
  readonly onStatus: (listener: (status: SessionStatus) => void) => void;
  readonly openFiles: (files: ReadonlyMap<string, File>) => void;
  readonly pickFiles: () => void;
  /** Shows another model. */
  readonly load: (request: ModelRequest) => Promise<void>;
  /** Brings the model into the pose that the state's animation has. @returns Whether it is on its way to the screen. */
  readonly pose: () => Promise<boolean>;
  readonly say: (text: string) => void;
  readonly fail: (error: unknown) => void;
  /** The camera as it is now, for the stage. */
  readonly camera: () => Camera;
  /** Calls the listener when the camera, the state or the size of the stage has changed. */
  readonly onView: (listener: () => void) => void;
  /** Size of the stage, CSS pixels. */
  readonly stageSize: () => readonly [number, number];
}

/** Changes one field of the state as a step of undo. */
export const changer =
  (store: Store<State>) =>
  <K extends keyof State>(name: K, label: string) =>
  (value: State[K]): void =>
    store.set({ [name]: value } as Pick<State, K>, { label } satisfies ChangeOptions);

/** Calls a listener now and whenever one of the fields has changed. */
export function watch(store: Store<State>, fields: readonly (keyof State)[], listener: (state: State) => void): void {
  listener(store.state);
  store.subscribe((next, before) => {
    if (fields.some((field) => next[field] !== before[field])) listener(next);
  });
}
