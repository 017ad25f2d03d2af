export function fresnelDielectric(eta: number, c: number): number;
export function gaussLegendre(count: number): { nodes: Float64Array; weights: Float64Array };
export function interfaceAlbedo(
  rings: number,
  spokes: number,
): (
  alpha: readonly [number, number],
  eta: number,
  mu: number,
  phi?: number,
) => { reflect: number; transmit: number; mirror: number };
