export { openPbrStruct, packOpenPbr } from './record';
export { requiredFeatures, type FeatureOptions, type OpenPbrFlags } from './features';
export {
  openpbr,
  openpbrCoat,
  openpbrCosine,
  openpbrDielectric,
  openpbrEmission,
  openpbrEnergy,
  openpbrEon,
  openpbrFresnelDielectric,
  openpbrFresnelMetal,
  openpbrFuzz,
  openpbrGgx,
  openpbrMedium,
  openpbrMetal,
  openpbrOpacity,
  openpbrPhase,
  openpbrSubsurface,
  openpbrTransmission,
} from './modules';
