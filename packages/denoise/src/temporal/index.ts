export { TemporalFilter } from './temporal-filter';
export { RealtimeIntegrator } from './realtime-integrator';
export { TEMPORAL_AOVS } from './options';
export type {
  FrameIntegrator,
  RealtimeIntegratorOptions,
  RealtimeOptions,
  RealtimeTracer,
} from './realtime-integrator';
export type {
  FilterableCamera,
  FilterableTracer,
  FilteredImage,
  FrameStep,
  TemporalAov,
  TemporalFilterOptions,
  TemporalFrame,
} from './options';
