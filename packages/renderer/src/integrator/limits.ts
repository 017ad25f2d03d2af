/** Scattering events in one run of the intersect kernel, so that none runs long. */
export const WALK_STEPS = 16;

/** Surfaces that a light sample may pass, smooth thin walls and null interfaces: more hide the light. */
export const CONNECT_CROSSINGS = 32;
