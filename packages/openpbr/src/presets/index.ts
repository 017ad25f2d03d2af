export {
  OPENPBR_PRESET_NAMES,
  OPENPBR_PRESETS,
  openPbrPreset,
  type OpenPbrPresetName,
  type OpenPbrPresetOptions,
} from './presets';
