export { anyHitWide, closestHitWide } from './queries';
export { widenBlas, widenTlas, type WideBlas, type WideNodes, type WideTlas } from './widen';
