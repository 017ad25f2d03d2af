import { wgslModule } from '@glanz/wgsl';

/** What @glanz/openpbr asks its host for: its energy tables, filtered. */
export const energyHost = wgslModule(
  'renderer/energy',
  /* wgsl */ `
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return textureSampleLevel(energy_dielectric, energy_sampler, coords, 0.0).x; }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return textureSampleLevel(energy_conductor, energy_sampler, coords, 0.0).x; }
`,
);
