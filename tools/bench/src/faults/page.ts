// Runs in a page before its own scripts: every device of the page gets faults. `window.glanzFaults` controls them.
import { FaultRecorder, instrumentDevice, loseDevice } from '@glanz/gpu/faults';

/** What the page offers to the campaign. */
export interface PageFaults {
  readonly recorder: FaultRecorder;
  /** As when the user goes to another tab, or comes back. */
  hide(hidden: boolean): void;
}

const recorder = new FaultRecorder();
if ('GPUAdapter' in globalThis) {
  let latest: GPUDevice | undefined;
  const { requestDevice } = GPUAdapter.prototype;
  GPUAdapter.prototype.requestDevice = async function (...given) {
    latest = instrumentDevice(await requestDevice.apply(this, given), recorder);
    return latest;
  };
  const { getCurrentTexture } = GPUCanvasContext.prototype;
  GPUCanvasContext.prototype.getCurrentTexture = function () {
    const fault = recorder.count('getCurrentTexture', '');
    if (latest && (fault === 'lost-unknown' || fault === 'lost-destroyed'))
      loseDevice(latest, fault === 'lost-unknown' ? 'unknown' : 'destroyed');
    return getCurrentTexture.call(this);
  };
}
const faults: PageFaults = {
  recorder,
  hide(hidden) {
    Object.defineProperty(document, 'hidden', { configurable: true, value: hidden });
    Object.defineProperty(document, 'visibilityState', { configurable: true, value: hidden ? 'hidden' : 'visible' });
    document.dispatchEvent(new Event('visibilitychange'));
  },
};
Object.assign(globalThis, { glanzFaults: faults });
