import { RENDER_OPTIONS } from '@glanz/renderer/options';
import type { EngineSettings } from './engine-host';
import type { PreviewOptions, ViewerOptions } from './options';

/** The options of the preview. */
export const previewOptions = ({ preview }: ViewerOptions): PreviewOptions =>
  typeof preview === 'string' ? { mode: preview } : (preview ?? {});

/** The settings of an engine that the options of a viewer ask for, with their defaults. */
export const engineSettings = (options: ViewerOptions, preview = previewOptions(options)): EngineSettings => ({
  samples: options.samples ?? RENDER_OPTIONS.samples.default,
  noise: options.noise || undefined,
  maxDepth: options.maxDepth ?? RENDER_OPTIONS.maxDepth.default,
  background: options.background ?? RENDER_OPTIONS.background.default,
  exposure: options.exposure ?? 0,
  toneMap: options.toneMap ?? 'neutral',
  maxSubmitMs: options.maxSubmitMs ?? RENDER_OPTIONS.maxSubmitMs.default,
  settleMs: preview.settleMs ?? 180,
  previewDepth: preview.maxDepth ?? 4,
  previewMode: preview.mode,
  tracer: options.tracer ?? {},
  requestDevice: options.requestDevice,
  warmUp: options.warmUp,
  keepSamples: options.keepSamples,
});
