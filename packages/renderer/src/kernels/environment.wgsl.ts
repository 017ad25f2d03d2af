import { wgslModule } from '@glanz/wgsl';

/**
 * Light from infinitely far away: constant, or a lat-long picture read bilinearly. Directions are drawn by
 * inverting the distribution over cells of the picture; `environment_table` holds, per cell: the part of its row that lies
 * up to its right edge, the part of the picture up to its row's lower edge, and the density over the unit square.
 */
export const environment = wgslModule(
  'renderer/environment',
  /* wgsl */ `
//#if ENVIRONMENT_MAP
fn environment_uv(direction: vec3f) -> vec2f {
  let turn = frame.environment_rotation;
  let x = turn.x * direction.x - turn.y * direction.z;
  let z = turn.y * direction.x + turn.x * direction.z;
  let around = select(atan2(z, x), 0.0, x == 0.0 && z == 0.0);
  return vec2f(around * 0.15915494309189535 + 0.5, acos(clamp(direction.y, -1.0, 1.0)) * 0.3183098861837907);
}

fn environment_radiance(direction: vec3f) -> vec3f {
  let size = vec2i(textureDimensions(environment));
  let at = environment_uv(direction) * vec2f(size) - 0.5;
  let base = floor(at);
  let part = at - base;
  let x0 = (i32(base.x) + size.x) % size.x;
  let x1 = (x0 + 1) % size.x;
  let y0 = clamp(i32(base.y), 0, size.y - 1);
  let y1 = clamp(i32(base.y) + 1, 0, size.y - 1);
  let top = mix(textureLoad(environment, vec2i(x0, y0), 0).rgb, textureLoad(environment, vec2i(x1, y0), 0).rgb, part.x);
  let bottom = mix(textureLoad(environment, vec2i(x0, y1), 0).rgb, textureLoad(environment, vec2i(x1, y1), 0).rgb, part.x);
  return mix(top, bottom, part.y) * frame.environment_radiance;
}
//#else
fn environment_radiance(direction: vec3f) -> vec3f { return frame.environment_radiance; }
//#endif

//#if ENVIRONMENT_SAMPLED
// Over the unit square the density is as smooth as the picture: bilinear between the cells' centres. The density over the
// sphere is that divided by 2π² sin θ.
fn environment_pdf(direction: vec3f) -> f32 {
  let cells = vec2i(frame.environment_cells);
  let at = environment_uv(direction) * vec2f(cells) - 0.5;
  let base = floor(at);
  let part = at - base;
  let x0 = (i32(base.x) + cells.x) % cells.x;
  let x1 = (x0 + 1) % cells.x;
  let y0 = clamp(i32(base.y), 0, cells.y - 1);
  let y1 = clamp(i32(base.y) + 1, 0, cells.y - 1);
  let top = mix(textureLoad(environment_table, vec2i(x0, y0), 0).z, textureLoad(environment_table, vec2i(x1, y0), 0).z, part.x);
  let bottom = mix(textureLoad(environment_table, vec2i(x0, y1), 0).z, textureLoad(environment_table, vec2i(x1, y1), 0).z, part.x);
  let sine = sqrt(max(1.0 - direction.y * direction.y, 0.0));
  return mix(top, bottom, part.y) / max(19.739208802178716 * sine, 1e-20);
}

// Inversion keeps points that are spread evenly spread evenly: first the row, then the cell within it, then the place in a
// tent around the cell's centre; the tents of all cells add up to the bilinear density.
fn environment_sample(u: vec2f) -> vec3f {
  let cells = frame.environment_cells;
  var low = 0u;
  var high = cells.y - 1u;
  while (low < high) {
    let middle = (low + high) / 2u;
    if (textureLoad(environment_table, vec2u(0u, middle), 0).y > u.y) { high = middle; } else { low = middle + 1u; }
  }
  let y = low;
  low = 0u;
  high = cells.x - 1u;
  while (low < high) {
    let middle = (low + high) / 2u;
    if (textureLoad(environment_table, vec2u(middle, y), 0).x > u.x) { high = middle; } else { low = middle + 1u; }
  }
  let end = textureLoad(environment_table, vec2u(low, y), 0).xy;
  let start = vec2f(
    select(textureLoad(environment_table, vec2u(max(low, 1u) - 1u, y), 0).x, 0.0, low == 0u),
    select(textureLoad(environment_table, vec2u(0u, max(y, 1u) - 1u), 0).y, 0.0, y == 0u),
  );
  let inside = clamp((u - start) / max(end - start, vec2f(1e-20)), vec2f(0.0), vec2f(0.99999994));
  let tent = select(1.0 - sqrt(2.0 - 2.0 * inside), sqrt(2.0 * inside) - 1.0, inside < vec2f(0.5));
  let place = (vec2f(f32(low), f32(y)) + 0.5 + tent) / vec2f(cells);
  // What falls over a pole comes back, as the rows beyond repeat the last.
  let uv = vec2f(place.x, 1.0 - abs(1.0 - abs(place.y)));
  let theta = uv.y * 3.141592653589793;
  let phi = (uv.x - 0.5) * 6.283185307179586;
  let flat = sin(theta) * vec2f(cos(phi), sin(phi));
  let turn = frame.environment_rotation;
  return vec3f(turn.x * flat.x + turn.y * flat.y, cos(theta), turn.x * flat.y - turn.y * flat.x);
}
//#endif
`,
);
