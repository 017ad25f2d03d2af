import { GlanzError } from '@glanz/scene';
import type { Emitter } from './emitter';
import type { EngineHost } from './engine-host';
import { ViewerError } from './errors';
import type { ViewerEvents } from './events';

type Events = Emitter<ViewerEvents>;

const firstLine = (message: string) => message.split('\n')[0] as string;

/** Emits what failed. */
export function reportError(events: Events, error: unknown, retry?: () => void): void {
  const { message, code } = (typeof error === 'object' && error !== null ? error : { message: String(error) }) as {
    message?: string;
    code?: unknown;
  };
  events.emit('error', {
    error,
    message: firstLine(message ?? 'Something failed.'),
    code: typeof code === 'string' ? code : 'unexpected',
    ...(retry ? { retry } : {}),
  });
}

/** Emits what the viewer works around. */
export function reportWarning(events: Events, error: GlanzError): void {
  events.emit('warning', { error, message: firstLine(error.message), code: error.code });
}

/** What an engine reports, as events of a viewer. */
export const engineReports = (events: Events): Omit<EngineHost, 'step' | 'moving' | 'camera'> => ({
  state: (state) => events.emit('state', { state }),
  sample: ({ targetSamples: target, ...progress }, denoised) =>
    events.emit('sample', { ...progress, target, denoised }),
  converged: (samples, milliseconds) => events.emit('converged', { samples, milliseconds }),
  drawn: (preview, milliseconds, [width, height], denoised) =>
    events.emit('frame', { preview, milliseconds, width, height, denoised }),
  error: (error, retry) => reportError(events, error, retry),
  missing: (error) =>
    reportWarning(
      events,
      error instanceof GlanzError
        ? error
        : new ViewerError('viewer/gpu', `There is no GPU: ${String(error)}`, { cause: error }),
    ),
  warning: (warning) => reportWarning(events, warning),
  lost: (reason) => events.emit('device-lost', { reason }),
  restored: (milliseconds, samples) => events.emit('device-restored', { milliseconds, ...samples }),
});
