import type { SceneAnimation } from '@glanz/scene';
import type { AnimationPlayer, PlayOptions, Viewer } from '@glanz/viewer';

/** What the animations of an element need of it. */
export interface AnimationHost {
  readonly viewer: () => Viewer | undefined;
  /** The attribute `animation-name`. */
  readonly name: () => string | null;
  /** The attribute `autoplay`, unless the user asks for less motion. */
  readonly autoplay: () => boolean;
  readonly fail: (error: unknown) => void;
}

/**
 * The animations of an element's model. The player is fetched when something is to be posed; until it is there, its
 * properties are those that it will have.
 */
export class ElementAnimation {
  readonly #host: AnimationHost;
  #available: readonly SceneAnimation[] = [];
  #player: AnimationPlayer | undefined;
  /** What waits for the player. */
  #opening: Promise<AnimationPlayer> | undefined;
  #paused = true;
  #time = 0;
  #scale = 1;

  constructor(host: AnimationHost) {
    this.#host = host;
  }

  get available(): readonly string[] {
    return this.#available.map(({ name }) => name);
  }

  get paused(): boolean {
    return this.#player?.paused ?? this.#paused;
  }

  get currentTime(): number {
    return this.#player?.currentTime ?? this.#time;
  }

  set currentTime(seconds: number) {
    this.#time = seconds;
    this.#do((player) => void (player.currentTime = seconds));
  }

  get duration(): number {
    if (this.#player?.name !== undefined) return this.#player.duration;
    const name = this.#host.name();
    return (this.#available.find((one) => one.name === name) ?? this.#available[0])?.duration ?? 0;
  }

  get timeScale(): number {
    return this.#scale;
  }

  set timeScale(factor: number) {
    this.#scale = factor;
    if (this.#player || this.#opening) this.#do((player) => void (player.timeScale = factor));
  }

  play(options?: PlayOptions): void {
    if (this.#available.length === 0) return;
    this.#paused = false;
    this.#do((player) => player.play(options));
  }

  pause(): void {
    this.#paused = true;
    if (this.#player || this.#opening) this.#do((player) => player.pause());
  }

  /** Another model is shown, with these animations. */
  begin(available: readonly SceneAnimation[] = []): void {
    this.#available = available;
    this.#player = this.#opening = undefined;
    this.#paused = true;
    this.#time = 0;
    if (this.#host.name() !== null) this.rename();
    if (this.#host.autoplay()) this.play();
  }

  /** `animation-name` has changed. */
  rename(): void {
    const name = this.#host.name() ?? (this.paused ? undefined : this.#available[0]?.name);
    this.#do((player) => void (player.name = name));
  }

  /** Does something with the player, where there are animations: at once if it is there, and in order if it is not. */
  #do(act: (player: AnimationPlayer) => void): void {
    if (this.#player) return this.#attempt(act, this.#player);
    const viewer = this.#host.viewer();
    if (!viewer || this.#available.length === 0) return;
    const available = this.#available;
    const isShown = () => available === this.#available;
    const opening = (this.#opening ??= viewer.animation().then((player) => {
      if (isShown()) {
        this.#player = player;
        player.timeScale = this.#scale;
      }
      return player;
    }));
    opening.then(
      (player) => isShown() && this.#attempt(act, player),
      (error: unknown) => {
        // What the next model waits for is not this.
        if (!isShown()) return;
        this.#opening = undefined;
        this.#paused = true;
        this.#host.fail(error);
      },
    );
  }

  #attempt(act: (player: AnimationPlayer) => void, player: AnimationPlayer): void {
    try {
      act(player);
    } catch (error) {
      this.#host.fail(error);
    }
  }
}
