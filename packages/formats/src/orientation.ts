/** The transform of a file's units and axes to metres and +Y up: 16 numbers, column-major. */
export function orientation(up: 'y' | 'z', unit: number): number[] {
  return up === 'y'
    ? [unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, 1]
    : [unit, 0, 0, 0, 0, 0, -unit, 0, 0, unit, 0, 0, 0, 0, 0, 1];
}
