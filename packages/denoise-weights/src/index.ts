export { WEIGHT_ARCHIVES, type WeightArchive, type WeightArchiveName } from './archives';
