export type {
  OpenPbrColor,
  OpenPbrGroup,
  OpenPbrParameterInfo,
  OpenPbrParameterName,
  OpenPbrParameterSpec,
  OpenPbrParameters,
  OpenPbrParameterType,
  OpenPbrUnit,
  OpenPbrVector,
} from './types';
export { OPENPBR_PARAMETER_NAMES, OPENPBR_PARAMETER_SPECS } from './specs';
export { OPENPBR_PARAMETERS } from './table';
export {
  defaultParameters,
  OpenPbrError,
  resolveParameters,
  validateParameters,
  type OpenPbrWarning,
  type ValidatedParameters,
} from './validate';
