import { PathTracer, type PathTracerOptions } from '@glanz/renderer';
import type { Connection } from './connection';
import type { TracerSpec } from './engine-host';
import { isAbort } from './aborts';
import { ViewerError } from './errors';
import { soon } from './visibility';

/** A tracer and the device that it is on. */
export interface MadeTracer {
  readonly tracer: PathTracer;
  readonly device: GPUDevice;
}

/**
 * Makes a tracer ready for its first sample; where the device is lost meanwhile, once more on the next one. The
 * connection gives up after some losses, and so does this.
 *
 * @param source Asked again for each attempt, as are the options: what they say may have changed while a device was
 * waited for.
 */
export async function makeTracer(
  connection: Connection,
  source: () => TracerSpec,
  optionsNow: () => PathTracerOptions,
): Promise<MadeTracer> {
  for (;;) {
    await connection.recovery;
    const { device } = connection;
    if (!device) throw new ViewerError('viewer/device-lost', 'The GPU was lost and has not come back.');
    const { scene, camera, options, ready } = source();
    const more = optionsNow();
    const lost = () => device !== connection.device || connection.recovery !== undefined;
    let tracer: PathTracer | undefined;
    try {
      tracer = await PathTracer.create(device, scene, { ...more, ...options, camera });
      await ready?.(tracer);
      if (!lost()) return { tracer, device };
      tracer.destroy();
    } catch (error) {
      tracer?.destroy();
      // A loss may be reported after the errors that it causes.
      await soon();
      if (isAbort(error) || more.signal?.aborted || !lost()) throw error;
    }
  }
}
