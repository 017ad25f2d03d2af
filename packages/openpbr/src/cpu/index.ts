export { albedoBsdf, emittedRadiance, evalBsdf, pdfBsdf, prepareBsdf, sampleBsdf, type Bsdf, type BsdfOptions, type BsdfSample } from './bsdf';
export { dielectricEpsilon, fresnelDielectric, fresnelMetal } from './fresnel';
export { ggx, ggxAlpha, ggxDistribution, ggxMasking, ggxMaskingShadowing, ggxSample, halfVector, mirrorView, viewRoughness, type Slopes } from './ggx';
export { cosineSample, eon } from './diffuse';
export { energyConductor, energyShare, energyShareMean, energyTotal, tableLookup } from './energy';
