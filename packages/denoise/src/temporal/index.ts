export { TemporalFilter } from './temporal-filter';
export { TEMPORAL_AOVS } from './options';
export type {
  FilterableTracer,
  FilteredImage,
  FrameStep,
  TemporalAov,
  TemporalFilterOptions,
  TemporalFrame,
} from './options';
