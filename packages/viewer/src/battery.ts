/** What the viewer reads of the Battery Status API, which TypeScript does not declare. Its values are kept up to date. */
interface Battery {
  readonly charging: boolean;
  /** 0 to 1. */
  readonly level: number;
}

/** A battery with less charge than this is saved. */
const LOW = 0.2;

/**
 * Watches the device's battery, where the browser tells of it (Chromium).
 *
 * @returns Whether it is nearly empty at present, and not charging.
 */
export function watchBattery(): () => boolean {
  let battery: Battery | undefined;
  (navigator as { getBattery?(): Promise<Battery> }).getBattery?.().then(
    (found) => (battery = found),
    // A page in a frame may not be allowed to ask.
    () => undefined,
  );
  return () => battery !== undefined && !battery.charging && battery.level < LOW;
}
