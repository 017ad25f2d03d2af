import {
  openpbr,
  openpbrEmission,
  openpbrOpacity,
  OPENPBR_PARAMETER_NAMES,
  OPENPBR_PARAMETER_SPECS,
  openPbrStruct,
  type OpenPbrParameterName,
} from '@glanz/openpbr';
import { openpbrFilm } from '@glanz/openpbr/film';
import { openpbrLobes } from '@glanz/openpbr/lobes';
import type { WgslModule } from '@glanz/wgsl';

/** Parameters that hosts read in their own code rather than in the surface's: frames, and how media begin. */
const IN_HOSTS: readonly string[] = ['geometry_thin_walled', 'geometry_normal', 'geometry_tangent'];

/** The parameters that change the image: those that a shader reads. */
export function actingParameters(): string[] {
  const seen = new Set<WgslModule>([openPbrStruct.module]);
  const textOf = (module: WgslModule): string => {
    if (seen.has(module)) return '';
    seen.add(module);
    return (
      module.code +
      module.deps.map((dependency) => textOf('module' in dependency ? dependency.module : dependency)).join('')
    );
  };
  const text = [openpbr, openpbrFilm, openpbrLobes, openpbrEmission, openpbrOpacity].map(textOf).join('');
  // Those of the draft share a word of the record.
  const fieldOf = (name: OpenPbrParameterName) => (OPENPBR_PARAMETER_SPECS[name].draft ? 'specular_lobes' : name);
  return OPENPBR_PARAMETER_NAMES.filter(
    (name) => IN_HOSTS.includes(name) || new RegExp(`\\.${fieldOf(name)}\\b`).test(text),
  );
}
