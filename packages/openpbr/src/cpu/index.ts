export { albedoBsdf, emittedRadiance, evalBsdf, evalPdfBsdf, pdfBsdf, prepareBsdf, sampleBsdf, type Bsdf, type BsdfOptions, type BsdfSample } from './bsdf';
export { coatDarkening, coatedBase, coatRoughening, coatTransmittance, type Coat, type CoatFrame } from './coat';
export { refract, refractGgx, refractHalf, type BsdfSide, type Transmission } from './transmission';
export { subsurfaceAlbedo, subsurfaceMedium, type ThinSubsurface } from './subsurface';
export { dispersedIor, phaseEval, phaseSample, transmissionMedium, type Medium } from './medium';
export { dielectricEpsilon, fresnelDielectric, fresnelMetal, fresnelMetalMean } from './fresnel';
export { ggx, ggxAlpha, ggxDistribution, ggxMasking, ggxMaskingShadowing, ggxSample, halfVector, mirrorCosine, mirrorRoughness, viewRoughness, type Slopes } from './ggx';
export { cosineSample, eon } from './diffuse';
export { energyBounce, energyLost, energyLostMean, energyShare, energyShareMean, energyTotal, fresnelMean, tableLookup } from './energy';
