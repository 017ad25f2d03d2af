import type { FilmLayer } from '../src/backend';
import type { Backend, FilmState, OpenedGpu } from '../src/index';
import { keptBackend, loseGpu } from './kept-gpu';

/** A real device under test. */
export interface FaultyDevice {
  readonly device: GPUDevice;
  /** Of the devices of a backend, from 0. */
  readonly index: number;
  readonly name: string | undefined;
  /** Submissions so far. */
  submits: number;
  /** Loses it as a driver does: reason `unknown`, and everything that is under way fails. */
  readonly lose: () => void;
}

/** What happens to the devices. */
export interface Faults {
  /** Called before each submission. */
  readonly onSubmit?: (device: FaultyDevice) => void;
  /** Called before each copy of a film to the CPU and after it. */
  readonly onSave?: (device: FaultyDevice, film?: FilmState) => void;
  /** Called when a film begins to be copied to the CPU, and when that has ended, well or not. */
  readonly onCopying?: (begins: boolean) => void;
  /** Called before each layer is read. */
  readonly onRead?: (device: FaultyDevice, layer: string) => void;
  /** Labels of the buffers for which there is no memory. */
  readonly outOfMemory?: RegExp;
  /** Called before a device is opened; throws if there is none. */
  readonly onOpen?: (index: number, name: string | undefined) => void;
}

/** The real backend, whose devices can be lost at any submission. */
export function faultyBackend({ onSubmit, onSave, onCopying, onRead, onOpen, outOfMemory }: Faults): {
  readonly backend: Backend;
  readonly devices: FaultyDevice[];
} {
  const real = keptBackend();
  const devices: FaultyDevice[] = [];
  const backend: Backend = {
    ...real,
    async openGpu(name, onError): Promise<OpenedGpu> {
      onOpen?.(devices.length, name);
      const opened = await real.openGpu('software', onError);
      const { device } = opened;
      const faulty: FaultyDevice = {
        device,
        index: devices.length,
        name,
        submits: 0,
        lose: () => loseGpu(device),
      };
      devices.push(faulty);
      // Commands before may have replaced these.
      const create = GPUDevice.prototype.createBuffer.bind(device);
      // Nothing has so much: the device reports an error and gives a buffer that cannot be used.
      device.createBuffer = (descriptor) =>
        create(outOfMemory?.test(descriptor.label ?? '') ? { ...descriptor, size: 2 ** 50 } : descriptor);
      const { queue } = device;
      const submit = GPUQueue.prototype.submit.bind(queue);
      queue.submit = (buffers) => {
        faulty.submits++;
        onSubmit?.(faulty);
        return submit(buffers);
      };
      return { ...opened, adapterName: name ?? opened.adapterName };
    },
    async createTracer(device, scene, options) {
      const tracer = await real.createTracer(device, scene, options);
      const save = tracer.saveFilm.bind(tracer);
      const faulty = devices.findLast((one) => one.device === device) as FaultyDevice;
      const read = tracer.read.bind(tracer) as (layer: FilmLayer) => Promise<Float32Array<ArrayBuffer>>;
      tracer.read = ((layer: FilmLayer) => {
        onRead?.(faulty, layer);
        return read(layer);
      }) as typeof tracer.read;
      tracer.saveFilm = async () => {
        onCopying?.(true);
        try {
          onSave?.(faulty);
          const film = await save();
          onSave?.(faulty, film);
          return film;
        } finally {
          onCopying?.(false);
        }
      };
      return tracer;
    },
  };
  return { backend, devices };
}
