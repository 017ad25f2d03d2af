import {
  openpbr,
  openpbrEmission,
  openpbrOpacity,
  OPENPBR_PARAMETER_SPECS,
  openPbrStruct,
  type OpenPbrParameterName,
} from '@glanz/openpbr';
import type { WgslModule } from '@glanz/wgsl';

/** All WGSL text of modules and what they need, the parameter record itself left out. */
function textOf(roots: readonly WgslModule[]): string {
  const seen = new Set<WgslModule>([openPbrStruct.module]);
  const visit = (module: WgslModule): string => {
    if (seen.has(module)) return '';
    seen.add(module);
    return (
      module.code +
      module.deps.map((dependency) => visit('module' in dependency ? dependency.module : dependency)).join('')
    );
  };
  return roots.map(visit).join('');
}

/**
 * Names of the parameters that change the image: those that the shaders read. Others are kept for files and said to
 * be.
 */
export function actingParameters(): ReadonlySet<OpenPbrParameterName> {
  const text = textOf([openpbr, openpbrEmission, openpbrOpacity]);
  const names = Object.keys(OPENPBR_PARAMETER_SPECS) as OpenPbrParameterName[];
  return new Set(
    names.filter((name) => {
      const { type, draft } = OPENPBR_PARAMETER_SPECS[name];
      // The lobes of the draft are a module of their own.
      return type === 'vector3' || draft === true || new RegExp(`\\.${name}\\b`).test(text);
    }),
  );
}
