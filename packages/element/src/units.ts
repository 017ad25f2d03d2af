/** Radians and metres beyond which a number says nothing of use. */
const [MAX_TURN, FAR] = [1e6, 1e12];

/** Radians of an angle: `45deg`, `0.8rad`, `0.1turn`; degrees where no unit is given. `undefined` for anything else. */
export function angle(text: string): number | undefined {
  const match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(deg|rad|turn)?$/i.exec(text);
  if (!match) return undefined;
  const value = Number(match[1]);
  const unit = match[2]?.toLowerCase();
  const radians = unit === 'rad' ? value : unit === 'turn' ? value * 2 * Math.PI : (value * Math.PI) / 180;
  return Math.abs(radians) <= MAX_TURN ? radians : undefined;
}

/** A length: metres of `2m`, `20cm`, `5mm`, or a share of `105%`. */
export function length(text: string): { readonly metres: number } | { readonly share: number } | undefined {
  const match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(m|cm|mm|%)?$/i.exec(text);
  if (!match) return undefined;
  const value = Number(match[1]);
  if (!(Math.abs(value) <= FAR)) return undefined;
  const unit = match[2]?.toLowerCase();
  return unit === '%' ? { share: value / 100 } : { metres: value * (unit === 'cm' ? 0.01 : unit === 'mm' ? 0.001 : 1) };
}

/** What is known of a scene when an orbit is read. */
export interface OrbitBasis {
  readonly theta: number;
  readonly phi: number;
  /** Metres that are 100 %. */
  readonly radius: number;
  /** Share of them that `auto` is. */
  readonly share: number;
}

/** What `camera-orbit` is where nothing, or `auto`, is said; as in model-viewer: from the front, 15° above, 105 %. */
export const DEFAULT_ORBIT = { theta: 0, phi: (75 * Math.PI) / 180, share: 1.05 } as const;
/** Vertical field of view, radians, of `auto`. */
export const DEFAULT_FIELD_OF_VIEW = (30 * Math.PI) / 180;

/** Reads `theta phi radius`; parts that are missing, `auto` or unreadable are the basis's. */
export function readOrbit(
  text: string | null,
  basis: OrbitBasis,
): { readonly theta: number; readonly phi: number; readonly radius: number } {
  const [a = 'auto', b = 'auto', c = 'auto'] = (text ?? '').trim().split(/\s+/).filter(Boolean);
  const far = length(c);
  const radius =
    far === undefined ? basis.share * basis.radius : 'share' in far ? far.share * basis.radius : far.metres;
  return {
    theta: angle(a) ?? basis.theta,
    phi: angle(b) ?? basis.phi,
    radius: radius > 0 ? radius : basis.share * basis.radius,
  };
}

/** Minimum or maximum of an orbit: `undefined` where a part is `auto` or missing. */
export function readLimit(
  text: string | null,
  basis: OrbitBasis,
): { readonly theta: number | undefined; readonly phi: number | undefined; readonly radius: number | undefined } {
  const [a = 'auto', b = 'auto', c = 'auto'] = (text ?? '').trim().split(/\s+/).filter(Boolean);
  const far = length(c);
  // "Infinity" is how one says that there is no limit.
  const turn = /^[+-]?infinity(deg|rad)?$/i.test(a) ? undefined : angle(a);
  return {
    theta: turn,
    phi: angle(b),
    radius: far === undefined ? undefined : 'share' in far ? far.share * basis.radius : far.metres,
  };
}

/** Reads a point, `1m 0.5m 0m`; parts that are missing or `auto` are the middle's. */
export function readPoint(text: string | null, middle: readonly [number, number, number]): [number, number, number] {
  const parts = (text ?? '').trim().split(/\s+/);
  return [0, 1, 2].map((k) => {
    const part = length(parts[k] ?? 'auto');
    return part !== undefined && 'metres' in part ? part.metres : (middle[k] as number);
  }) as [number, number, number];
}

/** Reads a field of view within its range, (0°, 180°). */
export function readFieldOfView(text: string | null): number {
  const value = angle((text ?? '').trim());
  return value !== undefined && value > 0.01 && value < Math.PI - 0.01 ? value : DEFAULT_FIELD_OF_VIEW;
}
