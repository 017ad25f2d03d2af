export { openPbrStruct, packOpenPbr } from './record';
export { requiredFeatures, type FeatureOptions, type OpenPbrFlags } from './features';
export { openpbr } from './bsdf.wgsl';
export { openpbrMetal } from './metal.wgsl';
export { openpbrDielectric } from './dielectric.wgsl';
export { openpbrTransmission } from './transmission.wgsl';
export { openpbrSubsurface } from './subsurface.wgsl';
export { openpbrFilm } from './film.wgsl';
export { openpbrFuzz } from './fuzz.wgsl';
export { openpbrCoat } from './coat.wgsl';
export { openpbrEnergy } from './energy.wgsl';
export { openpbrEmission, openpbrOpacity } from './emission.wgsl';
export {
  openpbrCosine,
  openpbrEon,
  openpbrFresnelDielectric,
  openpbrFresnelMetal,
  openpbrGgx,
  openpbrMedium,
  openpbrPhase,
} from './modules';
