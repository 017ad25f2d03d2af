/** What is known of a device's loss. */
interface Loss {
  info: GPUDeviceLostInfo | undefined;
  readonly listeners: Set<(info: GPUDeviceLostInfo) => void>;
}

const losses = new WeakMap<GPUDevice, Loss>();

/**
 * One reaction per device: whatever reacts to `device.lost` stays reachable for as long as the device lives, so tracers
 * must not do that themselves. They listen here, and stop listening when they are destroyed.
 */
function lossOf(device: GPUDevice): Loss {
  let loss = losses.get(device);
  if (!loss) {
    const created: Loss = { info: undefined, listeners: new Set() };
    losses.set(device, (loss = created));
    void device.lost.then((info) => {
      created.info = info;
      for (const listener of created.listeners) listener(info);
      created.listeners.clear();
    });
  }
  return loss;
}

/** How the device was lost; `undefined` while it lives, as far as has been reported by now. */
export function lossInfo(device: GPUDevice): GPUDeviceLostInfo | undefined {
  return lossOf(device).info;
}

/**
 * Calls `listener` once when the device is lost.
 * @returns Stops listening.
 */
export function onDeviceLost(device: GPUDevice, listener: (info: GPUDeviceLostInfo) => void): () => void {
  const { info, listeners } = lossOf(device);
  if (info) listener(info);
  else listeners.add(listener);
  return () => listeners.delete(listener);
}
